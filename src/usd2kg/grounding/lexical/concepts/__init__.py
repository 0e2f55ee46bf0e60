"""What things are, whatever the ontology: senses, hypernyms, usual sizes and places."""
