"""The default grounder: names read as noun phrases, a noun taxonomy, and the context of the object."""
