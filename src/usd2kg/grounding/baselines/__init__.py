"""Baseline grounders of the study: dictionary, sentence embedding and volume."""
