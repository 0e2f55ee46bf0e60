"""Alignment of noun phrases with the classes of a TBox."""
