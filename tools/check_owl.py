"""Check graphs with the OWL API and HermiT: OWL 2 DL profile and consistency with the imported ontologies.

Usage: python tools/check_owl.py [--reason] [--limit SECONDS] [--ontologies FOLDER] GRAPH...

Needs Java 17 with its compiler, and the jars that `make owl-jars` fetches into build/owl (or $USD2KG_OWL_JARS).
Imports are resolved in the folder of ontologies by its catalog or by file name; nothing is downloaded.
"""

import argparse
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.errors import Usd2kgError
from usd2kg.graph.vocabulary import OWL
from usd2kg.ontology.catalog import find_document
from usd2kg.ontology.documents import parse_document

__all__ = ["Report", "check_owl", "missing_tools"]

ROOT = Path(__file__).parent.parent
_PROGRAM = ROOT / "tools/owl/CheckOwl.java"


class Report(NamedTuple):
    """What the OWL API and HermiT found."""

    violations: tuple[str, ...]
    """Violations of the OWL 2 DL profile in the graph itself, without its imports."""
    missing: tuple[str, ...]
    """IRIs of imports that were not found."""
    axioms: int
    """Logical axioms in the graph itself."""
    verdict: str
    """`consistent`, `inconsistent`, `undecided` after the time limit, or empty if HermiT did not run."""


def jar_folder() -> Path:
    """Return the folder that the jars should be in."""
    return Path(os.environ.get("USD2KG_OWL_JARS", ROOT / "build/owl"))


def missing_tools() -> str:
    """Return what is missing for a check and how to get it; empty if nothing is."""
    if shutil.which("javac") is None:
        return "needs Java 17 with its compiler (javac), which is not on the path"
    if not list(jar_folder().glob("*hermit*.jar")):
        return f"needs the OWL API and HermiT in {jar_folder()}; run make owl-jars"
    return ""


def check_owl(graph: Path, ontologies: Path | None = None, *, reasons: bool = False, limit: int = 900) -> Report:
    """Return what the OWL API and, where `reasons`, HermiT find about a Turtle file.

    Args:
        graph: the file.
        ontologies: folder with the ontologies that it imports.
        reasons: whether HermiT checks consistency; it ignores unknown datatypes, such as those of USD.owl.
        limit: time limit of HermiT in seconds.
    """
    maps = [f"--map={iri}={path}" for iri, path in _documents(graph, ontologies)] if ontologies else []
    command = ["java", "-cp", f"{jar_folder()}/*", str(_PROGRAM), *maps, f"--limit={limit}"]
    command += ["--reason"] if reasons else []
    done = subprocess.run([*command, str(graph)], capture_output=True, text=True, check=True)
    rows = [line.split("\t", 1) for line in done.stdout.splitlines() if "\t" in line]
    found = {kind: tuple(text for name, text in rows if name == kind) for kind, _ in rows}
    return Report(
        violations=found.get("violation", ()),
        missing=found.get("missing", ()),
        axioms=int(found["axioms"][0]),
        verdict=found.get("verdict", ("",))[0],
    )


def _documents(graph: Path, folder: Path) -> Iterator[tuple[str, Path]]:
    """Yield the IRI and the local file of all that a graph imports, directly or not."""
    pending = [quad.object.value for quad in ox.parse(path=str(graph)) if quad.predicate == OWL.imports]
    seen = set()
    while pending:
        iri = pending.pop()
        path = find_document(iri, folder) if iri not in seen else None
        seen.add(iri)
        if path is not None:
            yield iri, path
            pending.extend(parse_document(path).imports)


def main() -> None:
    """Check the graphs; exit with 1 if one is not valid or not consistent."""
    parser = argparse.ArgumentParser(description="Check graphs as the OWL API and HermiT see them.")
    parser.add_argument("graphs", nargs="+", type=Path, metavar="GRAPH")
    parser.add_argument("--ontologies", type=Path, help="folder with the imported ontologies")
    parser.add_argument("--reason", action="store_true", help="check consistency with HermiT")
    parser.add_argument("--limit", type=int, default=900, help="time limit of HermiT in seconds; default: 900")
    arguments = parser.parse_args()
    if problem := missing_tools():
        sys.exit(f"check_owl: {problem}")
    is_good = True
    for graph in arguments.graphs:
        try:
            report = check_owl(graph, arguments.ontologies, reasons=arguments.reason, limit=arguments.limit)
        except (Usd2kgError, subprocess.CalledProcessError) as error:
            sys.exit(f"check_owl: {graph}: {getattr(error, 'stderr', error)}")
        for text in report.violations:
            print(f"{graph}: not OWL 2 DL: {text}")
        for iri in report.missing:
            print(f"{graph}: import <{iri}> was not found; the check ignores it")
        print(f"{graph}: {report.axioms} axioms, {len(report.violations)} violations {report.verdict}".rstrip())
        is_good = is_good and not report.violations and report.verdict in {"", "consistent"}
    sys.exit(0 if is_good else 1)


if __name__ == "__main__":
    main()
