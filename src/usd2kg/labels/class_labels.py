"""What labels say of a class: its name as a token, its IRI, its Wikidata items, the classes above it."""

from collections.abc import Callable
from functools import cache

from usd2kg.errors import OutputError
from usd2kg.labels.model import ClassLabel
from usd2kg.ontology import ClassIRI, OntologyClass, TBox
from usd2kg.words import split_identifier

__all__ = ["LABEL_STYLES", "label_maker"]

LABEL_STYLES = ("local", "label", "snake")
"""How a class is written as a token: the end of its IRI, its label, or its label in lower case with underscores."""


def label_maker(tbox: TBox, style: str = "local", *, has_ancestors: bool = False) -> Callable[[ClassIRI], ClassLabel]:
    """Return a function from the IRI of a class to what labels say of it.

    Args:
        tbox: the classes.
        style: one of `LABEL_STYLES`.
        has_ancestors: whether the classes above are written, too.

    Raises:
        OutputError: there is no such style.
    """
    if style not in LABEL_STYLES:
        raise OutputError(f"class names {style!r} are unknown; expected one of {', '.join(LABEL_STYLES)}")

    def token(cls: OntologyClass) -> str:
        if style == "local":
            return cls.local_name
        parts = split_identifier(cls.label)
        return "_".join(part.lower() for part in parts) if style == "snake" and parts else cls.label

    @cache
    def make(iri: ClassIRI) -> ClassLabel:
        cls = tbox.by_iri[iri]
        above = sorted(tbox.closure(iri) - {iri}, key=lambda up: (tbox.depths[up], up)) if has_ancestors else []
        return ClassLabel(
            token=token(cls),
            iri=iri,
            concept=cls.local_name,
            namespace=iri.removesuffix(cls.local_name),
            above=tuple(dict.fromkeys(token(tbox.by_iri[up]) for up in above)),
            qcodes=cls.wikidata,
            definition=cls.comment,
            names=frozenset({cls.label, *cls.alt_labels}),
        )

    return make
