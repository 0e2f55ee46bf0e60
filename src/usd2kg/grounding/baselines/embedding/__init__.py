"""The study's S-BERT baseline: sentence embeddings of names, compared by their cosine."""
