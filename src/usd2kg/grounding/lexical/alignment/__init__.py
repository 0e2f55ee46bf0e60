"""Which class of a TBox a noun phrase belongs to."""
