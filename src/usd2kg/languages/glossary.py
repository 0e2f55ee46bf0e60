"""Lexicons of foreign words and phrases, and the splitting of German compounds."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain
from typing import NamedTuple

from usd2kg.knowledge import read_rows
from usd2kg.languages.inflection import Entry, Form, compound_forms, fold, word_forms
from usd2kg.languages.settings import COMPOUNDS

__all__ = ["Glossary", "load_lexicons", "split_compound"]


@dataclass(slots=True)
class Glossary:
    """The words of one language by their folded spellings."""

    language: str
    words: dict[str, Form] = field(default_factory=dict)
    """Spellings of whole words and of the last parts of compounds."""
    modifiers: dict[str, Form] = field(default_factory=dict)
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

    def dictionary_form(self, word: str) -> str:
        """Return the dictionary form of a word; its folded spelling if it is a compound or unknown."""
        forms = self.parse(word)
        return forms[0].entry.word if len(forms) == 1 else fold(word, self.language)

    def link(self, word: str) -> Entry | None:
        """Return the entry of a link; None for other words."""
        return self.links.get(fold(word, self.language))

    def add(self, entry: Entry) -> None:
        """Add an entry; phrases must be added after their words."""
        if entry.role in {"link", "with"}:
            self.links[fold(entry.word, entry.language)] = entry
        elif " " in entry.word:
            key = tuple(self.dictionary_form(word) for word in entry.word.split() if self.link(word) is None)
            self.phrases[key] = entry
            self.phrase_starts.add(key[0])
        else:
            forms = list(word_forms(entry))
            if entry.role != "stem":
                _keep_cheapest(self.words, forms)
            if entry.language == "de":
                _keep_cheapest(self.modifiers, chain(forms, compound_forms(entry)))


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


@lru_cache(maxsize=1)
def load_lexicons() -> dict[str, Glossary]:
    """Return language → lexicon, in the order of the vocabulary; read once."""
    entries = [
        Entry(row["language"], row["word"], tuple(row["english"].split()), row["homograph"] == "yes", row["role"])
        for row in read_rows("glosses.csv")
    ]
    lexicons = {entry.language: Glossary(entry.language) for entry in entries}
    for entry in sorted(entries, key=lambda entry: " " in entry.word):
        lexicons[entry.language].add(entry)
    return lexicons


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
