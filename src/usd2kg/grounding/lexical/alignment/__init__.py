"""Alignment of the classes of a TBox with terms and WordNet synsets."""
