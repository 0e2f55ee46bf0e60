"""Shared writer of the scenes: shapes, assets, layouts, layers and tables."""
