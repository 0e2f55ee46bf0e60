"""Lexicons of foreign words and phrases, and the splitting of German compounds."""

from array import array
from base64 import b64decode, b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain
from typing import Any, NamedTuple

from usd2kg.knowledge import read_text
from usd2kg.languages.inflection import Entry, Form, compound_forms, fold, word_forms
from usd2kg.languages.settings import COMPOUNDS
from usd2kg.table_cache import open_table_cache

__all__ = ["Glossary", "load_lexicons", "split_compound"]

_LINK_ROLES = frozenset({"link", "with"})
_LINK_ROLE_ENDINGS = tuple(f",{role}" for role in _LINK_ROLES)
_FORM_CODES = 16
"""Costs of 0 to 7, and whether a form reveals its language."""
_Codes = dict[str, list[dict[str, int]]]


@dataclass(slots=True)
class Glossary:
    """The words of one language by their folded spellings."""

    language: str
    words: "_FormTable"
    """Spellings of whole words and of the last parts of compounds."""
    modifiers: "_FormTable"
    """Spellings of the other parts of German compounds; empty in other languages."""
    links: dict[str, Entry] = field(default_factory=dict)
    """Words such as `de` and `mit`."""
    phrases: dict[tuple[str, ...], Entry] = field(default_factory=dict)
    """Phrases by the dictionary forms of their words, without links."""
    phrase_starts: set[str] = field(default_factory=set)
    """First words of the phrases."""

    def parse(self, word: str) -> tuple[Form, ...]:
        """Return the forms that a lower-case word consists of, the head last; empty if it is unknown."""
        text = fold(word, self.language)
        if text in self.words:
            return (self.words[text],)
        return self._split(text) if self.modifiers and len(text) <= COMPOUNDS.max_letters else ()

    def _split(self, text: str) -> tuple[Form, ...]:
        """Return the cheapest split of a folded German compound, with the fewest parts; empty if there is none."""
        best = {0: _Split(0, (), False)}
        for end in range(COMPOUNDS.min_part, len(text) + 1):
            forms = self.words if end == len(text) else self.modifiers
            for start in [start for start in best if start <= end - COMPOUNDS.min_part]:
                if form := forms.get(text[start:end]):
                    before = best[start]
                    found = _Split(
                        before.cost + COMPOUNDS.part_cost + form.cost,
                        (*before.parts, form),
                        before.reveals_language or _part_reveals_language(form, end - start),
                    )
                    # On a tie the longer modifier wins: Rotwein-flasche, not Rot-weinflasche.
                    best[end] = min(found, best.get(end, found), key=lambda split: split.cost)
        split = best.get(len(text))
        return split.parts if split is not None and split.reveals_language else ()

    def split_head(self, word: str) -> tuple[str, Form] | None:
        """Return the unknown beginning of a German compound and its longest known head; None without one."""
        text = fold(word, self.language)
        for start in range(COMPOUNDS.min_part, len(text) - COMPOUNDS.min_head + 1) if self.modifiers else ():
            head = self.words.get(text[start:])
            if head is not None and head.reveals_language and head.entry.role != "adjective":
                return text[:start], head
        return None

    def dictionary_form(self, word: str) -> str:
        """Return the dictionary form of a word; its folded spelling if it is a compound or unknown."""
        forms = self.parse(word)
        return forms[0].entry.word if len(forms) == 1 else fold(word, self.language)

    def link(self, word: str) -> Entry | None:
        """Return the entry of a link; None for other words."""
        return self.links.get(fold(word, self.language))

    def add(self, entry: Entry) -> None:
        """Add a link, or a phrase, whose words are known."""
        if entry.role in _LINK_ROLES:
            self.links[fold(entry.word, entry.language)] = entry
        else:
            key = tuple(self.dictionary_form(word) for word in entry.word.split() if self.link(word) is None)
            self.phrases[key] = entry
            self.phrase_starts.add(key[0])


