"""An artificial root that applies to most objects, for TBoxes without such a root."""

from collections.abc import Mapping
from dataclasses import replace

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon, build_lexicon
from usd2kg.grounding.lexical.alignment.residual_class import is_residual
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, OntologyClass, TBox

__all__ = ["NO_CLASS", "NO_CLASS_IRI", "build_rooted_lexicon", "root_synonyms", "with_root"]

NO_CLASS = "no class of the ontology"
NO_CLASS_IRI = f"urn:usd2kg:{NO_CLASS}"
"""IRI of a root added to TBoxes without a general class; it is never an answer."""


def build_rooted_lexicon(
    tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]
) -> tuple[TBox, Lexicon]:
    """Return the TBox with an artificial root that applies to most objects, and its lexicon."""
    lexicon = build_lexicon(tbox, taxonomy, synonyms)
    rooted = with_root(tbox, lexicon.default_class or NO_CLASS_IRI, taxonomy)
    if rooted is tbox:
        return tbox, lexicon
    return rooted, build_lexicon(rooted, taxonomy, root_synonyms(rooted, synonyms))


def root_synonyms(rooted: TBox, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> Mapping[ClassIRI, tuple[str, ...]]:
    """Return the synonyms, with one for the artificial root if all other classes are home classes.

    Without it, the root would turn a TBox of home classes into one with classes of other ontologies.
    """
    is_home = NO_CLASS_IRI in rooted.by_iri and rooted.by_iri.keys() - synonyms.keys() <= {NO_CLASS_IRI}
    return {**synonyms, NO_CLASS_IRI: (NO_CLASS,)} if is_home else synonyms


def with_root(tbox: TBox, default: ClassIRI, taxonomy: Taxonomy) -> TBox:
    """Return the TBox with an artificial root that applies to most objects.

    A TBox without a default class gets an artificial root, `NO_CLASS_IRI`. In a list of labels with a residual class,
    such as `otherprop`, that class becomes the superclass of the other roots.
    """
    if default == NO_CLASS_IRI:
        return _below(tbox, OntologyClass(NO_CLASS_IRI, label=NO_CLASS, alt_labels=(), comment="", parents=()))
    if len(tbox.roots) > 1 and default in tbox.roots and is_residual(tbox.by_iri[default], taxonomy):
        return _below(tbox, tbox.by_iri[default])
    return tbox


def _below(tbox: TBox, root: OntologyClass) -> TBox:
    """Return the TBox with `root`, added if it is missing, as the superclass of all other roots."""
    others = [cls for cls in tbox.classes if cls.iri != root.iri]
    classes = [cls if cls.parents else replace(cls, parents=(root.iri,)) for cls in others]
    return replace(tbox, classes=tuple(sorted([*classes, root], key=lambda cls: cls.iri)))
