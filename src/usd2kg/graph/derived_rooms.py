"""RDF of rooms without a prim: their class, outline, area and origin."""

from collections.abc import Iterable, Iterator, Mapping

import pyoxigraph as ox

from usd2kg.graph.iris import individual_iri
from usd2kg.graph.vocabulary import OWL, PROV, RDF, RDFS, SSSOM, U2K, Triple, number, text
from usd2kg.grounding import ObjectView, make_grounder
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.relations import DerivedRoom
from usd2kg.words import words_of

__all__ = ["derived_room_iri", "describe_derived_room", "room_classes"]


def derived_room_iri(base: str, name: str) -> str:
    """Return the IRI of a room without a prim: a part of the stage, so that it is not the IRI of a prim.

    >>> derived_room_iri("https://my.lab/k/", "living room 2")
    'https://my.lab/k/-living-room-2'
    """
    return individual_iri(base, "/", name.replace(" ", "-"))


def room_classes(names: Iterable[str], tbox: TBox) -> Mapping[str, ClassIRI]:
    """Return name → class of rooms, grounded by name with the default grounder; empty if the TBox has no room class.

    A kitchen is a `Kitchen` if that is a subclass of `Room`, otherwise a `Room`. Classes that also cover other things,
    such as structures, are excluded: they are not specific to rooms.
    """
    asked = ["room", *names]
    views = [(name, ObjectView(name=name)) for name in dict.fromkeys(asked)]
    if len(views) == 1:
        return {}
    found = {p.prim_path: p.class_iri for p in make_grounder("lexical").ground_views(views, tbox)}
    room = found["room"]
    if room is None or words_of(tbox.by_iri[room].readable_name)[-1:] != ("room",):
        return {}
    known = ((name, found[name]) for name in asked[1:])
    return {name: cls if cls is not None and room in tbox.closure(cls) else room for name, cls in known}


def describe_derived_room(
    room: DerivedRoom, node: ox.NamedNode, cls: ClassIRI | None, source: ox.NamedNode, run: ox.NamedNode
) -> Iterator[Triple]:
    """Yield the individual of a room without a prim.

    Args:
        room: the room.
        node: its individual.
        cls: its class in the TBox; None if the TBox has no rooms.
        source: the stage.
        run: the activity.
    """
    yield node, RDF.type, OWL.NamedIndividual
    yield node, RDF.type, U2K.DerivedRoom
    if cls is not None:
        yield node, RDF.type, ox.NamedNode(cls)
    yield node, RDFS.label, text(room.name)
    yield node, U2K.floorOutline, text(_polygon(room))
    yield node, U2K.floorArea, number(room.area)
    yield node, U2K.floorHeight, number(room.height)
    yield node, U2K.rule, text(room.rule)
    yield node, SSSOM.confidence, number(room.confidence)
    yield node, PROV.wasDerivedFrom, source
    yield node, PROV.wasGeneratedBy, run


def _polygon(room: DerivedRoom) -> str:
    """Return the outline as WKT with closed rings."""
    rings = (", ".join(f"{x:.3f} {y:.3f}" for x, y in (*ring, ring[0])) for ring in room.outline)
    return f"POLYGON ({', '.join(f'({ring})' for ring in rings)})"
