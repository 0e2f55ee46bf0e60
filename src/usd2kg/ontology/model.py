"""TBox: the candidate classes for objects, and their hierarchy."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from usd2kg.errors import OntologyError
from usd2kg.ontology.prefixes import expand_curie

__all__ = ["ClassIRI", "OntologyClass", "OntologyNote", "TBox", "local_name"]

ClassIRI = str
"""An absolute IRI that names a class."""

_NUMBERED = re.compile(r"[A-Za-z]{1,8}[_:-]?\d{3,}")
"""Local names without meaning: `OBI_0000968`, `ont00000995`."""


def local_name(iri: str) -> str:
    """Return the part of an IRI after its last `#`, `/` or `:`.

    >>> local_name("http://www.ease-crc.org/ont/SOMA.owl#Cup")
    'Cup'
    """
    return iri.rstrip("#/").replace("#", "/").rpartition("/")[2].rpartition(":")[2]


@dataclass(frozen=True, slots=True)
class OntologyClass:
    """One class of an ontology."""

    iri: ClassIRI
    label: str
    """The preferred label, otherwise the local name."""
    alt_labels: tuple[str, ...]
    """Further labels and synonyms, including those of equivalent classes, sorted."""
    comment: str
    """Definition or comment, otherwise that of an equivalent class; empty if there is none."""
    parents: tuple[ClassIRI, ...]
    """Nearest superclasses in the scope, sorted; empty for a root."""
    dispositions: tuple[str, ...] = ()
    """IRIs of the dispositions of the class, inherited ones included (SOMA's `hasDisposition some …`)."""
    equivalents: tuple[ClassIRI, ...] = ()
    """IRIs of equivalent named classes, sorted; none of them is in the scope."""
    wikidata: tuple[str, ...] = ()
    """Wikidata items that the ontology maps the class to, by its strongest mapping property, sorted by number."""
    foreign_names: tuple[tuple[str, str], ...] = ()
    """(language tag, name) of the label and synonyms that are tagged with another language than English, sorted."""

    @property
    def local_name(self) -> str:
        """The last part of the IRI."""
        return local_name(self.iri)

    @property
    def readable_name(self) -> str:
        """The local name, or the label if the local name is a number."""
        return self.label if _NUMBERED.fullmatch(self.local_name) else self.local_name


@dataclass(frozen=True, slots=True)
class OntologyNote:
    """A problem of an ontology that did not stop loading."""

    code: str
    """`missing-import` or `cycle`."""
    message: str


@dataclass(frozen=True)
class TBox:
    """The classes in scope, sorted by IRI, and their hierarchy."""

    source: str
    """File as the user named it, or `built-in home TBox`."""
    ontology_iri: str
    """IRI that a graph over these classes imports."""
    version_iri: str | None
    content_hash: str
    """`sha256:` and a hash over all documents of the imports closure."""
    classes: tuple[OntologyClass, ...]
    imports: tuple[str, ...] = ()
    """IRIs of the other documents of the imports closure, sorted."""
    notes: tuple[OntologyNote, ...] = field(default=(), compare=False)
    prefixes: Mapping[str, str] = field(default_factory=dict, compare=False)
    """Prefix → namespace, as the file declares them, for the namespaces of the classes; sorted by prefix."""
    isolated: tuple[ClassIRI, ...] = ()
    """Classes of the file without any subclass axiom, which the default scope excludes; empty for other scopes."""

    def prefixes_beside(self, known: Mapping[str, str]) -> dict[str, str]:
        """Return the prefixes of this ontology, except names and namespaces of known prefixes."""
        taken = set(known.values())
        return {name: iri for name, iri in self.prefixes.items() if name not in known and iri not in taken}

    def __hash__(self) -> int:
        # TBoxes are cache keys; hashing every class would take a millisecond.
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
        # Iterative: a hierarchy may be deeper than Python's stack.
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
        """Return a class and all its superclasses in the scope (↑c in hierarchical measures)."""
        return self._closures[iri]

    def is_subclass(self, iri: ClassIRI, ancestor: ClassIRI) -> bool:
        """Return whether `iri` is `ancestor` or a subclass of it."""
        return ancestor in self._closures[iri]

    @cached_property
    def depths(self) -> Mapping[ClassIRI, int]:
        """IRI → length of the longest path to a root, 0 for a root."""
        depths: dict[ClassIRI, int] = {}
        for iri in sorted(self._closures, key=lambda key: len(self._closures[key])):
            depths[iri] = max((depths[parent] + 1 for parent in self.by_iri[iri].parents), default=0)
        return depths

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
        # The local name of a class has priority over that of an equivalent class.
        return {name: tuple(sorted(iris)) for name, iris in (others | found).items()}

    @cached_property
    def _iris_by_label(self) -> Mapping[str, tuple[ClassIRI, ...]]:
        found: dict[str, set[ClassIRI]] = {}
        for cls in self.classes:
            if cls.label:
                found.setdefault(cls.label.casefold(), set()).add(cls.iri)
        return {label: tuple(sorted(iris)) for label, iris in found.items()}

    def resolve(self, name: str) -> ClassIRI:
        """Return the class with an IRI, a CURIE, or a local name or else a label that is unique in the scope.

        The name of an equivalent class resolves to its representative.

        Raises:
            OntologyError: no class in scope has that name, or several have.
        """
        name = name.strip().removeprefix("<").removesuffix(">")
        for candidate in (name, expand_curie(name, self.prefixes)):
            if candidate in self.by_iri:
                return candidate
            if candidate in self._iri_by_equivalent:
                return self._iri_by_equivalent[candidate]
        named = self._iris_by_local_name.get(name, ()) or self._iris_by_label.get(name.casefold(), ())
        if len(named) == 1:
            return named[0]
        found = f"{len(named)} classes ({', '.join(named)})" if named else "no class"
        raise OntologyError(
            f"{self.source}: {name!r} names {found} of the {len(self.classes)} in scope; "
            "expected an IRI, a CURIE, or a unique local name or label, see usd2kg ontology show"
        )
