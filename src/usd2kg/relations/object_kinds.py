"""What each object is, for the class lists of the relation rules: its class, and a class of the home vocabulary.

The lists name classes of SOMA-HOME. An ontology that does not build on SOMA says nothing about them, so an object whose
class is not one of the home TBox has a home class as well: the default grounder's, from the same evidence. A wall is
then a wall under every ontology.
"""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import cache

from usd2kg.grounding import (
    EVIDENCE_GROUPS,
    Grounding,
    NamingRegime,
    ObjectView,
    Prediction,
    Status,
    make_grounder,
    view_objects,
)
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox
from usd2kg.scene import Scene

__all__ = ["ObjectKind", "find_kinds"]


@dataclass(frozen=True, slots=True)
class ObjectKind:
    """The classes of one object."""

    own: frozenset[ClassIRI] = frozenset()
    """Its class, its home class if it has one, and the concept that its name means."""
    above: frozenset[ClassIRI] = frozenset()
    """The same with all superclasses and hypernyms."""
    dispositions: frozenset[str] = frozenset()
    """The dispositions that its classes state."""


def find_kinds(scene: Scene, tbox: TBox, grounding: Grounding) -> list[ObjectKind]:
    """Return the kind of each object, in scene order."""
    home = load_home_tbox()
    classes = {
        obj.prim_path: prediction.class_iri if (prediction := grounding.by_path.get(obj.prim_path)) else None
        for obj in scene.objects
    }
    # The user's file may leave out what SOMA says of its own classes, such as dispositions.
    homely: dict[str, ClassIRI | None] = {path: iri for path, iri in classes.items() if iri in home.by_iri}
    if foreign := classes.keys() - homely.keys():
        homely |= _home_classes(scene, tbox, grounding, foreign)

    # Few kinds for many objects, which share them.
    @cache
    def kind_of(iri: ClassIRI | None, home_iri: ClassIRI | None, concept: str | None) -> ObjectKind:
        return _make_kind([(tbox, iri), (home, home_iri)], _with_hypernyms(grounding, concept))

    # An object has no concept where a person's class contradicts it.
    concepts = {p.prim_path: p.concept for p in grounding.predictions}
    return [
        kind_of(classes[obj.prim_path], homely.get(obj.prim_path), concepts.get(obj.prim_path)) for obj in scene.objects
    ]


def _with_hypernyms(grounding: Grounding, concept: str | None) -> tuple[str, ...]:
    """Return the IRIs of a concept and of its hypernyms; none without a concept."""
    if concept is None:
        return ()
    found = [concept]
    for iri in found:
        known = grounding.concepts.get(iri)
        found.extend(above for above in (known.broader if known else ()) if above not in found)
    return tuple(found)


def _make_kind(found: Sequence[tuple[TBox, ClassIRI | None]], concepts: tuple[str, ...]) -> ObjectKind:
    known = [(tbox, iri) for tbox, iri in found if iri is not None]
    return ObjectKind(
        own=frozenset((*(iri for _, iri in known), *concepts[:1])),
        above=frozenset(concepts).union(*(tbox.closure(iri) for tbox, iri in known)),
        dispositions=frozenset().union(*(tbox.by_iri[iri].dispositions for tbox, iri in known)),
    )


def _home_classes(
    scene: Scene, tbox: TBox, grounding: Grounding, paths: AbstractSet[str]
) -> dict[str, ClassIRI | None]:
    """Return prim path → class of the home TBox, by the evidence that the grounding had."""
    regime = NamingRegime(grounding.settings.get("regime", NamingRegime.SEMANTIC))
    groups = grounding.settings.get("evidence")
    evidence = frozenset(groups.split(",")) & EVIDENCE_GROUPS if groups else None
    views = [
        (obj.prim_path, _seen(view, grounding.by_path.get(obj.prim_path), tbox))
        for obj, view in view_objects(scene, regime, evidence)
        if obj.prim_path in paths
    ]
    return {p.prim_path: p.class_iri for p in make_grounder("lexical").ground_views(views, load_home_tbox())}


def _seen(view: ObjectView, prediction: Prediction | None, tbox: TBox) -> ObjectView:
    """Return the evidence about an object; the label of its class if a person chose one that its name does not mean."""
    is_contradicted = prediction is not None and prediction.status is Status.REVIEWED and prediction.concept is None
    if not is_contradicted or prediction is None or prediction.class_iri is None:
        return view
    return ObjectView(name=tbox.by_iri[prediction.class_iri].readable_name, size=view.size)
