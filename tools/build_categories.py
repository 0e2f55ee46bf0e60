"""Build the data file of categories (general kinds) and their members from `knowledge/categories.csv`.

Drops members that the taxonomy already has below the kind or below another member, and kinds that are too general to
be evidence. Reads the noun taxonomy of the package: run `make data` after `python -m tools.build_wordnet`.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from tools.data_files import KNOWLEDGE, SourceError, csv_bytes, read_source_rows
from usd2kg.grounding.lexical.concepts.categories import find_synset
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy

MAX_SYNSETS = 3000
"""Chosen: kinds with more synsets (artifact, equipment) are too general to be evidence."""


class Row(NamedTuple):
    """One row of the source."""

    kinds: list[str]
    """Names of the kind."""
    members: list[str]
    """Nouns that belong to it."""


def build_categories() -> bytes:
    """Return the CSV file `kinds,things,members`; `things` is the number of synsets of the kind."""
    taxonomy = load_taxonomy()
    below: list[list[int]] = [[] for _ in range(taxonomy.synset_count)]
    for synset in range(taxonomy.synset_count):
        for hypernym in taxonomy.above(synset):
            below[hypernym].append(synset)
    source = [Row(row["kinds"].split("|"), row["members"].split("|")) for row in read_source_rows("categories.csv")]
    rows = []
    for kinds, members in merge_synonymous_kinds(source, taxonomy):
        kept = find_informative_members(kinds, members, taxonomy)
        named = (find_synset(name, taxonomy) for name in (*kinds, *members))
        count = count_hyponyms([synset for synset in named if synset is not None], below)
        if kept and count <= MAX_SYNSETS:
            rows.append(("|".join(kinds), count, "|".join(kept)))
    return csv_bytes(("kinds", "things", "members"), rows)


def merge_synonymous_kinds(rows: Iterable[Row], taxonomy: Taxonomy) -> list[Row]:
    """Return the rows with all unambiguous synonyms of their kind, and rows of synonymous kinds merged."""
    rows = list(rows)
    lemmas: dict[int, list[str]] = {}
    for lemma in sorted(taxonomy.lemmas):
        if len(taxonomy.senses(lemma)) == 1:
            lemmas.setdefault(taxonomy.senses(lemma)[0].synset, []).append(lemma)
    written = {kind.replace(" ", "").replace("-", "") for kinds, _ in rows for kind in kinds}
    by_synset: dict[int, Row] = {}
    merged = []
    for kinds, members in rows:
        synsets = [synset for kind in kinds if (synset := find_synset(kind, taxonomy)) is not None]
        row = next((by_synset[synset] for synset in synsets if synset in by_synset), None)
        if row is None:
            row = Row([], [])
            merged.append(row)
        for synset in synsets:
            by_synset.setdefault(synset, row)
        others = [lemma for synset in synsets for lemma in lemmas.get(synset, ()) if lemma not in written]
        row.kinds.extend(name for name in dict.fromkeys([*kinds, *others]) if name not in row.kinds)
        row.members.extend(member for member in members if member not in row.members)
    return merged


def find_informative_members(kinds: Sequence[str], members: Sequence[str], taxonomy: Taxonomy) -> list[str]:
    """Return the members that the taxonomy has neither below all names of the kind nor below another member.

    Raises:
        SourceError: a member is not a noun of the taxonomy.
    """
    synsets: dict[int, str] = {}
    for member in members:
        synset = find_synset(member, taxonomy)
        if synset is None:
            raise SourceError(
                KNOWLEDGE / "categories.csv",
                f"{'|'.join(kinds)}: {member!r} is not a noun of the taxonomy, or has fewer senses",
            )
        synsets.setdefault(synset, member)
    kind_synsets = {find_synset(kind, taxonomy) for kind in kinds}
    hypernyms = {synset: {up for up, _ in taxonomy.walk_up(synset)} for synset in synsets}
    return [
        member
        for synset, member in synsets.items()
        if not kind_synsets <= hypernyms[synset] and hypernyms[synset].isdisjoint(synsets.keys() - {synset})
    ]


def count_hyponyms(chosen: Iterable[int], below: Sequence[Sequence[int]]) -> int:
    """Return the number of synsets that are among the chosen or below one of them.

    Args:
        chosen: indices of synsets.
        below: for each synset, its direct hyponyms.
    """
    found: set[int] = set()
    pending = list(chosen)
    while pending:
        synset = pending.pop()
        if synset not in found:
            found.add(synset)
            pending += below[synset]
    return len(found)
