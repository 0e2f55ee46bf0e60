"""Geometry without USD: triangle meshes, convex hulls, vessels and overlapping boxes, as numpy arrays."""

from usd2kg.shapes.box_pairs import overlapping_pairs

__all__ = [
    "overlapping_pairs",
]
