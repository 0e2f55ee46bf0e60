"""usd2kg validate: findings on a graph."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Option

from usd2kg.cli.finding_text import findings_text
from usd2kg.cli.options.common import AllFindings, JsonOutput, OntologyFile
from usd2kg.cli.options.stores import GraphSource, SceneName
from usd2kg.cli.output import emit, notify, print_json
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    from usd2kg.ontology import Closure
    from usd2kg.query import GraphStore
    from usd2kg.validation import ElkAnswer

__all__ = ["validate_command"]


def validate_command(
    graph: GraphSource,
    ontology: OntologyFile = None,
    rules: Annotated[
        Path | None,
        Option("--rules", help="TOML file that overrides thresholds, classes and texts; default: the built-in rules."),
    ] = None,
    every: AllFindings = False,
    reasoner: Annotated[
        str | None,
        Option(
            "--reasoner",
            help="Reasoner that checks the consistency of the graph: elk, which needs Java 17 and its jars; default: "
            "none.",
        ),
    ] = None,
    elk_jars: Annotated[
        Path | None,
        Option("--elk-jars", help="Folder with the jars of ELK; default: $USD2KG_ELK_JARS, otherwise build/elk."),
    ] = None,
    reasoner_limit: Annotated[
        float, Option("--reasoner-limit", min=1, help="Seconds after which the reasoner is stopped.")
    ] = 600,
    scene: SceneName = None,
    json: JsonOutput = False,
) -> None:
    """Check a graph: its shapes, its ontology, and its plausibility. Exit code 1 if there are findings."""
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.validation import elk_jars as find_elk_jars  # noqa: PLC0415
    from usd2kg.validation import read_rules, validate_graph  # noqa: PLC0415

    if reasoner not in {None, "elk"}:
        raise GraphError(f"reasoner {reasoner!r} is unknown; expected elk")
    if reasoner is not None:
        find_elk_jars(elk_jars)
    chosen = read_rules(rules)
    with show_steps("parse", "ontology", "validate", is_wanted=not json):
        store = open_graph(graph, scene)
        closure = _open_closure(store, ontology)
        answer = _ask_elk(store, closure, elk_jars, reasoner_limit) if reasoner is not None else None
        report = validate_graph(store, closure, chosen, answer)
    for skipped in report.skipped:
        notify(f"not checked: {', '.join(skipped.rules)}: {skipped.reason}")
    if json:
        print_json(
            {
                "graph": graph,
                "profile": report.profile,
                "objects": report.objects,
                "counts": report.counts(),
                "reasoner": None if answer is None else {"name": "elk", **asdict(answer)},
                "skipped": [skipped._asdict() for skipped in report.skipped],
                "findings": [asdict(finding) for finding in report.findings],
            }
        )
    else:
        emit(findings_text(report.findings, report.objects, "object", is_complete=every))
    if report.findings:
        raise typer.Exit(1)


def _open_closure(store: "GraphStore", ontology: Path | None) -> "Closure | None":
    """Return the ontology to check against, with its imports.

    None, with a message, if the graph states an ontology other than the built-in one and no file is given.
    """
    from usd2kg.ontology import built_in_document, read_closure  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.validation import imports_of, ontology_of  # noqa: PLC0415

    stated = ontology_of(store)
    tbox = open_tbox(ontology, stated=() if stated is None else (stated,))
    if stated is not None and stated != tbox.ontology_iri:
        if ontology is None:
            notify(f"ontology: the graph was built with <{stated}>; name its file with --ontology to check against it")
            return None
        notify(f"ontology: the graph was built with <{stated}>, and {ontology} is <{tbox.ontology_iri}>")
    closure = read_closure(tbox, imports_of(store))
    for iri in closure.missing:
        if ontology is None and built_in_document(iri) is not None:
            notify(
                f"ontology: the built-in ontology stands in for <{iri}>: classes and hierarchy are checked, "
                "disjointness, domains and ranges are not; name its file with --ontology to check them"
            )
        else:
            notify(
                f"missing-import: <{iri}> is not available, its axioms are not checked; name its file with --ontology"
            )
    return closure


def _ask_elk(store: "GraphStore", closure: "Closure | None", jars: Path | None, limit: float) -> "ElkAnswer":
    """Return the answer of ELK; prints unsupported axioms and unsatisfiable classes to stderr."""
    from usd2kg.ontology import compact_iri  # noqa: PLC0415
    from usd2kg.validation import ask_elk  # noqa: PLC0415

    if closure is None:
        raise GraphError(f"{store.source}: the reasoner needs the ontology of the graph; give its file with --ontology")
    answer = ask_elk(store, closure, jars=jars, limit=limit)
    verdict = "consistent" if answer.is_consistent else "inconsistent"
    notify(f"elk: {verdict}; {answer.beyond} of {answer.axioms} axioms are not in OWL 2 EL and were ignored")
    if answer.impossible:
        named = ", ".join(compact_iri(iri) for iri in answer.impossible)
        notify(f"elk: unsatisfiable by the ontology alone: {named}; this affects individuals of these classes only")
    if answer.followers:
        notify(f"elk: {answer.followers} more individuals are inconsistent only through their relations to those found")
    return answer
