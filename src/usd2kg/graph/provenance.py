"""PROV-O description of the run: activity, inputs and software agent."""

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import pyoxigraph as ox

from usd2kg.convert import Origin
from usd2kg.graph.iris import individual_iri
from usd2kg.graph.physical_properties import declare_individual
from usd2kg.graph.vocabulary import (
    PREFIXES,
    PROV,
    RDF,
    RDFS,
    SHACL,
    U2K,
    XSD,
    Triple,
    named_node,
    number,
    text,
)
from usd2kg.grounding import Grounding
from usd2kg.ontology import TBox
from usd2kg.scene import Scene

__all__ = [
    "declare_prefixes",
    "describe_ontology",
    "describe_origin",
    "describe_run",
    "describe_scene",
    "describe_software",
]


def describe_run(
    run: ox.NamedNode,
    grounding: Grounding,
    used: tuple[ox.NamedNode, ...],
    software: ox.NamedNode,
    time: datetime | None,
) -> Iterator[Triple]:
    """Yield the prov:Activity with its inputs, agent, grounder settings and end time, if any."""
    yield from declare_individual(run, PROV.Activity)
    yield run, RDFS.label, text(f"Grounding of {Path(grounding.scene).name}")
    for entity in used:
        yield run, PROV.used, entity
    yield run, PROV.wasAssociatedWith, software
    yield run, U2K.grounder, text(grounding.grounder)
    for name, value in sorted(grounding.settings.items()):
        yield run, U2K.setting, text(f"{name}={value}")
    yield run, U2K.isCalibrated, _boolean(grounding.is_calibrated)
    if time is not None:
        written = time.astimezone(UTC).isoformat().replace("+00:00", "Z")
        yield run, PROV.endedAtTime, ox.Literal(written, datatype=XSD.dateTime)


def describe_software(software: ox.NamedNode, version: str) -> Iterator[Triple]:
    """Yield the prov:SoftwareAgent."""
    yield from declare_individual(software, PROV.SoftwareAgent)
    yield software, RDFS.label, text("usd2kg")
    yield software, U2K.version, text(version)


def describe_ontology(ontology: ox.NamedNode, tbox: TBox) -> Iterator[Triple]:
    """Yield the prov:Entity of the ontology that was read."""
    yield from declare_individual(ontology, PROV.Entity)
    yield ontology, RDFS.label, text(tbox.source if tbox.ontology_iri.startswith("file:") else tbox.ontology_iri)
    for name, iri in (("ontologyIri", tbox.ontology_iri), ("ontologyVersionIri", tbox.version_iri)):
        node = named_node(iri) if iri and not iri.startswith("file:") else None
        if node is not None:
            yield ontology, U2K[name], node
    yield ontology, U2K.contentHash, text(tbox.content_hash)


def declare_prefixes(graph: ox.NamedNode, base: str, tbox: TBox) -> Iterator[Triple]:
    """Yield the prefixes of the user's ontology (SHACL, section 5.2.1), so that queries may use them."""
    for prefix, namespace in tbox.prefixes_beside(PREFIXES).items():
        node = ox.NamedNode(individual_iri(base, "/", f"prefix-{prefix}"))
        yield graph, SHACL.declare, node
        yield node, SHACL.prefix, text(prefix)
        yield node, SHACL["namespace"], ox.Literal(namespace, datatype=XSD.anyURI)


def describe_scene(stage: ox.NamedNode, scene: Scene) -> Iterator[Triple]:
    """Yield the prov:Entity of the stage that was read; the profile adds its other type."""
    yield stage, RDF.type, PROV.Entity
    yield stage, RDFS.label, text(Path(scene.source).name)
    yield stage, U2K.contentHash, text(scene.content_hash)
    yield stage, U2K.upAxis, text(scene.frame.up_axis)
    yield stage, U2K.metresPerUnit, number(scene.frame.metres_per_unit)
    if scene.time is not None:
        yield stage, U2K.timeCode, number(scene.time)


def describe_origin(stage: ox.NamedNode, source: ox.NamedNode, origin: Origin) -> Iterator[Triple]:
    """Yield the prov:Entity of the file that the stage was converted from, and the converter."""
    yield from declare_individual(source, PROV.Entity)
    yield source, RDFS.label, text(origin.source)
    yield source, U2K.contentHash, text(origin.hash)
    yield stage, PROV.wasDerivedFrom, source
    yield stage, U2K.converter, text(origin.converter)


def _boolean(value: bool) -> ox.Literal:
    return ox.Literal("true" if value else "false", datatype=XSD.boolean)
