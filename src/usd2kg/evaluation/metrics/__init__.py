"""Measures: pure functions of lists of scores, one family a module."""
