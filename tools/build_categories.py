"""Write the data file of general kinds and what people count among them.

Usage: python -m tools.build_categories

`categories.csv` beside this file, which the authors of this project wrote, has a row for each general kind that
ontologies have classes for: its names, parted by `|`, and what belongs to it though the taxonomy has it elsewhere, each
member as high up as all that is below it belongs too. `#2` behind a name is its second meaning in the taxonomy.

Left out are members that have the kind, by each of its names, or another member above them, and kinds of so many
things that they tell nothing.
Run it again after `build_wordnet.py`.
"""

import csv
from pathlib import Path

from tools.build_wordnet import count_below
from usd2kg.grounding.lexical.concepts.categories import synset_of
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy

OUTPUT = Path(__file__).parent.parent / "src/usd2kg/data/categories.csv"
CATEGORIES = Path(__file__).parent / "categories.csv"
MOST_THINGS = 3000


def read_categories() -> list[tuple[list[str], list[str]]]:
    """Return (names of a kind, names of what belongs to it) of each row."""
    with CATEGORIES.open(encoding="utf-8", newline="") as file:
        return [(row["kinds"].split("|"), row["members"].split("|")) for row in csv.DictReader(file)]


def united(rows: list[tuple[list[str], list[str]]], taxonomy: Taxonomy) -> list[tuple[list[str], list[str]]]:
    """Return the rows with all names of one meaning that the taxonomy has for their kinds, rows of a kind in one.

    What people count among luminaires they count among lighting fixtures, whichever word a row has.
    """
    lemmas: dict[int, list[str]] = {}
    for lemma in sorted(taxonomy.lemmas):
        if len(taxonomy.senses(lemma)) == 1:
            lemmas.setdefault(taxonomy.senses(lemma)[0].synset, []).append(lemma)
    written = {kind.replace(" ", "").replace("-", "") for kinds, _ in rows for kind in kinds}
    of_synset: dict[int, tuple[list[str], list[str]]] = {}
    found = []
    for kinds, members in rows:
        meant = [synset for kind in kinds if (synset := synset_of(kind, taxonomy)) is not None]
        row = next((of_synset[synset] for synset in meant if synset in of_synset), None)
        if row is None:
            row = [], []
            found.append(row)
        of_synset.update({synset: of_synset.get(synset, row) for synset in meant})
        others = [lemma for synset in meant for lemma in lemmas.get(synset, ()) if lemma not in written]
        row[0].extend(name for name in dict.fromkeys([*kinds, *others]) if name not in row[0])
        row[1].extend(member for member in members if member not in row[1])
    return found


def telling_members(kinds: list[str], members: list[str], taxonomy: Taxonomy) -> list[str]:
    """Return the members that the taxonomy does not have below the kind by each of its names, nor below another member.

    Raises:
        ValueError: a member is no noun of the taxonomy.
    """
    synsets: dict[int, str] = {}
    for member in members:
        synset = synset_of(member, taxonomy)
        if synset is None:
            raise ValueError(
                f"{CATEGORIES.name}: {'|'.join(kinds)}: {member!r} is no noun of the taxonomy, or has fewer meanings"
            )
        synsets.setdefault(synset, member)
    known = {synset_of(kind, taxonomy) for kind in kinds}
    above = {synset: {up for up, _ in taxonomy.walk_up(synset)} for synset in synsets}
    return [
        member
        for synset, member in synsets.items()
        if not known <= above[synset] and above[synset].isdisjoint(synsets.keys() - {synset})
    ]


def main() -> None:
    """Write the data file."""
    taxonomy = load_taxonomy()
    below: list[list[int]] = [[] for _ in range(taxonomy.synset_count)]
    for synset in range(taxonomy.synset_count):
        for up in taxonomy.above(synset):
            below[up].append(synset)
    rows = []
    for kinds, members in united(read_categories(), taxonomy):
        telling = telling_members(kinds, members, taxonomy)
        named = (synset_of(name, taxonomy) for name in (*kinds, *members))
        things = count_below([synset for synset in named if synset is not None], below)
        if telling and things <= MOST_THINGS:
            rows.append(("|".join(kinds), things, "|".join(telling)))
    with OUTPUT.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([("kinds", "things", "members"), *rows])
    print(f"{OUTPUT}: {len(rows)} kinds, {OUTPUT.stat().st_size} bytes")


if __name__ == "__main__":
    main()
