"""Modelling profiles: `soma` with the patterns of SOMA, DUL and USD.owl, and `plain` for any ontology.

The soma profile was checked with HermiT against SOMA 5d27187, DUL and USD.owl: a Stage has members, since parts would
be inconsistent, and objects never share quality nodes.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import pyoxigraph as ox

from usd2kg.graph.color import knowrob_color, plain_color, usd_color
from usd2kg.graph.joint_patterns import JointIndividual, plain_joint, soma_joint
from usd2kg.graph.physical_properties import plain_properties, shared_properties, soma_properties
from usd2kg.graph.relation_patterns import plain_relation, soma_relation
from usd2kg.graph.vocabulary import DUL, SOMA, U2K, USD, Triple
from usd2kg.relations import Relation
from usd2kg.scene import SceneObject

__all__ = ["Profile", "plain_profile", "soma_profile", "uses_soma"]

ObjectPattern = Callable[[SceneObject, ox.NamedNode], Iterator[Triple]]


@dataclass(frozen=True)
class Profile:
    """Classes, properties and patterns that map scene objects, joints and relations to one vocabulary."""

    name: str
    imports: tuple[str, ...]
    """Ontologies to import in addition to the user's."""
    object_class: ox.NamedNode
    """Class of every object."""
    stage_class: ox.NamedNode
    membership: ox.NamedNode
    """Property from the stage to its objects."""
    has_joint: ox.NamedNode
    """Property from an object to a joint within it."""
    object_patterns: tuple[ObjectPattern, ...]
    """Size, pose, mass and colour."""
    describe_joint: Callable[[JointIndividual], Iterator[Triple]]
    describe_relation: Callable[[Relation, ox.NamedNode, ox.NamedNode], list[Triple]]
    """Triples of a spatial relation from target to anchor; the first one is annotated."""

    def describe(self, obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
        """Yield the size, pose, mass and colour of an object."""
        for pattern in self.object_patterns:
            yield from pattern(obj, node)


def soma_profile(colors: str) -> Profile:
    """Return the profile with SOMA, DUL, USD.owl and KnowRob terms; `colors` is one of `options.COLORS`."""
    color = knowrob_color if colors == "knowrob" else usd_color
    return Profile(
        name="soma",
        imports=("http://www.ease-crc.org/ont/SOMA-OBJ.owl", "https://ease-crc.org/ont/USD.owl"),
        object_class=USD.Prim,
        stage_class=USD.Stage,
        membership=DUL.hasMember,
        has_joint=SOMA.hasPhysicalComponent,
        object_patterns=(soma_properties, shared_properties, color),
        describe_joint=soma_joint,
        describe_relation=soma_relation,
    )


def plain_profile() -> Profile:
    """Return the profile with u2k datatype properties directly on the object, for any ontology."""
    return Profile(
        name="plain",
        imports=(),
        object_class=U2K.Object,
        stage_class=U2K.Stage,
        membership=U2K.hasObject,
        has_joint=U2K.hasJoint,
        object_patterns=(plain_properties, shared_properties, plain_color),
        describe_joint=plain_joint,
        describe_relation=plain_relation,
    )


def uses_soma(iris: Iterable[str]) -> bool:
    """Return whether any of the IRIs is a term of SOMA or DUL."""
    return any(iri.startswith((SOMA.iri, DUL.iri)) for iri in iris)
