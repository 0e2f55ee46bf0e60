"""The file format of the noun taxonomy, `data/wordnet.txt.gz`; `tools/build_wordnet.py` writes it, `Taxonomy` reads it.

The file is UTF-8 text, compressed with gzip. Its first line is `FORMAT`. For each field of `TaxonomyColumns` two lines
follow: the name of the field in brackets, and its cells, separated by tabs. Cells of the `synset_` columns are in the
order of synset numbers, from 0; cells of the `lemma_` columns are in the order of the sorted lemmas.
"""

from typing import NamedTuple

__all__ = ["FORMAT", "TaxonomyColumns", "format_taxonomy", "parse_taxonomy"]

FORMAT = "usd2kg noun taxonomy, format 3"


class TaxonomyColumns(NamedTuple):
    """The columns of the taxonomy, each as the UTF-8 text of its cells; most cells are never parsed."""

    adjectives: bytes
    """Words that are adjectives more often than nouns."""
    domains: bytes
    """WordNet's lexicographer files; a sense refers to the first as `a`, to the next as `b`…"""
    synset_names: bytes
    """The lemma that WordNet lists first, with its spaces."""
    synset_hypernyms: bytes
    """Numbers of the direct hypernyms, separated by spaces."""
    synset_hyponym_counts: bytes
    """The number of synsets below a synset, itself included."""
    lemmas: bytes
    """Lower case, compounds without spaces and hyphens; sorted, so that one is found without parsing the others."""
    lemma_kinds: bytes
    """Domain and rank of each sense, the most frequent sense first, separated by spaces: `c1 f2`."""
    lemma_synsets: bytes
    """The synset of each sense in the same order, separated by spaces."""
    lemma_is_one_word: bytes
    """`1` if the lemma is written as one word, `0` if only as several. One character a lemma, without tabs."""


def format_taxonomy(columns: TaxonomyColumns) -> bytes:
    """Return the text of the file, not compressed."""
    lines = [FORMAT.encode()]
    for name, cells in zip(TaxonomyColumns._fields, columns, strict=True):
        lines += [f"[{name}]".encode(), cells]
    return b"\n".join([*lines, b""])


def parse_taxonomy(text: bytes) -> TaxonomyColumns:
    """Return the columns of a file.

    Raises:
        ValueError: the text is of another format.
    """
    lines = text.split(b"\n")
    names = [f"[{name}]".encode() for name in TaxonomyColumns._fields]
    if lines[0] != FORMAT.encode() or lines[1:-1:2] != names:
        raise ValueError(f"the noun taxonomy begins with {lines[0][:40]!r}; expected {FORMAT!r} and its sections")
    return TaxonomyColumns(*lines[2::2])