class _FormTable(Mapping[str, Form]):
    """Spelling → form, from numbers that are decoded when they are needed."""

    def __init__(self, codes: Mapping[str, int], entries: Sequence[Entry]) -> None:
        self._codes = codes
        self._entries = entries

    def __getitem__(self, text: str) -> Form:
        number, code = divmod(self._codes[text], _FORM_CODES)
        return Form(self._entries[number], code // 2, code % 2 == 1)

    def entries(self) -> Iterator[Entry]:
        """Yield each distinct entry with a form, without decoding all forms, which takes far longer."""
        for number in {code // _FORM_CODES for code in self._codes.values()}:
            yield self._entries[number]

    def __contains__(self, text: object) -> bool:
        return text in self._codes

    def __iter__(self) -> Iterator[str]:
        return iter(self._codes)

    def __len__(self) -> int:
        return len(self._codes)


class _Split(NamedTuple):
    """A split of the beginning of a compound."""

    cost: int
    parts: tuple[Form, ...]
    reveals_language: bool


def _part_reveals_language(form: Form, length: int) -> bool:
    """Return whether a part is too long to occur by chance; stems occur more easily."""
    return form.reveals_language and length >= COMPOUNDS.min_revealing_part + (form.entry.role == "stem")


def _keep_cheapest(forms: dict[str, Form], found: Iterable[tuple[str, Form]]) -> None:
    for text, form in found:
        if text not in forms or form.cost < forms[text].cost:
            forms[text] = form


class _Entries(Sequence[Entry]):
    """The rows of the vocabulary, parsed when they are needed."""

    def __init__(self) -> None:
        header, *self._lines = read_text("glosses.csv").splitlines()
        if header != "language,word,english,homograph,role":
            raise ValueError(f"glosses.csv has the columns {header}; build it again with make data")

    def __getitem__(self, index: Any) -> Any:
        # No cell is quoted: there are no commas in words.
        language, word, english, homograph, role = self._lines[index].split(",")
        return Entry(language, word, tuple(english.split()), homograph == "yes", role)

    def __len__(self) -> int:
        return len(self._lines)

    def links_and_phrases(self) -> Iterator[Entry]:
        """Yield the links, then the phrases."""
        phrases = []
        for index, line in enumerate(self._lines):
            if line.endswith(_LINK_ROLE_ENDINGS):
                yield self[index]
            elif " " in line and " " in line.split(",", 2)[1]:
                phrases.append(index)
        yield from map(self.__getitem__, phrases)


@lru_cache(maxsize=1)
def load_lexicons() -> dict[str, Glossary]:
    """Return language → lexicon, in the order of the vocabulary; read once. The spellings are kept between commands."""
    entries = _Entries()
    codes = open_table_cache(()).get("word-forms", _unpack, lambda: _encode_forms(entries), _pack)
    lexicons = {
        language: Glossary(language, _FormTable(words, entries), _FormTable(modifiers, entries))
        for language, (words, modifiers) in codes.items()
    }
    # Phrases are listed by their words without links.
    for entry in entries.links_and_phrases():
        lexicons[entry.language].add(entry)
    return lexicons


def _encode_forms(entries: Sequence[Entry]) -> _Codes:
    """Return language → spellings of words and of modifiers, each with the number of its entry, cost and homography."""
    found: dict[str, tuple[dict[str, Form], dict[str, Form]]] = {}
    in_english = {(entry.language, entry.word) for entry in entries if entry.is_spelling}

    def marked(forms: Iterable[tuple[str, Form]], language: str) -> list[tuple[str, Form]]:
        return [
            (text, form._replace(reveals_language=False) if (language, text) in in_english else form)
            for text, form in forms
        ]

    for entry in entries:
        words, modifiers = found.setdefault(entry.language, ({}, {}))
        if entry.role in _LINK_ROLES or " " in entry.word or entry.is_spelling:
            continue
        forms = marked(word_forms(entry), entry.language)
        if entry.role != "stem":
            _keep_cheapest(words, forms)
        if entry.language == "de":
            _keep_cheapest(modifiers, chain(forms, marked(compound_forms(entry), entry.language)))
    numbers = {entry: number for number, entry in enumerate(entries)}
    return {
        language: [
            {
                text: numbers[form.entry] * _FORM_CODES + form.cost * 2 + form.reveals_language
                for text, form in table.items()
            }
            for table in tables
        ]
        for language, tables in found.items()
    }


def _pack(codes: _Codes) -> Any:
    """Return JSON values that are decoded in a tenth of the time that an object with as many keys takes."""
    return {
        language: [["\n".join(table), b64encode(array("I", table.values()).tobytes()).decode()] for table in tables]
        for language, tables in codes.items()
    }


def _unpack(kept: Any) -> _Codes:
    """Return kept tables; raise ValueError if they are damaged."""
    if not isinstance(kept, dict) or any(len(parts) != 2 for parts in kept.values()):
        raise ValueError("expected two tables a language")
    return {language: [_unpack_table(*table) for table in tables] for language, tables in kept.items()}


def _unpack_table(spellings: str, packed: str) -> dict[str, int]:
    codes = array("I")
    codes.frombytes(b64decode(packed, validate=True))
    return dict(zip(spellings.split("\n") if spellings else (), codes, strict=True))


def split_compound(word: str) -> tuple[str, ...]:
    """Return the dictionary forms of the words that a lower-case word consists of, the head last.

    An unknown word, or one that is also English, is returned unchanged.

    >>> split_compound("kuechenschrank")
    ('küche', 'schrank')
    >>> split_compound("sillones")
    ('sillón',)
    >>> split_compound("wallpaper")
    ('wallpaper',)
    """
    for lexicon in load_lexicons().values():
        forms = lexicon.parse(word)
        if any(form.reveals_language for form in forms):
            return tuple(form.entry.word for form in forms)
    return (word,)
