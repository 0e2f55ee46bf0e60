"""usd2kg validate: what is wrong with a graph."""

from collections.abc import Iterator
from dataclasses import asdict
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.options import GraphPlace, JsonOutput, SceneName
from usd2kg.cli.output import emit, print_json, printable, talk

if TYPE_CHECKING:
    from usd2kg.graph import GraphStore
    from usd2kg.graph.validation import Finding, ValidationReport
    from usd2kg.ontology import Closure

__all__ = ["report_text", "validate_command"]

_MOST = 20


def validate_command(
    graph: GraphPlace,
    ontology: Annotated[
        Path | None,
        typer.Option("--ontology", help="The OWL file that it was built with; default: the built-in home ontology."),
    ] = None,
    rules: Annotated[
        Path | None,
        typer.Option("--rules", help="A TOML file with thresholds, classes and texts in place of our own."),
    ] = None,
    every: Annotated[
        bool, typer.Option("--all", help=f"Show every finding; default: the first {_MOST} of each rule.")
    ] = False,
    scene: SceneName = None,
    json: JsonOutput = False,
) -> None:
    """Check a graph: its shape, against its ontology, and for what is hard to believe. Exit code 1 if it finds any."""
    from usd2kg.graph.stores import open_graph  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.graph.validation import read_rules, validate_graph  # noqa: PLC0415

    chosen = read_rules(rules)
    store = open_graph(graph, scene)
    report = validate_graph(store, _open_closure(store, ontology), chosen)
    if json:
        print_json(
            {
                "graph": graph,
                "profile": report.profile,
                "objects": report.objects,
                "counts": report.counts(),
                "findings": [asdict(finding) for finding in report.findings],
            }
        )
    else:
        emit(report_text(report, None if every else _MOST), None)
    if report.findings:
        raise typer.Exit(1)


def _open_closure(store: "GraphStore", ontology: Path | None) -> "Closure | None":
    """Return the ontology to check against; None, told on stderr, where the graph names one that is not given."""
    from usd2kg.graph.validation import imports_of, ontology_of  # noqa: PLC0415
    from usd2kg.ontology import read_closure  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    tbox = open_tbox(ontology)
    stated = ontology_of(store)
    if stated is not None and stated != tbox.ontology_iri:
        if ontology is None:
            talk(f"ontology: the graph was built with <{stated}>; name its file with --ontology to check against it")
            return None
        talk(f"ontology: the graph was built with <{stated}>, and {ontology} is <{tbox.ontology_iri}>")
    closure = read_closure(tbox, imports_of(store))
    for iri in closure.missing:
        talk(f"missing-import: <{iri}> is not at hand, so what it states is not checked; name its file with --ontology")
    return closure


def report_text(report: "ValidationReport", most: int | None = None) -> str:
    """Return findings as groups of lines, at most `most` of each rule, and a last line that counts them all."""
    blocks = []
    for _, group in groupby(report.findings, key=lambda finding: (finding.severity, finding.rule)):
        findings = list(group)
        blocks += ["\n".join(_lines(finding)) for finding in findings[:most]]
        rest = len(findings) - len(findings[:most])
        if rest:
            blocks.append(f"… {rest} more of {findings[0].rule} (--all shows them)")
    return "\n\n".join([*blocks, _count(report)]) + "\n"


def _lines(finding: "Finding") -> Iterator[str]:
    who = f"{_line(finding.label)} {_line(finding.prim_path)}".strip() or _line(finding.iri)
    yield f"{finding.severity} [{finding.rule}] {who}"
    yield f"  found:    {_line(finding.found)}"
    yield f"  expected: {_line(finding.expected)}"
    yield f"  do:       {_line(finding.advice)}"


def _line(text: str) -> str:
    return printable(" ".join(text.split()))


def _count(report: "ValidationReport") -> str:
    total = len(report.findings)
    parts = ", ".join(f"{n} {name}{'' if n == 1 else 's'}" for name, n in report.counts().items() if n)
    objects = f"{report.objects} {'object' if report.objects == 1 else 'objects'}"
    return f"{total} {'finding' if total == 1 else 'findings'}{f' ({parts})' if parts else ''} on {objects}"
