"""Ontology-independent knowledge about nouns: senses, hypernyms, usual sizes and places."""
