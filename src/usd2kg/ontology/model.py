"""The TBox: the classes that objects can be grounded to, and the hierarchy between them."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from usd2kg.errors import OntologyError
from usd2kg.ontology.prefixes import expand_curie

__all__ = ["ClassIRI", "OntologyClass", "OntologyNote", "TBox", "local_name"]

ClassIRI = str
"""An absolute IRI that names a class."""

_NUMBERED = re.compile(r"[A-Za-z]{1,8}[_:-]?\d{3,}")
"""A local name that says nothing: `OBI_0000968`, `ont00000995`."""


def local_name(iri: str) -> str:
    """Return the part of an IRI after its last `#`, `/` or `:`.

    >>> local_name("http://www.ease-crc.org/ont/SOMA.owl#Cup")
    'Cup'
    """
    return iri.rstrip("#/").replace("#", "/").rpartition("/")[2].rpartition(":")[2]


@dataclass(frozen=True, slots=True)
class OntologyClass:
    """One class as the ontology describes it."""

    iri: ClassIRI
    label: str
    """The preferred label, else the local name."""
    alt_labels: tuple[str, ...]
    """Further labels and synonyms, sorted; all those of its equivalents too."""
    comment: str
    """The definition or comment, else that of an equivalent, empty if none."""
    parents: tuple[ClassIRI, ...]
    """Nearest superclasses inside the scope, sorted; none for a root."""
    dispositions: tuple[str, ...] = ()
    """IRIs of the dispositions stated for it or for a superclass (SOMA's `hasDisposition some …`)."""
    equivalents: tuple[ClassIRI, ...] = ()
    """IRIs of the other named classes that are stated to be the same, sorted; none of them is in the scope."""
    wikidata: tuple[str, ...] = ()
    """Wikidata items that the ontology maps it or an equivalent to, by the surest of its statements, by number."""

    @property
    def local_name(self) -> str:
        """The last part of the IRI."""
        return local_name(self.iri)

    @property
    def readable_name(self) -> str:
        """The local name, or the label where that is but a number."""
        return self.label if _NUMBERED.fullmatch(self.local_name) else self.local_name


@dataclass(frozen=True, slots=True)
class OntologyNote:
    """Something about the ontology that a user should know; loading went on."""

    code: str
    """`missing-import`, `cycle`, `deprecated`…"""
    message: str


@dataclass(frozen=True)
class TBox:
    """The classes in scope, sorted by IRI, with their hierarchy."""

    source: str
    """The file as the user named it, or `built-in home TBox`."""
    ontology_iri: str
    """IRI of the ontology that a graph over these classes imports."""
    version_iri: str | None
    content_hash: str
    """`sha256:` over all documents of the imports closure."""
    classes: tuple[OntologyClass, ...]
    imports: tuple[str, ...] = ()
    """IRIs of the other documents of the closure, sorted."""
    notes: tuple[OntologyNote, ...] = ()
    standing_alone: tuple[ClassIRI, ...] = ()
    """Classes of the file that the default scope leaves out, being neither below nor above another, sorted."""

    def __hash__(self) -> int:
        # What is made for a TBox is kept by it, and asked for often; hashing every class would take a millisecond.
        return hash((self.source, self.content_hash, len(self.classes)))

    @cached_property
    def by_iri(self) -> Mapping[ClassIRI, OntologyClass]:
        """IRI → class."""
        return {cls.iri: cls for cls in self.classes}

    @cached_property
    def roots(self) -> tuple[ClassIRI, ...]:
        """The classes without a superclass in the scope, sorted."""
        return tuple(cls.iri for cls in self.classes if not cls.parents)

    @cached_property
    def children(self) -> Mapping[ClassIRI, tuple[ClassIRI, ...]]:
        """IRI → direct subclasses, sorted."""
        found: dict[ClassIRI, list[ClassIRI]] = {cls.iri: [] for cls in self.classes}
        for cls in self.classes:
            for parent in cls.parents:
                found[parent].append(cls.iri)
        return {iri: tuple(subclasses) for iri, subclasses in found.items()}

    @cached_property
    def _closures(self) -> Mapping[ClassIRI, frozenset[ClassIRI]]:
        closures: dict[ClassIRI, frozenset[ClassIRI]] = {}
        # Not recursive: a hierarchy may be deeper than Python's stack.
        for cls in self.classes:
            pending = [cls.iri]
            while pending:
                parents = self.by_iri[pending[-1]].parents
                open_ones = [parent for parent in parents if parent not in closures]
                if open_ones:
                    pending.extend(open_ones)
                    continue
                iri = pending.pop()
                closures[iri] = frozenset({iri}).union(*(closures[parent] for parent in parents))
        return closures

    def closure(self, iri: ClassIRI) -> frozenset[ClassIRI]:
        """Return a class with all its superclasses in the scope (the ↑c of hierarchical measures)."""
        return self._closures[iri]

    def is_subclass(self, iri: ClassIRI, ancestor: ClassIRI) -> bool:
        """Return whether `iri` is `ancestor` or below it."""
        return ancestor in self._closures[iri]

    @cached_property
    def depths(self) -> Mapping[ClassIRI, int]:
        """IRI → longest way up to a root, 0 for a root."""
        depths: dict[ClassIRI, int] = {}
        for iri in sorted(self._closures, key=lambda key: len(self._closures[key])):
            depths[iri] = max((depths[parent] + 1 for parent in self.by_iri[iri].parents), default=0)
        return depths

    def lowest_common_ancestors(self, iris: Iterable[ClassIRI]) -> tuple[ClassIRI, ...]:
        """Return the deepest classes that are above (or equal to) all of `iris`, sorted; maybe none."""
        common = frozenset.intersection(*(self._closures[iri] for iri in iris))
        return tuple(sorted(iri for iri in common if not any(iri in self._closures[other] for other in common - {iri})))

    @cached_property
    def _iri_by_equivalent(self) -> Mapping[ClassIRI, ClassIRI]:
        return {equivalent: cls.iri for cls in self.classes for equivalent in cls.equivalents}

    @cached_property
    def _iris_by_local_name(self) -> Mapping[str, tuple[ClassIRI, ...]]:
        found: dict[str, list[ClassIRI]] = {}
        for cls in self.classes:
            found.setdefault(cls.local_name, []).append(cls.iri)
        others: dict[str, set[ClassIRI]] = {}
        for equivalent, iri in self._iri_by_equivalent.items():
            others.setdefault(local_name(equivalent), set()).add(iri)
        # A class's own name goes before one that it has by an equivalent.
        return {name: tuple(sorted(iris)) for name, iris in (others | found).items()}

    def resolve(self, name: str) -> ClassIRI:
        """Return the class that a person means by an IRI, a CURIE, or a local name unique in the scope.

        The names of an equivalent mean the class that stands for it.

        Raises:
            OntologyError: no class of the scope, or several, go by that name.
        """
        name = name.strip().removeprefix("<").removesuffix(">")
        for candidate in (name, expand_curie(name)):
            if candidate in self.by_iri:
                return candidate
            if candidate in self._iri_by_equivalent:
                return self._iri_by_equivalent[candidate]
        named = self._iris_by_local_name.get(name, ())
        if len(named) == 1:
            return named[0]
        found = f"{len(named)} classes ({', '.join(named)})" if named else "no class"
        raise OntologyError(
            f"{self.source}: {name!r} names {found} of the {len(self.classes)} in scope; "
            "expected an IRI, a CURIE or a unique local name, see usd2kg ontology show"
        )
