"""Fit vectors of words by latent semantic analysis of the noun taxonomy and its categories.

Usage: python -m tools.fit_word_vectors

Writes `src/usd2kg/data/word_vectors.npz`. The rows of the matrix are the senses of nouns; its columns are the words of
the labels and of the categories of a sense and its hypernyms, weighted by TF-IDF, the farther up the less. The vectors
are the right singular vectors times the square roots of the singular values. Run it after `make data`, and before
`tools/fit_kind_ranking.py`.
"""

import re
from collections import Counter
from collections.abc import Iterable, Mapping

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import svds

from tools.data_files import encode_lines, npz_bytes, write_data_file
from usd2kg.grounding.lexical.concepts.categories import invert_categories
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy

DIMENSIONS = 128
"""Chosen: 64 rank the classes of ontologies left out worse by half a point; 200 no better."""
MIN_SENSES = 5
"""Words of fewer senses are left out: their vectors mean little and are four fifths of all."""
LABEL_WEIGHT, ABOVE_WEIGHT, CATEGORY_WEIGHT = 3.0, 2.0, 0.5
STEP_FACTOR = 0.7
"""Factor of a weight for each step up."""
MAX_STEPS = 4
SENSES = 3
"""Senses of a noun that are rows, the most frequent first."""
BYTE = 127
EMPTY_WORDS = frozenset(
    {"thing", "item", "object", "used", *"a an the of for to in on or and with by from as is that".split()}
)


def main() -> None:
    """Fit and write."""
    taxonomy = load_taxonomy()
    categories = invert_categories(taxonomy)
    senses_of_nouns = {sense.synset for lemma in taxonomy.lemmas for sense in taxonomy.senses(lemma)[:SENSES]}
    documents = [count_words(synset, taxonomy, categories) for synset in sorted(senses_of_nouns)]
    senses = Counter(word for counts in documents for word in counts)
    words = sorted(word for word, count in senses.items() if count >= MIN_SENSES)
    columns = {word: column for column, word in enumerate(words)}
    cells = [
        (row, columns[word], np.log1p(weight))
        for row, counts in enumerate(documents)
        for word, weight in counts.items()
        if word in columns
    ]
    rows, places, values = map(np.array, zip(*cells, strict=True))
    idf = np.log(len(documents) / (1 + np.array([senses[word] for word in words]))) + 1
    matrix = csr_matrix((values * idf[places], (rows, places)), shape=(len(documents), len(words)))
    lengths = np.sqrt(np.asarray(matrix.multiply(matrix).sum(axis=1)).ravel())
    matrix = diags(1 / np.maximum(lengths, np.finfo(float).tiny)) @ matrix
    _, strengths, vectors = svds(matrix, k=DIMENSIONS, v0=np.ones(min(matrix.shape)))
    found = vectors.T * np.sqrt(strengths)
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    content = npz_bytes(
        words=encode_lines(words),
        vectors=np.round(BYTE * found / np.abs(found).max(axis=1, keepdims=True)).astype(np.int8),
        idf=idf.astype(np.float32),
    )
    path = write_data_file("word_vectors.npz", content)
    print(f"{path}: {len(words):,} words of {len(documents):,} senses, {len(content):,} bytes")


def count_words(synset: int, taxonomy: Taxonomy, categories: Mapping[int, Iterable[str]]) -> dict[str, float]:
    """Return word → weight for a sense of a noun."""
    weights = dict.fromkeys(split_words(taxonomy.label(synset), taxonomy), LABEL_WEIGHT)
    for up, steps in taxonomy.walk_up(synset):
        if steps > MAX_STEPS:
            continue
        factor = STEP_FACTOR**steps
        for word in split_words(taxonomy.label(up), taxonomy):
            weights[word] = max(weights.get(word, 0.0), factor * ABOVE_WEIGHT)
        for category in categories.get(up, ()):
            for word in split_words(category, taxonomy):
                weights[word] = weights.get(word, 0.0) + factor * CATEGORY_WEIGHT
    return weights


def split_words(text: str, taxonomy: Taxonomy) -> set[str]:
    """Return the words of a label, singular; none of a compound without spaces."""
    if taxonomy.is_phrase(text) and re.fullmatch(r"\w+", text):
        return set()
    return {taxonomy.singular(word) for word in re.findall(r"[a-z0-9]+", text.lower())} - EMPTY_WORDS


if __name__ == "__main__":
    main()
