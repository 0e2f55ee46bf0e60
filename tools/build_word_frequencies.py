"""Merge word lists into the word frequencies by which the reader of names ranks readings.

Usage: python -m tools.build_word_frequencies BOOKS SCOWL DICT_FOLDER

BOOKS is `package/lib/data.js` of the npm package `norvig-frequencies`: the 97,565 words of Google Books, most frequent
first. SCOWL is the folder `usr/share/dict/scowl` of Debian's package `scowl`: word lists in classes of commonness.
DICT_FOLDER is the folder `dict` of WordNet's database, as for `build_wordnet.py`. BERT's vocabulary, which also ranks
words by frequency, and the taxonomy are read from the package; build them first.

The first line of the result holds the words, the second an entry for each, such as `43/100`: ten times the Zipf score,
and the share of noun uses in percent or "-" for a head word of the home TBox that WordNet lacks.
"""

import math
import re
import sys
from collections import Counter
from functools import lru_cache
from pathlib import Path

from tools.data_files import gzip_bytes, write_data_file
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.word_frequencies import UNKNOWN_FREQUENCY
from usd2kg.knowledge import read_compressed
from usd2kg.ontology import load_home_tbox
from usd2kg.words import words_of

OUTPUT = "frequencies.txt.gz"

BOOKS_WORDS = 97_565
"""Length of the list of Google Books."""
BOOKS_END = 100_000 / 743_842_922_321
"""Relative frequency of its last words: 100,000 of 743,842,922,321 tokens."""
SCOWL_CLASSES = (10, 20, 35, 40, 50, 55, 60, 70)
"""Classes from 80 on hold words of word games."""
PLURAL_LIMIT = 10
"""Largest ratio of plural to singular uses that counts for the noun: `wales` is a country, not many ridges."""
FUNCTION_WORDS = frozenset(
    """
    a about above after all am an and any are as at be been before being below both but by can could did do does down
    each else few for from had has have he her here him his how i if in into is it its less like many may me might mine
    more most much must my near need no nor not now of off on once one or other our out over own per round shall she
    should since so some such than that the their them then there these they this those through till to too under until
    up upon us very was we well were what when where which while who whom whose why will with would yet you your
    """.split()
)
"""Closed-class words; WordNet counts only their rare homographs among nouns (tin can, iodine)."""
VERB_FORMS = dict(
    form.split(":")
    for form in """
    bit:bite bore:bear bound:bind drove:drive felt:feel found:find ground:grind led:lead left:leave lit:light met:meet
    rose:rise sat:sit saw:see shook:shake shot:shoot spoke:speak stole:steal stove:stave
    thought:think wound:wind wove:weave
    """.split()
)
"""Irregular verb forms that are also nouns (a saw, felt) → the verb under which WordNet counts them."""


@lru_cache(maxsize=1)
def fit_rank_law() -> tuple[float, int]:
    """Return C and b of f(r) = C/r up to rank b and C·b/r² beyond.

    Two regimes with these exponents: Ferrer i Cancho & Solé, Journal of Quantitative Linguistics 8 (2001) 165-173.
    C and b follow from the sum of the list's frequencies, 1, and the last one, `BOOKS_END`.
    """
    low, high = 1, BOOKS_WORDS
    while high - low > 1:
        at = (low + high) // 2
        constant = BOOKS_END * BOOKS_WORDS**2 / at
        # Euler-Maclaurin for the sum of 1/r, the integral for the sum of 1/r².
        total = constant * (math.log(at) + 0.5772 + 1 - at / BOOKS_WORDS)
        low, high = (at, high) if total > 1 else (low, at)
    return BOOKS_END * BOOKS_WORDS**2 / high, high


def zipf_of_rank(rank: float) -> float:
    """Return the Zipf score of a rank: log10 of uses per billion words."""
    constant, bend = fit_rank_law()
    return 9 + math.log10(constant / rank if rank <= bend else constant * bend / rank**2)


def read_books(path: Path) -> dict[str, float]:
    """Return word → Zipf score from the ranking of Google Books."""
    found = re.search(r'module\.exports = "([A-Z\\n]+)"', path.read_text("ascii"))
    words = found[1].lower().split("\\n") if found else []
    words = [word for word in words if word]
    if len(words) != BOOKS_WORDS:
        raise SystemExit(f"{path}: found {len(words)} words; expected {BOOKS_WORDS}, lib/data.js of norvig-frequencies")
    return {word: zipf_of_rank(rank) for rank, word in enumerate(words, 1)}


def read_bert() -> dict[str, float]:
    """Return word → Zipf score from BERT's vocabulary, where the words in order of frequency begin with `the`."""
    pieces = read_compressed("bert_vocab.txt.gz").decode().splitlines()
    words = [piece for piece in pieces[pieces.index("the") :] if piece.isascii() and piece.isalpha()]
    return {word: zipf_of_rank(rank) for rank, word in enumerate(words, 1)}


def read_scowl(folder: Path) -> list[set[str]]:
    """Return the words of each class, commonest class first."""
    classes = []
    for level in SCOWL_CLASSES:
        texts = [path.read_text("latin-1") for path in sorted(folder.glob(f"*-words.{level}"))]
        classes.append({word for word in " ".join(texts).split() if word.isascii() and word.isalpha()})
    if not all(classes):
        raise SystemExit(f"{folder}: expected words of the classes {SCOWL_CLASSES}, the lists of Debian's scowl")
    return classes


