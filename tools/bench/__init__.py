"""Benchmarks: what the book costs, beside named peers, each in one run (`make bench`)."""
