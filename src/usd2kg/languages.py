"""Reading German, Spanish, French and Italian names: compounds into their parts, names into English."""

import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain
from typing import NamedTuple

from usd2kg.knowledge import read_rows

__all__ = ["language_of", "split_compound", "translate"]

_TRANSLITERATIONS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "œ": "oe"})
_UMLAUTS = {"a": "ä", "o": "ö", "u": "ü"}
_LONGEST_WORD = 60
_LONGEST_PHRASE = 5
_SHORTEST_PART = 3
_SHORTEST_TELLING_PART = 4
_SHORTEST_WITHOUT_UMLAUT = 5
"""A word that lost its umlaut (`kuche`) is known from this many letters on, and shows the language from one more."""

_ENDINGS: dict[tuple[str, str], tuple[str, ...]] = {
    ("de", ""): ("", "e", "en", "er", "n", "s", "nen"),
    ("de", "adjective"): ("", "e", "er", "es", "en", "em"),
    ("es", ""): ("", "s", "es"),
    ("es", "adjective"): ("", "s", "es"),
    ("fr", ""): ("", "s"),
    ("fr", "adjective"): ("", "s", "e", "es"),
}
_REPLACED_ENDINGS: dict[tuple[str, str], dict[str, tuple[str, ...]]] = {
    ("es", ""): {"z": ("ces",)},
    ("es", "adjective"): {"o": ("a", "as")},
    ("fr", ""): {"u": ("ux",), "al": ("aux",)},
    ("fr", "adjective"): {
        "u": ("ux",),
        "al": ("aux",),
        "eux": ("euse", "euses"),
        "er": ("ère", "ères"),
        "f": ("ve", "ves"),
    },
    ("it", ""): {
        **{"o": ("i", "a"), "a": ("e",), "e": ("i",), "io": ("i",)},
        **{"co": ("chi",), "go": ("ghi",), "ca": ("che",), "ga": ("ghe",), "cia": ("ce",), "gia": ("ge",)},
    },
    ("it", "adjective"): {"o": ("a", "i", "e"), "e": ("i",), "io": ("i",), "co": ("chi", "che"), "go": ("ghi", "ghe")},
}
_RANKS = {"adjective": 0, "unknown": 1, "english": 1, "material": 2}
"""What comes before the nouns in English, first to last."""

_LINKING_ELEMENTS = ("s", "n", "en", "er", "es", "e")


class _Entry(NamedTuple):
    """One row of the vocabulary."""

    language: str
    word: str
    english: tuple[str, ...]
    is_homograph: bool
    role: str
    """Empty for nouns or `material`; `adjective`; `stem` (only begins compounds); `link` and `with` (no gloss)."""

    @property
    def kind(self) -> tuple[str, str]:
        """What decides the endings: the language and the role, materials being nouns like others."""
        return self.language, "" if self.role == "material" else self.role


class _Form(NamedTuple):
    """An entry as it may be spelled: inflected, transliterated or, within a compound, with a linking element."""

    entry: _Entry
    cost: int
    """0 for the dictionary form; more for spellings that are rarer or more easily mistaken."""
    is_telling: bool
    """Whether the spelling shows the language, being no English word."""


@dataclass(slots=True)
class _Lexicon:
    """The words of one language by their folded spelling."""

    language: str
    whole: dict[str, _Form] = field(default_factory=dict)
    """Spellings that stand alone or end a compound."""
    inner: dict[str, _Form] = field(default_factory=dict)
    """Spellings that begin or continue a German compound; none in the other languages."""
    links: dict[str, _Entry] = field(default_factory=dict)
    phrases: dict[tuple[str, ...], _Entry] = field(default_factory=dict)
    """By the dictionary forms of their words, links left out."""
    beginnings: set[str] = field(default_factory=set)
    """The first of these."""

    def parse(self, word: str) -> tuple[_Form, ...]:
        """Return the forms that a lower-case word consists of, the head last; none if it is unknown."""
        text = _fold(word, self.language)
        if text in self.whole:
            return (self.whole[text],)
        return _split(text, self) if self.inner and len(text) <= _LONGEST_WORD else ()


def _fold(word: str, language: str) -> str:
    """Return the spelling without accents; German umlauts become ae, oe, ue."""
    if word.isascii():
        return word
    text = unicodedata.normalize("NFC", word)
    text = text.translate(_TRANSLITERATIONS) if language == "de" else text.replace("œ", "oe")
    return _without_accents(text)


