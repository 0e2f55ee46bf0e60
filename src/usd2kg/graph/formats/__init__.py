"""File formats of graphs: the same graph gives the same bytes, and every file can be read back."""
