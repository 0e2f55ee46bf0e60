"""usd2kg ontology: what objects can be grounded to."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from usd2kg.cli.findings import MOST_OF_A_RULE, findings_text
from usd2kg.cli.options import JsonOutput
from usd2kg.cli.output import emit, format_table, print_json, talk

if TYPE_CHECKING:
    from usd2kg.ontology import TBox
    from usd2kg.readiness import OntologyReport

__all__ = ["app"]

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Show the classes that objects can be grounded to, and our own terms.",
)

_File = Annotated[
    Path | None, typer.Argument(metavar="[FILE]", help="An OWL file; default: the built-in home ontology.")
]
_Roots = Annotated[
    list[str] | None,
    typer.Option("--root", help="IRI or CURIE of a class; the scope is what lies below. May be repeated."),
]


@app.command("show")
def show(file: _File = None, root: _Roots = None, comments: bool = False, json: JsonOutput = False) -> None:
    """Show the classes in scope as a tree."""
    from usd2kg.ontology import linearize_tree  # noqa: PLC0415

    tbox = _load(file, root)
    if json:
        print_json(_as_json(tbox))
    else:
        emit(linearize_tree(tbox, with_comments=comments), None)


@app.command("linearize")
def linearize(file: _File = None, root: _Roots = None, tree: bool = False) -> None:
    """Print the classes as they are put into a prompt: one a line, alphabetical, or as a tree with --tree."""
    from usd2kg.ontology import linearize_flat, linearize_tree  # noqa: PLC0415

    tbox = _load(file, root)
    emit(linearize_tree(tbox, with_comments=True) if tree else linearize_flat(tbox), None)


@app.command("scope")
def scope(file: _File = None, root: _Roots = None, json: JsonOutput = False) -> None:
    """Print the IRIs of the classes in scope."""
    tbox = _load(file, root)
    iris = [cls.iri for cls in tbox.classes]
    if json:
        print_json(iris)
    else:
        emit("".join(f"{iri}\n" for iri in iris), None)


@app.command("check")
def check(
    file: _File = None,
    root: _Roots = None,
    every: Annotated[
        bool, typer.Option("--all", help=f"Show every finding; default: the first {MOST_OF_A_RULE} of each rule.")
    ] = False,
    json: JsonOutput = False,
) -> None:
    """Say how well an ontology will ground, and what to add. Exit code 1 if it finds an error or a warning."""
    from usd2kg.readiness import check_ontology  # noqa: PLC0415
    from usd2kg.validation import Severity  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    report = check_ontology(_load(file, root))
    if json:
        print_json({**asdict(report), "findings": [asdict(finding) for finding in report.findings]})
    else:
        emit(_readiness_text(report), None)
        emit(findings_text(report.findings, report.classes, "class", None if every else MOST_OF_A_RULE), None)
    if any(finding.severity is not Severity.NOTE for finding in report.findings):
        raise typer.Exit(1)


_Registry = Annotated[
    Path | None, typer.Option("--registry", help="A TOML file of known ontologies; default: our own.")
]


@app.command("known")
def known(registry: _Registry = None, json: JsonOutput = False) -> None:
    """List the ontologies that `ontology fetch` knows by name."""
    from usd2kg.ontology import read_registry  # noqa: PLC0415
    from usd2kg.ontology.fetch import shown_address  # noqa: PLC0415

    ontologies = read_registry(registry).values()
    if json:
        told = [asdict(ontology) for ontology in ontologies]
        for document in (document for ontology in told for document in ontology["documents"]):
            document["address"] = shown_address(document["address"])
        print_json(told)
        return
    rows = [(o.name, o.version, str(len(o.documents)), o.licence, o.title) for o in ontologies]
    emit(format_table(("name", "version", "documents", "licence", "title"), rows), None)


@app.command("fetch")
def fetch(
    name: Annotated[str, typer.Argument(metavar="NAME", help="An ontology that `ontology known` lists.")],
    into: Annotated[
        Path | None, typer.Option("--into", help="Folder for its documents; default: a new one called NAME.")
    ] = None,
    changed: Annotated[
        bool, typer.Option("--changed", help="Take a document though it is not the version that is known.")
    ] = False,
    registry: _Registry = None,
) -> None:
    """Fetch an ontology and what it imports from the network, and print the file to use with --ontology."""
    from usd2kg.errors import OntologyError  # noqa: PLC0415
    from usd2kg.ontology import fetch_ontology, read_registry  # noqa: PLC0415

    ontologies = read_registry(registry)
    if name not in ontologies:
        raise OntologyError(f"ontology {name!r} is not known; expected one of {', '.join(ontologies)}")
    path = fetch_ontology(ontologies[name], into or Path(name), accepts_changed=changed, report=talk)
    emit(f"{path}\n", None)


@app.command("vocabulary")
def vocabulary() -> None:
    """Print the ontology of usd2kg's own terms, as Turtle."""
    from usd2kg.graph import vocabulary_text  # noqa: PLC0415 - loads the RDF parser

    emit(vocabulary_text(), None)


@app.command("shapes")
def shapes(
    profile: Annotated[str, typer.Option("--profile", help="Of which graphs: soma (default) or plain.")] = "soma",
) -> None:
    """Print the SHACL shapes of the graphs that usd2kg builds, as Turtle."""
    from usd2kg.validation import read_shapes  # noqa: PLC0415 - loads the RDF parser

    emit(read_shapes(profile), None)


def _load(file: Path | None, roots: list[str] | None) -> "TBox":
    from usd2kg.ontology import load_home_tbox, load_tbox  # noqa: PLC0415 - loads the OWL parser

    root_iris = roots or None
    tbox = load_tbox(file, roots=root_iris) if file is not None else load_home_tbox(roots=root_iris)
    for note in tbox.notes:
        talk(f"{note.code}: {note.message}")
    talk(f"{tbox.source}: {len(tbox.classes)} classes in scope, {len(tbox.roots)} roots")
    return tbox


def _readiness_text(report: "OntologyReport") -> str:
    """Return what was counted as a table, with a share of the classes where that says more."""
    rows = [
        ("classes with a label of their own", report.labelled),
        ("with a definition or comment", report.described),
        ("with synonyms", report.with_synonyms),
        ("whose meaning is known", report.meant),
        ("found by their name alone", report.found_by_name),
        ("with several superclasses", report.several_parents),
    ]
    table = [(name, f"{count} of {report.classes}", f"{count / report.classes:.0%}") for name, count in rows]
    table += [("roots", str(report.roots), ""), ("deepest class below its root", str(report.depth), "")]
    table += [
        ("deprecated classes", str(report.deprecated), ""),
        ("a thing that fits nowhere is", report.default or "of no class", ""),
    ]
    return format_table(("", "found", "share"), table) + "\n"


def _as_json(tbox: "TBox") -> dict[str, Any]:
    return {
        "source": tbox.source,
        "ontology": tbox.ontology_iri,
        "version": tbox.version_iri,
        "content_hash": tbox.content_hash,
        "imports": list(tbox.imports),
        "classes": [
            {
                "iri": cls.iri,
                "label": cls.label,
                "alt_labels": list(cls.alt_labels),
                "comment": cls.comment,
                "parents": list(cls.parents),
            }
            for cls in tbox.classes
        ],
        "standing_alone": list(tbox.isolated),
        "notes": [{"code": note.code, "message": note.message} for note in tbox.notes],
    }