def _without_accents(text: str) -> str:
    if text.isascii():
        return text
    return "".join(c for c in unicodedata.normalize("NFD", text) if not unicodedata.combining(c))


@lru_cache(maxsize=1)
def _lexicons() -> dict[str, _Lexicon]:
    """Return the lexicon of every language, read once, in the vocabulary's order."""
    entries = [
        _Entry(row["language"], row["word"], tuple(row["english"].split()), row["homograph"] == "yes", row["role"])
        for row in read_rows("glosses.csv")
    ]
    lexicons = {entry.language: _Lexicon(entry.language) for entry in entries}
    for entry in sorted(entries, key=lambda entry: " " in entry.word):
        _add(entry, lexicons[entry.language])
    return lexicons


def _add(entry: _Entry, lexicon: _Lexicon) -> None:
    if entry.role in {"link", "with"}:
        lexicon.links[_fold(entry.word, entry.language)] = entry
    elif " " in entry.word:
        key = tuple(_key(word, lexicon) for word in entry.word.split() if not _is_link(word, lexicon))
        lexicon.phrases[key] = entry
        lexicon.beginnings.add(key[0])
    else:
        whole = list(_whole_forms(entry))
        for text, form in whole if entry.role != "stem" else ():
            _keep_cheapest(lexicon.whole, text, form)
        for text, form in chain(whole, _inner_forms(entry)) if entry.language == "de" else ():
            _keep_cheapest(lexicon.inner, text, form)


def _keep_cheapest(forms: dict[str, _Form], text: str, form: _Form) -> None:
    if text not in forms or form.cost < forms[text].cost:
        forms[text] = form


def _whole_forms(entry: _Entry) -> Iterator[tuple[str, _Form]]:
    """Yield the spellings of a word that stands alone, inflected or not."""
    yield from _spelled(entry.word, entry, 0)
    for ending in _ENDINGS.get(entry.kind, ("",))[1:]:
        yield from _spelled(entry.word + ending, entry, 1)
    for replaced, endings in _REPLACED_ENDINGS.get(entry.kind, {}).items():
        if entry.word.endswith(replaced):
            for ending in endings:
                yield from _spelled(entry.word.removesuffix(replaced) + ending, entry, 1)
    # An umlaut costs more than an ending: Küchen are rooms (Küche), not cakes (Kuchen).
    if entry.kind == ("de", "") and (stem := _with_umlaut(entry.word)):
        for ending in ("", "e", "er", "n", "en", "ern"):
            yield from _spelled(stem + ending, entry._replace(is_homograph=False), 2, of=entry)


def _inner_forms(entry: _Entry) -> Iterator[tuple[str, _Form]]:
    """Yield the further spellings of a German word within a compound."""
    if entry.kind == ("de", ""):
        for element in _LINKING_ELEMENTS:
            yield from _spelled(entry.word + element, entry, 1)
        if entry.word.endswith("e"):  # Kirschkuchen, Schulbank
            yield from _spelled(entry.word[:-1], entry._replace(is_homograph=True), 2, of=entry)


def _spelled(word: str, entry: _Entry, cost: int, of: _Entry | None = None) -> Iterator[tuple[str, _Form]]:
    """Yield a form folded and, where it has umlauts, as exporters write it that drop them."""
    if word.isascii():
        yield word, _Form(of or entry, cost, not entry.is_homograph)
        return
    text, bare = _fold(word, entry.language), _without_accents(word)
    yield text, _Form(of or entry, cost, not entry.is_homograph)
    if entry.language == "de" and bare != text and len(bare) >= _SHORTEST_WITHOUT_UMLAUT:
        is_long = len(bare) > _SHORTEST_WITHOUT_UMLAUT
        yield bare, _Form(of or entry, cost + 3, is_long and not entry.is_homograph)


def _with_umlaut(word: str) -> str | None:
    """Return a German noun with the umlaut of its plural (`stühl`, `häus`), None if it has no such vowel.

    >>> _with_umlaut("baum")
    'bäum'
    """
    at = max(word.rfind("au"), word.rfind("a"), word.rfind("o"))
    at = at if word[at : at + 2] == "au" else max(at, word.rfind("u"))
    return word[:at] + _UMLAUTS[word[at]] + word[at + 1 :] if at >= 0 else None