def merge_lists(books: dict[str, float], bert: dict[str, float], scowl: list[set[str]]) -> dict[str, float]:
    """Return word → Zipf score: the mean over the ranked lists that hold it, or else an estimate from SCOWL.

    Ranks continue through the classes of SCOWL; all new words of a class get its middle rank.
    """
    scores = {**bert, **books, **{word: (books[word] + bert[word]) / 2 for word in books.keys() & bert.keys()}}
    rank = float(BOOKS_WORDS)
    for words in scowl:
        added = words - scores.keys()
        scores.update(dict.fromkeys(sorted(added), zipf_of_rank(rank + len(added) / 2)))
        rank += len(added)
    return scores


def add_plurals(scores: dict[str, float]) -> dict[str, float]:
    """Return the scores with the uses of plurals added to their singulars, unless the plural is a lemma."""
    taxonomy = load_taxonomy()
    uses = {word: 10**score for word, score in scores.items()}
    for word in sorted(scores.keys() - FUNCTION_WORDS):
        if (singular := taxonomy.singular(word)) != word:
            own = 10 ** scores.get(singular, UNKNOWN_FREQUENCY)
            uses[singular] = uses.get(singular, own) + min(10 ** scores[word], PLURAL_LIMIT * own)
    return {word: math.log10(number) for word, number in uses.items()}


def read_proper_names(path: Path) -> set[tuple[str, str]]:
    """Return (lemma in lower case, synset offset) of the nouns that WordNet writes with a capital."""
    names: set[tuple[str, str]] = set()
    for line in path.read_text("latin-1").splitlines():
        if not line.startswith("  "):
            fields = line.split()
            lemmas = fields[4 : 4 + 2 * int(fields[3], 16) : 2]
            names.update((lemma.lower(), fields[0]) for lemma in lemmas if lemma != lemma.lower())
    return names


def read_noun_shares(folder: Path) -> dict[str, float]:
    """Return word → share of its uses as a common noun: tag counts with add-one smoothing per sense.

    An irregular verb form (saw, felt) also gets a third of the uses of its verb, which has about three forms.
    """
    proper_names = read_proper_names(folder / "data.noun")
    uses: Counter[tuple[str, bool]] = Counter()
    verb_uses: Counter[str] = Counter()
    for line in (folder / "index.sense").read_text("latin-1").splitlines():
        key, offset, _, count = line.split()
        lemma, _, rest = key.partition("%")
        uses[lemma, rest[0] == "1" and (lemma, offset) not in proper_names] += int(count) + 1
        verb_uses[lemma] += (int(count) + 1) * (rest[0] == "2")
    shares = {}
    for word in {lemma for lemma, _ in uses}:
        others = uses[word, False] + verb_uses[VERB_FORMS.get(word, "")] / 3
        shares[word] = uses[word, True] / (uses[word, True] + others)
    return {**shares, **dict.fromkeys(FUNCTION_WORDS, 0.0)}


def read_single_lemmas() -> set[str]:
    """Return the lemmas of the taxonomy that are written as one word."""
    taxonomy = load_taxonomy()
    single = set(taxonomy.lemmas) - set(taxonomy.phrases())
    return {lemma for lemma in single if len(lemma) > 1 and lemma.isascii() and lemma.isalpha()}


def read_home_words() -> dict[str, bool]:
    """Return word in a label of the home TBox → whether a label ends with it, so that it may be a head noun."""
    words: dict[str, bool] = {}
    for cls in load_home_tbox().classes:
        for label in (cls.label, *cls.alt_labels):
            singulars = [load_taxonomy().singular(word) for word in words_of(label)]
            words.update({word: words.get(word, False) for word in singulars[:-1]})
            words.update(dict.fromkeys(singulars[-1:], True))
    return words


def main() -> None:
    """Write the data file."""
    books, scowl_folder, dictionary = map(Path, sys.argv[1:])
    scowl = read_scowl(scowl_folder)
    scores = add_plurals(merge_lists(read_books(books), read_bert(), scowl))
    shares = read_noun_shares(dictionary)
    # Labels are in several languages: keep English words, which SCOWL lists.
    home = {word: is_head for word, is_head in read_home_words().items() if any(word in words for words in scowl)}
    entries: dict[str, str] = {}
    for word in sorted(read_single_lemmas() | load_taxonomy().adjectives | home.keys() - FUNCTION_WORDS):
        tenths = round(10 * max(scores.get(word, UNKNOWN_FREQUENCY), UNKNOWN_FREQUENCY))
        is_new = word not in shares and home.get(word, False)
        entries[word] = f"{tenths}/{'-' if is_new else round(100 * shares.get(word, 0))}"
    write(entries)


def write(entries: dict[str, str]) -> None:
    """Write the words on one line and the entries on another, which two splits read fast."""
    text = " ".join(entries) + "\n" + " ".join(entries.values()) + "\n"
    path = write_data_file(OUTPUT, gzip_bytes(text.encode()))
    print(f"{path}: {len(entries)} words, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
