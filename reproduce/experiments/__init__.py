"""Experiments: the paper's tables and figures, and the studies beyond it, measured."""
