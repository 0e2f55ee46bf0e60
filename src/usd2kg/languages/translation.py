"""Translation of foreign names into English noun phrases, and detection of their language."""

from functools import lru_cache
from itertools import chain
from typing import NamedTuple

from usd2kg.languages.glossary import Glossary, load_lexicons
from usd2kg.languages.settings import PHRASES

__all__ = ["is_plural_form", "language_of", "translate"]

_MODIFIER_ORDER = {"adjective": 0, "unknown": 1, "english": 1, "material": 2}
"""Role → position before the nouns in English."""


_HEADS = {"de": -1}
"""Language → index of the head noun, if it is not the first."""


class _Reading(NamedTuple):
    """A name read in one language."""

    language: str
    revealing: int
    """Number of its words that reveal the language."""
    known: int
    """Number of its words in the lexicon."""
    english: tuple[str, ...]


class _Term(NamedTuple):
    """A word or a listed phrase of a name, with its translation."""

    english: tuple[str, ...]
    role: str
    """The entry's role; `english` or `unknown` for a word outside the lexicon."""
    size: int
    """Number of words it covers, without links."""
    reveals_language: bool


class _Word(NamedTuple):
    """A word of a name, independent of its neighbours."""

    term: _Term
    key: str
    """Dictionary form, or folded spelling."""
    is_link: bool
    is_known: bool
    """Whether it is in the lexicon or begins a listed phrase."""


def translate(words: tuple[str, ...], language: str | None = None) -> tuple[str, ...] | None:
    """Return the English words for the lower-case words of a name, the head noun last; None for an English name.

    A homograph of an English word (`wand`, `pan`) is translated only next to words that reveal the language, or if
    `language` states the language of the surrounding names, where only the head has to be known. Unknown words are
    kept and precede the noun.

    >>> translate(("silla", "de", "oficina"))
    ('office', 'chair')
    >>> translate(("wand",)), translate(("wand",), language="de")
    (None, ('wall',))
    >>> translate(("zentrifugenlampe",), language="de"), translate(("silla", "gestatoria"), language="es")
    (('centrifuge', 'lamp'), ('gestatoria', 'chair'))
    """
    reading = _best_reading(words, language)
    return reading and reading.english


def language_of(words: tuple[str, ...]) -> str | None:
    """Return the language (de, es, fr, it) of the lower-case words of a name; None if it is English or unknown.

    >>> language_of(("lampe", "cuisine"))
    'fr'
    """
    reading = _best_reading(words, None)
    return reading and reading.language


def is_plural_form(word: str, language: str) -> bool:
    """Return whether a lower-case noun of a language has another form than that of the dictionary: a plural, or a case.

    >>> is_plural_form("regale", "de"), is_plural_form("bücherregal", "de"), is_plural_form("sillas", "es")
    (True, False, True)
    """
    forms = load_lexicons()[language].parse(word)
    return bool(forms) and forms[-1].cost > 0


@lru_cache(maxsize=8192)
def _best_reading(words: tuple[str, ...], language: str | None) -> _Reading | None:
    lexicons = load_lexicons()
    chosen = lexicons.values() if language is None else [lexicons[language]] if language in lexicons else []
    readings = [reading for lexicon in chosen if (reading := _read(words, lexicon, language is not None))]
    return max(readings, key=lambda reading: (reading.revealing, reading.known), default=None)


def _read(words: tuple[str, ...], lexicon: Glossary, is_expected: bool) -> _Reading | None:
    """Return the name as read in one language; None if too few of its words are in that language."""
    if not any(_read_word(word, lexicon.language, is_expected).is_known for word in words):
        return None
    terms = _main_terms(words, lexicon, is_expected)
    links = [term for term in terms if term.role == "link"]
    others = [term for term in terms if term.role != "link"]
    size = sum(term.size for term in others)
    known = sum(term.size for term in others if term.role not in {"english", "unknown"})
    revealing = sum(term.reveals_language for term in others)
    if known == size > 1:
        revealing += sum(link.reveals_language for link in links)
    # One foreign word next to an English one is more often a brand than a mixed name, unless the language is expected.
    is_mixed = revealing + is_expected <= sum(term.role == "english" for term in others)
    is_head_known = bool(others) and others[_HEADS.get(lexicon.language, 0)].role in {"", "material"}
    if not known or is_mixed or (2 * known < size and not (is_expected and is_head_known)):
        return None
    return _Reading(lexicon.language, revealing, known, _in_english_order(terms, lexicon.language))


