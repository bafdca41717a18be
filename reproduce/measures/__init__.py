"""Measures: quantities of a movement, a filter or a detector, used by experiments and chapters."""