def _split(text: str, lexicon: _Lexicon) -> tuple[_Form, ...]:
    """Return the fewest, plainest parts that make up a folded German compound, none if nothing does."""
    best: dict[int, tuple[int, tuple[_Form, ...], bool]] = {0: (0, (), False)}
    for end in range(_SHORTEST_PART, len(text) + 1):
        forms = lexicon.whole if end == len(text) else lexicon.inner
        for start in [start for start in best if start <= end - _SHORTEST_PART]:
            if form := forms.get(text[start:end]):
                cost, before, is_telling = best[start]
                found = (cost + 10 + form.cost, (*before, form), is_telling or _shows_language(form, end - start))
                # Of two readings alike the longer modifier wins: Rotwein-flasche, not Rot-weinflasche.
                best[end] = min(found, best.get(end, found), key=lambda reading: reading[0])
    _, parts, is_telling = best.get(len(text), (0, (), False))
    return parts if is_telling else ()


def _shows_language(form: _Form, length: int) -> bool:
    """Return whether a part of a compound is long enough not to be there by chance; stems turn up more easily."""
    return form.is_telling and length >= _SHORTEST_TELLING_PART + (form.entry.role == "stem")


def _is_link(word: str, lexicon: _Lexicon) -> bool:
    return _fold(word, lexicon.language) in lexicon.links


def _key(word: str, lexicon: _Lexicon) -> str:
    forms = lexicon.parse(word)
    return forms[0].entry.word if len(forms) == 1 else _fold(word, lexicon.language)


class _Reading(NamedTuple):
    """A name read in one language."""

    language: str
    telling: int
    """How many of its words show the language."""
    known: int
    english: tuple[str, ...]


class _Term(NamedTuple):
    """A word or listed phrase of a name, in English."""

    english: tuple[str, ...]
    role: str
    """The entry's role; `english` or `unknown` for a word outside the lexicon."""
    size: int
    """How many of the name's words it covers, links not counted."""
    is_telling: bool


def split_compound(word: str) -> tuple[str, ...]:
    """Return the dictionary forms of the words that a lower-case word consists of, the head last.

    A word that no language knows, or that is an English word too, comes back as it is.

    >>> split_compound("kuechenschrank")
    ('küche', 'schrank')
    >>> split_compound("sillones")
    ('sillón',)
    >>> split_compound("wallpaper")
    ('wallpaper',)
    """
    for lexicon in _lexicons().values():
        forms = lexicon.parse(word)
        if any(form.is_telling for form in forms):
            return tuple(form.entry.word for form in forms)
    return (word,)


def translate(words: tuple[str, ...], language: str | None = None) -> tuple[str, ...] | None:
    """Return the English words for a name's lower-case words, the head noun last; None if the name is not foreign.

    Words spelled like an English one (`wand`, `pan`) count only beside words that show the language, unless
    `language` says which one the names around are in. Unknown words stay, before the noun.

    >>> translate(("silla", "de", "oficina"))
    ('office', 'chair')
    >>> translate(("wand",)), translate(("wand",), language="de")
    (None, ('wall',))
    """
    reading = _best_reading(words, language)
    return reading and reading.english


def language_of(words: tuple[str, ...]) -> str | None:
    """Return the language that a name's lower-case words are in (de, es, fr, it), None if English or unknown.

    >>> language_of(("lampe", "cuisine"))
    'fr'
    """
    reading = _best_reading(words, None)
    return reading and reading.language


@lru_cache(maxsize=8192)
def _best_reading(words: tuple[str, ...], language: str | None) -> _Reading | None:
    lexicons = _lexicons()
    chosen = lexicons.values() if language is None else [lexicons[language]] if language in lexicons else []
    readings = [reading for lexicon in chosen if (reading := _read(words, lexicon, language is not None))]
    return max(readings, key=lambda reading: (reading.telling, reading.known), default=None)


