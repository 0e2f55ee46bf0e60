"""The S-BERT baseline of the study: sentence embeddings of names, compared by cosine similarity."""
