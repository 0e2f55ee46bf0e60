"""ask_elk: check whether a graph is consistent with its ontology, by the reasoner ELK in a Java subprocess.

ELK (Kazakov, Krötzsch and Simančík, The Incredible ELK, 2014) decides OWL 2 EL and ignores axioms beyond it. An
inconsistency that it reports is real; a graph that it calls consistent can still contradict an ignored axiom.
"""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.resources import as_file, files
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.declarations import vocabulary_triples
from usd2kg.graph.vocabulary import OWL
from usd2kg.ontology import Closure, compact_iri, without_header
from usd2kg.ontology.model import local_name
from usd2kg.query.graph_store import GraphStore

__all__ = ["ElkAnswer", "ElkClash", "ask_elk", "elk_jars"]

JARS_VARIABLE = "USD2KG_ELK_JARS"
_DEFAULT_JARS = Path("build/elk")
_TIMEOUT_S = 600.0
_MAX_SHOWN = 300
"""Maximum length of a Java error in a message, in characters."""


@dataclass(frozen=True)
class ElkClash:
    """An individual whose assertions contradict the ontology."""

    iri: str
    statements: tuple[str, ...]
    """A minimal inconsistent set of assertions about the individual, in words."""
    impossible: str | None
    """The unsatisfiable class that alone explains the contradiction; None if there is none."""


@dataclass(frozen=True)
class ElkAnswer:
    """The result of ELK for a graph."""

    is_consistent: bool
    axioms: int
    """Number of logical axioms of the graph, its ontology and the u2k vocabulary."""
    beyond: int
    """Number of those axioms that are beyond OWL 2 EL, which ELK ignores."""
    impossible: tuple[str, ...]
    """IRIs of the classes that are unsatisfiable by the ontology and the vocabulary alone, sorted."""
    clashes: tuple[ElkClash, ...]
    """Contradictory individuals by IRI; empty if the graph is consistent, or no single individual is contradictory."""
    followers: int
    """Number of individuals that are contradictory only through their relations to those in `clashes`."""


def elk_jars(folder: Path | None) -> Path:
    """Return the folder with ELK: the given one, $USD2KG_ELK_JARS, or build/elk in the working directory.

    Raises:
        GraphError: Java's compiler or ELK is missing.
    """
    if shutil.which("java") is None or shutil.which("javac") is None:
        raise GraphError(
            "reasoner elk: java or javac is not on the path; expected Java 17 or later with its compiler "
            "(on Debian: apt-get install openjdk-17-jdk-headless)"
        )
    found = folder or Path(os.environ.get(JARS_VARIABLE) or _DEFAULT_JARS)
    if not list(found.glob("elk-owlapi-*.jar")):
        raise GraphError(
            f"reasoner elk: {found} contains no elk-owlapi-*.jar; fetch ELK with Maven (make elk-jars, see "
            f"docs/validation.md), or give its folder with --elk-jars or {JARS_VARIABLE}"
        )
    return found


def ask_elk(graph: GraphStore, closure: Closure, *, jars: Path | None = None, limit: float = _TIMEOUT_S) -> ElkAnswer:
    """Return whether a graph is consistent with its ontology, and otherwise which individuals are contradictory.

    Args:
        graph: the graph.
        closure: the ontology that it was built with, and its imports.
        jars: folder with ELK's jars; by default that of `elk_jars`.
        limit: time limit in seconds.

    Raises:
        GraphError: Java or ELK is missing, fails, or exceeds the time limit.
    """
    folder = elk_jars(jars)
    ontology = dict.fromkeys((*closure.triples, *without_header(vocabulary_triples(), "v")))
    stated = (quad.triple for quad in graph.store if _is_readable(quad))
    with tempfile.TemporaryDirectory() as temporary:
        paths = [Path(temporary) / name for name in ("ontology.ttl", "graph.ttl")]
        _write(paths[0], ontology)
        _write(paths[1], dict.fromkeys((*ontology, *stated)))
        return _read_answer(_run(graph.source, folder, paths, limit))


def _is_readable(quad: ox.Quad) -> bool:
    """Return whether to pass a statement to the OWL API, which lacks RDF 1.2 and would resolve imports."""
    return quad.predicate != OWL.imports and not isinstance(quad.object, ox.Triple)


def _write(path: Path, triples: Iterable[ox.Triple]) -> None:
    with path.open("wb") as file:
        ox.serialize(triples, file, format=ox.RdfFormat.TURTLE)


def _run(source: str, jars: Path, paths: list[Path], limit: float) -> str:
    with as_file(files("usd2kg.validation") / "AskElk.java") as program:
        command = ["java", "-cp", f"{jars}/*", str(program), *map(str, paths)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=limit, check=True)
        except subprocess.TimeoutExpired as error:
            raise GraphError(
                f"{source}: the reasoner elk has no result after {limit:g} s; raise --reasoner-limit"
            ) from error
        except subprocess.CalledProcessError as error:
            lines = [line for line in error.stderr.splitlines() if line.strip()] or [f"exit code {error.returncode}"]
            reason = next((line for line in lines if "Exception" in line or "Error" in line), lines[0])
            raise GraphError(
                f"{source}: the reasoner elk failed ({reason[:_MAX_SHOWN]}); expected Java 17 or later, and in {jars} "
                "the jars of make elk-jars"
            ) from error
    return done.stdout


def _read_answer(output: str) -> ElkAnswer:
    rows = [line.split("\t") for line in output.splitlines()]
    impossible = tuple(row[1] for row in rows if row[0] == "impossible")
    numbers = {row[0]: int(row[1]) for row in rows if row[0] in {"axioms", "beyond"}}
    assertions: dict[str, list[list[str]]] = {row[1]: [] for row in rows if row[0] == "clash"}
    for row in rows:
        if row[0] in {"type", "relation"}:
            assertions[row[1]].append(row)
    return ElkAnswer(
        is_consistent=["verdict", "consistent"] in rows,
        axioms=numbers["axioms"],
        beyond=numbers["beyond"],
        impossible=impossible,
        clashes=tuple(_clash(iri, statements, set(impossible)) for iri, statements in sorted(assertions.items())),
        followers=sum(row[0] == "follows" for row in rows),
    )


def _clash(iri: str, rows: list[list[str]], impossible: set[str]) -> ElkClash:
    types = [row[2] for row in rows if row[0] == "type"]
    is_sufficient = len(rows) == 1 and len(types) == 1 and types[0] in impossible
    texts = [
        f"it is {compact_iri(row[2])}" if row[0] == "type" else f"{compact_iri(row[2])} {local_name(row[3])}"
        for row in rows
    ]
    return ElkClash(iri, tuple(texts), types[0] if is_sufficient else None)
