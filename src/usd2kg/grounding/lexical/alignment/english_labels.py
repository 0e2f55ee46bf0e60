"""The labels of an ontology in English, so that they can be aligned with English concepts."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.languages import language_of, translate
from usd2kg.ontology import ClassIRI, OntologyClass, TBox
from usd2kg.table_cache import open_table_cache
from usd2kg.words import words_of

__all__ = ["as_text", "foreign_names_only", "has_foreign_name", "in_english"]


class _Names(NamedTuple):
    """The names of one class in English."""

    label: str
    alt_labels: tuple[str, ...]
    foreign_names: tuple[tuple[str, str], ...]
    """As in `OntologyClass`, with those that have no tag but are in the language of the ontology."""


@lru_cache(maxsize=8)
def in_english(tbox: TBox) -> TBox:
    """Return the TBox with German, Spanish, French and Italian labels of its classes replaced by their translation.

    The language of a name is its tag; that of names without a tag is the one that most of them reveal. A name that the
    glossaries lack stays as it is: it may be a cognate (“Sofa”). The foreign names become synonyms.
    """
    names = open_table_cache(as_text(tbox)).get("english-labels", _decode, lambda: _translate(tbox), dict)
    if not names:
        return tbox
    classes = (replace(cls, **names[cls.iri]._asdict()) if cls.iri in names else cls for cls in tbox.classes)
    return replace(tbox, classes=tuple(classes))


def as_text(tbox: TBox) -> Iterator[str]:
    """Yield the cache key parts of tables about a TBox; the same ontology may be loaded with another scope."""
    yield tbox.content_hash
    for cls in tbox.classes:
        foreign = (f"{language} {name}" for language, name in cls.foreign_names)
        yield "\n".join((cls.iri, cls.label, cls.comment, *cls.alt_labels, "", *cls.parents, "", *foreign))


def foreign_names_only(cls: OntologyClass) -> set[str]:
    """Return the names of a class that are foreign, and not English as well (“Hammer”)."""
    foreign = {name for _, name in cls.foreign_names}
    english = {words_of(name) for name in (cls.label, *cls.alt_labels) if name not in foreign}
    return {name for name in foreign if words_of(name) not in english}


def has_foreign_name(cls: OntologyClass, name: str) -> bool:
    """Return whether a name, such as the last part of the IRI, is that of a class in another language."""
    return bool(cls.foreign_names) and words_of(name) in {words_of(foreign) for _, foreign in cls.foreign_names}


def _decode(table: Any) -> dict[ClassIRI, _Names]:
    return {
        str(iri): _Names(str(label), tuple(map(str, others)), tuple((str(tag), str(name)) for tag, name in foreign))
        for iri, (label, others, foreign) in table.items()
    }


def _translate(tbox: TBox) -> dict[ClassIRI, _Names]:
    """Return the names of the classes that have one in another language."""
    untagged = _untagged_language(tbox)
    languages = {cls.iri: _languages_of(cls, untagged) for cls in tbox.classes}
    return {cls.iri: _translate_class(cls, foreign) for cls in tbox.classes if (foreign := languages[cls.iri])}


def _untagged_language(tbox: TBox) -> str | None:
    """Return the language of the names without a tag; None for English.

    More of them reveal it than consist of English nouns. Many reveal none: `Wand` is an English noun, too.
    """
    taxonomy = load_taxonomy()
    names = [(words, language_of(words)) for cls in tbox.classes for _, words in _untagged_names(cls)]
    revealed = Counter(language for _, language in names if language is not None)
    language, count = next(iter(revealed.most_common(1)), (None, 0))
    english = sum(
        found is None and all(taxonomy.singular(word) in taxonomy for word in words) for words, found in names
    )
    return language if count > english else None


def _untagged_names(cls: OntologyClass) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the names without another language's tag, each with its words."""
    tagged = {name for _, name in cls.foreign_names}
    for name in (cls.label, *cls.alt_labels):
        if name not in tagged and (words := words_of(name)):
            yield name, words


def _languages_of(cls: OntologyClass, untagged: str | None) -> dict[str, str]:
    """Return name → language tag, of the names of a class that are in another language."""
    foreign = {name: language for language, name in cls.foreign_names}
    if untagged is not None:
        foreign |= {name: untagged for name, _ in _untagged_names(cls)}
    return foreign


def _translate_class(cls: OntologyClass, foreign: Mapping[str, str]) -> _Names:
    def english(name: str) -> str | None:
        """Return the translation; None for a name that is English or unknown to the glossary."""
        language = foreign.get(name, "").partition("-")[0].lower()
        words = translate(words_of(name), language) if language else None
        return " ".join(words) if words else None

    tagged = tuple(sorted((language, name) for name, language in foreign.items()))
    if cls.label not in foreign:
        # Beside an English label, a foreign name only harms, if it is another English word (“Gift”).
        others = {name for name in cls.alt_labels if english(name) is None or translate(words_of(name)) is not None}
        return _Names(cls.label, tuple(sorted(others)), tagged)
    label = english(cls.label) or cls.label
    # As they are written, too: `Regal_3` is read as English, since “regal” is an English word.
    others = {english(name) or name for name in cls.alt_labels} | foreign.keys()
    return _Names(label, tuple(sorted(others - {label})), tagged)
