"""Metrics: pure functions of lists of scores, one family per module."""
