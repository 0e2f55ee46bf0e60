"""Match the noun phrase of a name with the classes of a TBox."""
