"""Labels of classes: token, IRI, superclasses and Wikidata items."""

from collections.abc import Callable
from functools import cache

from usd2kg.errors import OutputError
from usd2kg.labels.model import ClassLabel
from usd2kg.ontology import ClassIRI, OntologyClass, TBox
from usd2kg.words import split_identifier

__all__ = ["LABEL_STYLES", "label_maker"]

LABEL_STYLES = ("local", "label", "snake")
"""Spellings of a class as a token: local name of the IRI, label, or label in snake case."""


def label_maker(tbox: TBox, style: str = "local", *, has_ancestors: bool = False) -> Callable[[ClassIRI], ClassLabel]:
    """Return a cached function from a class IRI to its label.

    Args:
        tbox: the classes.
        style: one of `LABEL_STYLES`.
        has_ancestors: whether the labels include the superclasses.

    Raises:
        OutputError: the style is unknown.
    """
    if style not in LABEL_STYLES:
        raise OutputError(f"class names {style!r} are unknown; expected one of {', '.join(LABEL_STYLES)}")

    @cache
    def make(iri: ClassIRI) -> ClassLabel:
        cls = tbox.by_iri[iri]
        above = sorted(tbox.closure(iri) - {iri}, key=lambda up: (tbox.depths[up], up)) if has_ancestors else []
        return ClassLabel(
            token=_token(cls, style),
            iri=iri,
            local_name=cls.local_name,
            namespace=iri.removesuffix(cls.local_name),
            ancestors=tuple(dict.fromkeys(_token(tbox.by_iri[up], style) for up in above)),
            qcodes=cls.wikidata,
            definition=cls.comment,
            names=frozenset({cls.label, *cls.alt_labels}),
        )

    return make


def _token(cls: OntologyClass, style: str) -> str:
    if style == "local":
        return cls.local_name
    words = split_identifier(cls.label)
    return "_".join(word.lower() for word in words) if style == "snake" and words else cls.label
