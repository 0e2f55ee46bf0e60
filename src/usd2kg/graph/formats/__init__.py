"""File formats of graphs: the same graph gives the same bytes in each."""
