"""Pack the English words that are not whole words of BERT's vocabulary into a data file of the grounder.

Usage: python -m tools.build_english_words SCOWL

SCOWL is the folder `usr/share/dict/scowl` of Debian's package `scowl`, as for `build_word_frequencies.py`. BERT's
vocabulary is read from the package.
"""

import sys
from pathlib import Path

from tools.data_files import gzip_bytes, write_data_file
from usd2kg.grounding.lexical.reading.english_words import SHORTEST_WORD, is_common_word

OUTPUT = "english_words.txt.gz"
CLASSES = (10, 20, 35, 40, 50, 55, 60)
"""Classes of commonness; class 70 holds rare words, some of which look like misspellings."""


def main() -> None:
    """Write the data file."""
    folder = Path(sys.argv[1])
    paths = [path for level in CLASSES for path in sorted(folder.glob(f"*-words.{level}"))]
    words = {word for path in paths for word in path.read_text("latin-1").split()}
    if "mossy" not in words:
        raise SystemExit(f"{folder}: found {len(paths)} lists of words; expected those of Debian's scowl")
    kept = sorted(word for word in words if is_dictionary_entry(word) and not is_common_word(word))
    path = write_data_file(OUTPUT, gzip_bytes("".join(f"{word}\n" for word in kept).encode("ascii")))
    print(f"{path}: {len(kept)} words, {path.stat().st_size} bytes")


def is_dictionary_entry(word: str) -> bool:
    """Return whether a word is long enough, in lower case and without punctuation or accents."""
    return len(word) >= SHORTEST_WORD and word.isascii() and word.isalpha() and word.islower()


if __name__ == "__main__":
    main()