def _read(words: tuple[str, ...], lexicon: _Lexicon, is_expected: bool) -> _Reading | None:
    """Return the name as read in one language, None if too little of it is in that language."""
    if not any(_by_itself(word, lexicon.language).is_known for word in words):
        return None
    terms = _main_terms(words, lexicon)
    links = [term for term in terms if term.role == "link"]
    others = [term for term in terms if term.role != "link"]
    size = sum(term.size for term in others)
    known = sum(term.size for term in others if term.role not in {"english", "unknown"})
    telling = sum(term.is_telling for term in others)
    if known == size > 1:
        telling += sum(link.is_telling for link in links)
    # One foreign word beside an English one is a brand more often than a mixture, unless the language is expected.
    is_mixed = telling + is_expected <= sum(term.role == "english" for term in others)
    if not known or 2 * known < size or is_mixed:
        return None
    return _Reading(lexicon.language, telling, known, _in_english_order(terms, lexicon.language))


def _main_terms(words: tuple[str, ...], lexicon: _Lexicon) -> list[_Term]:
    """Return the terms up to a "with": what a thing comes with does not say what it is."""
    terms: list[_Term] = []
    at = 0
    while at < len(words):
        term, at = _next_term(words, at, lexicon)
        if term.role != "with":
            terms.append(term)
        elif terms:
            break
    return terms


def _next_term(words: tuple[str, ...], at: int, lexicon: _Lexicon) -> tuple[_Term, int]:
    """Return the term that begins at a word and where the next one begins."""
    word = _by_itself(words[at], lexicon.language)
    phrase = _phrase_at(words, at, lexicon) if word.key in lexicon.beginnings and not word.is_link else None
    return phrase or (word.term, at + 1)


def _phrase_at(words: tuple[str, ...], at: int, lexicon: _Lexicon) -> tuple[_Term, int] | None:
    """Return the longest listed phrase that begins at a word, with or without its links (`mesa_centro`)."""
    found = None
    keys: list[str] = []
    for end in range(at, min(at + _LONGEST_PHRASE, len(words))):
        word = _by_itself(words[end], lexicon.language)
        if not word.is_link:
            keys.append(word.key)
            if entry := lexicon.phrases.get(tuple(keys)):
                found = _Term(entry.english, entry.role, len(keys), True), end + 1
    return found


class _Word(NamedTuple):
    """A word of a name, whatever stands beside it."""

    term: _Term
    key: str
    """Its dictionary form, or its spelling."""
    is_link: bool
    is_known: bool
    """Whether it is a word of the language, or begins a phrase of it."""


@lru_cache(maxsize=65536)
def _by_itself(word: str, language: str) -> _Word:
    lexicon = _lexicons()[language]
    forms = lexicon.parse(word)
    key = forms[0].entry.word if len(forms) == 1 else _fold(word, language)
    if link := lexicon.links.get(_fold(word, language)):
        return _Word(_Term((), link.role, 0, not link.is_homograph), key, is_link=True, is_known=True)
    if forms:
        english = tuple(part for form in forms for part in form.entry.english)
        term = _Term(english, forms[-1].entry.role, 1, any(form.is_telling for form in forms))
        return _Word(term, key, is_link=False, is_known=True)
    term = _Term((word,), "english" if word in _english_words() else "unknown", 1, False)
    return _Word(term, key, is_link=False, is_known=key in lexicon.beginnings)


@lru_cache(maxsize=1)
def _english_words() -> frozenset[str]:
    """Return the English words that speak of things; adjectives (`central`) are much the same in all languages."""
    forms = chain.from_iterable(lexicon.whole.values() for lexicon in _lexicons().values())
    return frozenset(word for form in forms if form.entry.role != "adjective" for word in form.entry.english)


def _in_english_order(terms: list[_Term], language: str) -> tuple[str, ...]:
    """Return all words with adjectives, unknown words and materials first and the head noun last.

    "Tisch aus Holz" names its head first in any language; between links only German keeps English order.
    """
    groups: list[list[_Term]] = [[]]
    for term in terms:
        if term.role == "link":
            groups.append([])
        else:
            groups[-1].append(term)
    ordered = [term for group in reversed(groups) for term in (group if language == "de" else _head_last(group))]
    ordered.sort(key=lambda term: _RANKS.get(term.role, len(_RANKS)))
    words = [word for term in ordered for word in term.english]
    return tuple(word for at, word in enumerate(words) if at == 0 or word != words[at - 1])


def _head_last(group: list[_Term]) -> list[_Term]:
    """Return a Romance group turned round, but for the adjectives that lead as in English (`petite chaise`)."""
    leading = next((at for at, term in enumerate(group) if term.role != "adjective"), len(group))
    return [*group[:leading], *reversed(group[leading:])]
