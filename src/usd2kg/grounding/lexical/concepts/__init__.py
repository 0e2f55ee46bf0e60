"""Knowledge about nouns that no ontology is needed for: senses, hypernyms, usual sizes and places."""
