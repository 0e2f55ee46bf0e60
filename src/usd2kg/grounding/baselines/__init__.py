"""The study's baselines: dictionary, sentence embedding, volume."""
