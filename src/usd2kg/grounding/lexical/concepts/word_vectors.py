"""Vectors of words by latent semantic analysis (Deerwester et al., 1990): a faucet is near tapware, not a tower.

`tools/fit_word_vectors.py` factorises the matrix of noun senses and the words of their labels, hypernyms and
categories, and writes the vectors to `data/word_vectors.npz`.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.knowledge import data_file

__all__ = ["WordVectors", "load_word_vectors"]

Vector = NDArray[np.float32]


class WordVectors(NamedTuple):
    """Vectors of singular words in lower case."""

    rows: Mapping[str, int]
    """Word → row."""
    vectors: NDArray[np.int8]
    """(words, dimensions); only their directions count."""
    scales: Vector
    """(words,): the inverse document frequency of each word over the length of its row."""

    def embed(self, weights: Mapping[str, float]) -> Vector:
        """Return the weighted sum of the vectors of words, scaled to unit length, (dimensions,); 0 if none is known."""
        known = [(self.rows[word], weight) for word, weight in weights.items() if word in self.rows]
        if not known:
            return np.zeros(self.vectors.shape[1], np.float32)
        rows, values = zip(*known, strict=True)
        total = (np.array(values, np.float32) * self.scales[list(rows)]) @ self.vectors[list(rows)].astype(np.float32)
        return np.asarray(total / (np.linalg.norm(total) or 1.0), np.float32)


@lru_cache(maxsize=1)
def load_word_vectors() -> WordVectors:
    """Return the vectors of the package, read once.

    >>> vectors = load_word_vectors()
    >>> faucet, tapware, tower = (vectors.embed({word: 1.0}) for word in ("faucet", "tapware", "tower"))
    >>> bool(faucet @ tapware > 0.5 > faucet @ tower)
    True
    """
    with data_file("word_vectors.npz").open("rb") as file, np.load(file) as arrays:
        words, vectors = bytes(arrays["words"]).decode("ascii").split("\n"), arrays["vectors"]
        lengths = np.linalg.norm(vectors.astype(np.float32), axis=1)
        return WordVectors({word: row for row, word in enumerate(words)}, vectors, arrays["idf"] / lengths)
