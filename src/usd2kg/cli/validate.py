"""usd2kg validate: what is wrong with a graph."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.findings import MOST_OF_A_RULE, findings_text
from usd2kg.cli.options import GraphPlace, JsonOutput, SceneName
from usd2kg.cli.output import emit, print_json, talk
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    from usd2kg.ontology import Closure
    from usd2kg.query import GraphStore
    from usd2kg.validation import ElkAnswer

__all__ = ["validate_command"]


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
        bool, typer.Option("--all", help=f"Show every finding; default: the first {MOST_OF_A_RULE} of each rule.")
    ] = False,
    reasoner: Annotated[
        str | None,
        typer.Option(
            "--reasoner",
            help="Ask a reasoner, too, whether the graph is consistent: elk, which needs Java 17 and its jars; "
            "default: none.",
        ),
    ] = None,
    elk_jars: Annotated[
        Path | None,
        typer.Option("--elk-jars", help="Folder with ELK's jars; default: $USD2KG_ELK_JARS, else build/elk."),
    ] = None,
    reasoner_limit: Annotated[
        float, typer.Option("--reasoner-limit", min=1, help="Seconds after which a reasoner is given up; default: 600.")
    ] = 600,
    scene: SceneName = None,
    json: JsonOutput = False,
) -> None:
    """Check a graph: its shape, against its ontology, and for what is hard to believe. Exit code 1 if it finds any."""
    from usd2kg.stores import open_graph  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.validation import elk_jars as find_elk_jars  # noqa: PLC0415
    from usd2kg.validation import read_rules, validate_graph  # noqa: PLC0415

    if reasoner not in {None, "elk"}:
        raise GraphError(f"reasoner {reasoner!r} is unknown; expected elk")
    if reasoner is not None:
        find_elk_jars(elk_jars)
    chosen = read_rules(rules)
    store = open_graph(graph, scene)
    closure = _open_closure(store, ontology)
    answer = _ask(store, closure, elk_jars, reasoner_limit) if reasoner is not None else None
    report = validate_graph(store, closure, chosen, answer)
    if json:
        print_json(
            {
                "graph": graph,
                "profile": report.profile,
                "objects": report.objects,
                "counts": report.counts(),
                "reasoner": None if answer is None else {"name": "elk", **asdict(answer)},
                "findings": [asdict(finding) for finding in report.findings],
            }
        )
    else:
        most = None if every else MOST_OF_A_RULE
        emit(findings_text(report.findings, report.objects, "object", most), None)
    if report.findings:
        raise typer.Exit(1)


def _open_closure(store: "GraphStore", ontology: Path | None) -> "Closure | None":
    """Return the ontology to check against; None, told on stderr, where the graph names one that is not given."""
    from usd2kg.ontology import read_closure  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.validation import imports_of, ontology_of  # noqa: PLC0415

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


def _ask(store: "GraphStore", closure: "Closure | None", jars: Path | None, limit: float) -> "ElkAnswer":
    """Return what ELK says; what it did not hear, and what is the ontology's own fault, is told on stderr."""
    from usd2kg.ontology import compact_iri  # noqa: PLC0415
    from usd2kg.validation import ask_elk  # noqa: PLC0415

    if closure is None:
        raise GraphError(
            f"{store.source}: a reasoner needs the ontology that it was built with; name it with --ontology"
        )
    answer = ask_elk(store, closure, jars=jars, limit=limit)
    verdict = "consistent" if answer.is_consistent else "inconsistent"
    talk(f"elk: {verdict}; {answer.beyond} of {answer.axioms} axioms are beyond OWL 2 EL and were not heard")
    if answer.impossible:
        named = ", ".join(compact_iri(iri) for iri in answer.impossible)
        talk(f"elk: by the ontology itself {named} can have no member; that matters only to what is of such a class")
    if answer.followers:
        talk(f"elk: {answer.followers} more individuals cannot be only because they are related to those found")
    return answer
