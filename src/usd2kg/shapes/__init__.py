"""Geometry without USD: hulls, vessels and pairs of overlapping boxes, on numpy arrays."""

from usd2kg.shapes.box_pairs import overlapping_pairs

__all__ = [
    "overlapping_pairs",
]
