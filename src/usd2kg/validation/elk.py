"""ask_elk: whether a graph is consistent with its ontology, as the reasoner ELK sees it, in a Java process of its own.

ELK (Kazakov, Krötzsch and Simančík, The Incredible ELK, 2014) decides OWL 2 EL and does not hear what is beyond it.
What it calls inconsistent is; what it calls consistent may still contradict an axiom that it did not hear.
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
from usd2kg.query.graph_store import GraphStore

__all__ = ["ElkAnswer", "ElkClash", "ask_elk", "elk_jars"]

JARS_VARIABLE = "USD2KG_ELK_JARS"
_DEFAULT_JARS = Path("build/elk")


@dataclass(frozen=True)
class ElkClash:
    """An individual of which too much is said."""

    iri: str
    statements: tuple[str, ...]
    """A smallest set of what the graph says of it that cannot be true together, in words."""
    impossible: str | None
    """The one class that is enough to blame, because the ontology itself lets it have no member; else None."""


@dataclass(frozen=True)
class ElkAnswer:
    """What ELK says of a graph."""

    is_consistent: bool
    axioms: int
    """Logical axioms in the graph, its ontology and our vocabulary."""
    beyond: int
    """AxiomIndex of those that are beyond OWL 2 EL, which ELK does not hear."""
    impossible: tuple[str, ...]
    """IRIs of classes that can have no member, by the ontology and our vocabulary alone, sorted."""
    clashes: tuple[ElkClash, ...]
    """The individuals to blame, by IRI; empty where the graph is consistent, or no single individual is to blame."""
    followers: int
    """Individuals that are lost only because they are related to such."""


def elk_jars(folder: Path | None) -> Path:
    """Return the folder with ELK: the one given, else that of $USD2KG_ELK_JARS, else build/elk here.

    Raises:
        GraphError: Java's compiler or ELK is missing.
    """
    if shutil.which("java") is None or shutil.which("javac") is None:
        raise GraphError(
            "reasoner elk: java and javac are not both on the path; expected Java 17 or later with its compiler "
            "(on Debian: apt-get install openjdk-17-jdk-headless)"
        )
    found = folder or Path(os.environ.get(JARS_VARIABLE) or _DEFAULT_JARS)
    if not list(found.glob("elk-owlapi-*.jar")):
        raise GraphError(
            f"reasoner elk: {found} holds no elk-owlapi-*.jar; fetch ELK there with Maven (make elk-jars, see "
            f"docs/validation.md), or name its folder with --elk-jars or {JARS_VARIABLE}"
        )
    return found


def ask_elk(graph: GraphStore, closure: Closure, *, jars: Path | None = None, limit: float = 600) -> ElkAnswer:
    """Return whether a graph is consistent with its ontology, and if not, which individuals are to blame.

    Args:
        graph: the graph.
        closure: the ontology that it was built with, and what is imported.
        jars: folder with ELK's jars; by default that of `elk_jars`.
        limit: seconds after which it is given up.

    Raises:
        GraphError: Java or ELK is missing, fails, or needs longer than `limit`.
    """
    folder = elk_jars(jars)
    ontology = dict.fromkeys((*closure.triples, *without_header(vocabulary_triples(), "v")))
    stated = (quad.triple for quad in graph.store if _is_heard(quad))
    with tempfile.TemporaryDirectory() as here:
        paths = [Path(here) / name for name in ("ontology.ttl", "graph.ttl")]
        _write(paths[0], ontology)
        _write(paths[1], dict.fromkeys((*ontology, *stated)))
        return _read_answer(_run(graph.source, folder, paths, limit))


def _is_heard(quad: ox.Quad) -> bool:
    """Whether the OWL API reads a statement: it knows no RDF 1.2, and what is imported stands in the same file."""
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
                f"{source}: the reasoner elk has no answer after {limit:g} s; give it longer with --reasoner-limit"
            ) from error
        except subprocess.CalledProcessError as error:
            lines = [line for line in error.stderr.splitlines() if line.strip()] or [f"exit code {error.returncode}"]
            reason = next((line for line in lines if "Exception" in line or "Error" in line), lines[0])
            raise GraphError(
                f"{source}: the reasoner elk failed ({reason[:300]}); expected Java 17 or later, "
                f"and in {jars} what make elk-jars fetches"
            ) from error
    return done.stdout


def _read_answer(output: str) -> ElkAnswer:
    rows = [line.split("\t") for line in output.splitlines()]
    impossible = tuple(row[1] for row in rows if row[0] == "impossible")
    numbers = {row[0]: int(row[1]) for row in rows if row[0] in {"axioms", "beyond"}}
    said: dict[str, list[list[str]]] = {row[1]: [] for row in rows if row[0] == "clash"}
    for row in rows:
        if row[0] in {"type", "relation"}:
            said[row[1]].append(row)
    return ElkAnswer(
        is_consistent=["verdict", "consistent"] in rows,
        axioms=numbers["axioms"],
        beyond=numbers["beyond"],
        impossible=impossible,
        clashes=tuple(_clash(iri, statements, set(impossible)) for iri, statements in sorted(said.items())),
        followers=sum(row[0] == "follows" for row in rows),
    )


def _clash(iri: str, rows: list[list[str]], impossible: set[str]) -> ElkClash:
    types = [row[2] for row in rows if row[0] == "type"]
    is_enough = len(rows) == 1 and len(types) == 1 and types[0] in impossible
    texts = [
        f"it is {compact_iri(row[2])}" if row[0] == "type" else f"{compact_iri(row[2])} {_local_name(row[3])}"
        for row in rows
    ]
    return ElkClash(iri, tuple(texts), types[0] if is_enough else None)


def _local_name(iri: str) -> str:
    return iri.rstrip("/#").replace("#", "/").rpartition("/")[2]