def _main_terms(words: tuple[str, ...], lexicon: Glossary, is_expected: bool) -> list[_Term]:
    """Return the terms before a preposition such as `mit`: accessories do not describe the object."""
    terms: list[_Term] = []
    at = 0
    while at < len(words):
        term, at = _next_term(words, at, lexicon, is_expected)
        if term.role != "with":
            terms.append(term)
        elif terms:
            break
    return terms


def _next_term(words: tuple[str, ...], at: int, lexicon: Glossary, is_expected: bool) -> tuple[_Term, int]:
    """Return the term that begins at a word, and the index after it."""
    word = _read_word(words[at], lexicon.language, is_expected)
    phrase = _phrase_at(words, at, lexicon) if word.key in lexicon.phrase_starts and not word.is_link else None
    return phrase or (word.term, at + 1)


def _phrase_at(words: tuple[str, ...], at: int, lexicon: Glossary) -> tuple[_Term, int] | None:
    """Return the longest listed phrase that begins at a word, with or without its links (`mesa_centro`)."""
    found = None
    keys: list[str] = []
    for end in range(at, min(at + PHRASES.max_words, len(words))):
        word = _read_word(words[end], lexicon.language, False)
        if not word.is_link:
            keys.append(word.key)
            if entry := lexicon.phrases.get(tuple(keys)):
                found = _Term(entry.english, entry.role, len(keys), True), end + 1
    return found


@lru_cache(maxsize=65536)
def _read_word(word: str, language: str, is_expected: bool) -> _Word:
    lexicon = load_lexicons()[language]
    key = lexicon.dictionary_form(word)
    if link := lexicon.link(word):
        return _Word(_Term((), link.role, 0, not link.is_homograph), key, is_link=True, is_known=True)
    if forms := lexicon.parse(word):
        english = tuple(part for form in forms for part in form.entry.english)
        term = _Term(english, forms[-1].entry.role, 1, any(form.reveals_language for form in forms))
        return _Word(term, key, is_link=False, is_known=True)
    if is_expected and (split := lexicon.split_head(word)) is not None:
        before, head = split
        return _Word(_Term((before, *head.entry.english), head.entry.role, 1, True), key, is_link=False, is_known=True)
    term = _Term((word,), "english" if word in _english_nouns() else "unknown", 1, False)
    return _Word(term, key, is_link=False, is_known=key in lexicon.phrase_starts)


@lru_cache(maxsize=1)
def _english_nouns() -> frozenset[str]:
    """Return the words of the English glosses, without adjectives (`central`), which languages share."""
    entries = chain.from_iterable(lexicon.words.entries() for lexicon in load_lexicons().values())
    return frozenset(word for entry in entries if entry.role != "adjective" for word in entry.english)


def _in_english_order(terms: list[_Term], language: str) -> tuple[str, ...]:
    """Return all words, with adjectives, unknown words and materials first and the head noun last.

    The part before a link is the head in all languages ("Tisch aus Holz"). Within a part, German has English order.
    """
    groups: list[list[_Term]] = [[]]
    for term in terms:
        if term.role == "link":
            groups.append([])
        else:
            groups[-1].append(term)
    ordered = [term for group in reversed(groups) for term in (group if language == "de" else _head_last(group))]
    ordered.sort(key=lambda term: _MODIFIER_ORDER.get(term.role, len(_MODIFIER_ORDER)))
    words = [word for term in ordered for word in term.english]
    return tuple(word for at, word in enumerate(words) if at == 0 or word != words[at - 1])


def _head_last(group: list[_Term]) -> list[_Term]:
    """Return a Romance noun phrase reversed, except for leading adjectives (`petite chaise`)."""
    leading = next((at for at, term in enumerate(group) if term.role != "adjective"), len(group))
    return [*group[:leading], *reversed(group[leading:])]
