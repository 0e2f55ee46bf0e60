"""usd2kg ontology: the candidate classes, known ontologies, and usd2kg's own vocabulary."""

from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer import Argument, Option

from usd2kg.cli.finding_text import findings_text
from usd2kg.cli.limits import SUGGESTIONS
from usd2kg.cli.options.bundles import expand_bundles
from usd2kg.cli.options.common import AllFindings, JsonOutput, TextFile
from usd2kg.cli.options.model import ModelName, RequestOptions
from usd2kg.cli.output import Progress, count_noun, emit, notify, notify_notes, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.errors import OntologyError

if TYPE_CHECKING:
    from usd2kg.grounding import Grounder
    from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow
    from usd2kg.ontology import TBox
    from usd2kg.readiness import OntologyReport

__all__ = ["app"]

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Show, check and fetch ontologies, and print the vocabulary and shapes of usd2kg.",
)

_File = Annotated[Path | None, Argument(metavar="[FILE]", help="OWL file; default: the built-in home ontology.")]
_Roots = Annotated[
    list[str] | None,
    Option(
        "--root",
        help="Class (IRI, CURIE, name or label); the scope is it with its subclasses. Repeatable; default: all.",
    ),
]
_Registry = Annotated[
    Path | None, Option("--registry", help="TOML file of known ontologies; default: the built-in list.")
]


@app.command("show")
def show_command(
    file: _File = None,
    root: _Roots = None,
    comments: Annotated[bool, Option(help="Show the comments of the classes; default: names only.")] = False,
    json: JsonOutput = False,
) -> None:
    """Show the classes in scope as a tree."""
    from usd2kg.ontology import linearize_tree  # noqa: PLC0415

    tbox = _load(file, root)
    if json:
        print_json(_tbox_json(tbox))
    else:
        emit(linearize_tree(tbox, with_comments=comments))


@app.command("linearize")
def linearize_command(
    file: _File = None,
    root: _Roots = None,
    tree: Annotated[bool, Option(help="Print a tree; default: an alphabetical list.")] = False,
) -> None:
    """Print the classes in scope as in the prompt of a language model, one on each line."""
    from usd2kg.ontology import linearize_flat, linearize_tree  # noqa: PLC0415

    tbox = _load(file, root)
    emit(linearize_tree(tbox, with_comments=True) if tree else linearize_flat(tbox))


@app.command("scope")
def scope_command(file: _File = None, root: _Roots = None, json: JsonOutput = False) -> None:
    """Print the IRIs of the classes in scope."""
    tbox = _load(file, root)
    iris = [cls.iri for cls in tbox.classes]
    if json:
        print_json(iris)
    else:
        emit("".join(f"{iri}\n" for iri in iris))


@app.command("check")
def check_command(
    file: _File = None, root: _Roots = None, every: AllFindings = False, json: JsonOutput = False
) -> None:
    """Report how well an ontology suits grounding, and what to add. Exit code 1 if there are errors or warnings."""
    from usd2kg.readiness import check_ontology  # noqa: PLC0415
    from usd2kg.validation import Severity  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    report = check_ontology(_load(file, root))
    if json:
        print_json({**asdict(report), "findings": [asdict(finding) for finding in report.findings]})
    else:
        emit(_report_text(report))
        emit(findings_text(report.findings, report.classes, "class", is_complete=every))
    if any(finding.severity is not Severity.NOTE for finding in report.findings):
        raise typer.Exit(1)


@app.command("align")
@expand_bundles
def align_command(
    requests: RequestOptions,
    file: _File = None,
    root: _Roots = None,
    output: TextFile = None,
    model: ModelName = None,
    subclasses: Annotated[
        Path | None,
        Option(
            "--subclasses",
            help="OWL file of suggested subclasses to write, for objects in the scenes that only have a coarse class.",
        ),
    ] = None,
    scenes: Annotated[
        list[Path] | None, Option("--scene", metavar="SCENE", help="USD stage for --subclasses. Repeatable.")
    ] = None,
) -> None:
    """Write an alignment of concepts and words with classes, as SSSOM to edit and to pass to --alignment.

    With --model, a language model names the members of each class; its rows take precedence over the built ones.
    """
    from usd2kg.files import check_apart, check_writable  # noqa: PLC0415
    from usd2kg.grounding.lexical.grounder import LexicalGrounder  # noqa: PLC0415

    if (subclasses is None) != (not scenes):
        raise OntologyError("ontology align: --subclasses and --scene require each other; expected both or neither")
    targets = [path for path in (output, subclasses) if path is not None]
    check_apart(targets, [file, *(scenes or [])])
    for target in targets:
        check_writable(target)
    if model is None:
        requests.check_without_model()
    tbox = _load(file, root)
    grounder = LexicalGrounder()
    if requests.dry_run:
        _print_questions(tbox, output)
        return
    if subclasses is not None:
        _suggest_classes(tbox, grounder, scenes or [], subclasses)
    if output is not None or subclasses is None:
        rows = _ask_model(model, requests, tbox) if model is not None else []
        emit(grounder.format_alignment(tbox, rows), output)


def _print_questions(tbox: "TBox", output: Path | None) -> None:
    """Print the prompts about the classes, and to stderr their number and estimated tokens."""
    from usd2kg.cli.model_report import print_requests  # noqa: PLC0415
    from usd2kg.grounding.llm.class_members import plan_questions  # noqa: PLC0415
    from usd2kg.grounding.llm.estimates import estimate_input  # noqa: PLC0415

    questions = [question.request for question in plan_questions(tbox)]
    print_requests(questions, output)
    tokens = sum(map(estimate_input, questions))
    notify(f"{count_noun(len(questions), 'prompt')} about {len(tbox.classes)} classes, about {tokens:,} input tokens")


def _ask_model(model: str, requests: RequestOptions, tbox: "TBox") -> "list[AlignmentRow]":
    """Return alignment rows from a model's answers about the members of each class, and print their cost to stderr."""
    from usd2kg.cli.model_report import report_prompts  # noqa: PLC0415
    from usd2kg.grounding.lexical.alignment.member_rows import rows_of_members  # noqa: PLC0415
    from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy  # noqa: PLC0415
    from usd2kg.grounding.llm.batch_jobs.queue import Reporting  # noqa: PLC0415
    from usd2kg.grounding.llm.class_members import ask_members, plan_questions  # noqa: PLC0415
    from usd2kg.grounding.llm.factory import open_metered_client  # noqa: PLC0415

    with (
        Progress() as progress,
        open_metered_client(requests.settings(model), Reporting(progress.say, progress.show)) as client,
    ):
        progress.follow(client.report)
        questions = plan_questions(tbox)
        members, problems = ask_members(client, questions, workers=requests.concurrency, progress=progress.update)
        rows = list(rows_of_members(members, client.model, tbox, load_taxonomy()))
        for problem, count in Counter(problems).items():
            notify(f"{count_noun(count, 'prompt')} without all answers: {problem}")
        notify(f"{len(rows)} rows about {len(members)} of {len(tbox.classes)} classes by {client.model}")
        report_prompts(client.report)
    return rows


def _suggest_classes(tbox: "TBox", grounder: "Grounder", scenes: list[Path], target: Path) -> None:
    """Write suggested subclasses, and print the first of them to stderr."""
    from usd2kg.grounding import ground  # noqa: PLC0415
    from usd2kg.readiness import format_suggestions, suggest_classes  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    suggested = suggest_classes((ground(read_scene(scene), tbox, grounder) for scene in scenes), tbox)
    emit(format_suggestions(suggested, tbox), target)
    for one in suggested[:SUGGESTIONS]:
        parent = tbox.by_iri[one.parent].readable_name
        notify(f"  {count_noun(len(one.objects), 'object')}: {one.label} ⊑ {parent}, like {one.objects[0]}")
    notify(f"{count_noun(len(suggested), 'suggested class')} written to {target}")


@app.command("known")
def known_command(registry: _Registry = None, json: JsonOutput = False) -> None:
    """List the ontologies that `ontology fetch` can download or for which usd2kg ships an alignment."""
    from usd2kg.download import shown_address  # noqa: PLC0415
    from usd2kg.grounding.lexical.alignment.member_lists import count_listed_classes  # noqa: PLC0415
    from usd2kg.ontology import read_registry  # noqa: PLC0415

    ontologies = read_registry(registry).values()
    listed = count_listed_classes()
    if json:
        entries = [{**asdict(ontology), "aligned_classes": listed.get(ontology.name, 0)} for ontology in ontologies]
        for document in (document for entry in entries for document in entry["documents"]):
            document["address"] = shown_address(document["address"])
        print_json(entries)
        return
    rows = [
        (
            o.name,
            o.version,
            "built in" if o.built_in else str(len(o.documents) or "–"),
            str(listed.get(o.name, "–")),
            o.licence,
            o.title,
        )
        for o in ontologies
    ]
    emit(format_table(("name", "version", "documents", "aligned classes", "licence", "title"), rows))


@app.command("fetch")
def fetch_command(
    name: Annotated[str, Argument(metavar="NAME", help="Name of an ontology, as listed by `ontology known`.")],
    into: Annotated[
        Path | None, Option("--into", help="Folder for the documents; default: a new folder called NAME.")
    ] = None,
    changed: Annotated[
        bool, Option("--changed", help="Accept documents that differ from the known version; default: reject them.")
    ] = False,
    registry: _Registry = None,
) -> None:
    """Download an ontology with its imports, and print the file to use with --ontology."""
    from usd2kg.ontology import fetch_ontology, read_registry  # noqa: PLC0415

    ontologies = read_registry(registry)
    if name not in ontologies:
        raise OntologyError(f"ontology {name!r} is unknown; expected one of {', '.join(ontologies)}")
    path = fetch_ontology(ontologies[name], into or Path(name), accepts_changed=changed, report=notify)
    emit(f"{path}\n")


@app.command("vocabulary")
def vocabulary_command() -> None:
    """Print the usd2kg vocabulary, an OWL ontology, as Turtle."""
    from usd2kg.graph import vocabulary_text  # noqa: PLC0415 - loads the RDF parser

    emit(vocabulary_text())


@app.command("shapes")
def shapes_command(
    profile: Annotated[str, Option("--profile", help="Profile of the graphs: soma or plain.")] = "soma",
) -> None:
    """Print the SHACL shapes of the graphs that usd2kg builds, as Turtle."""
    from usd2kg.validation import read_shapes  # noqa: PLC0415 - loads the RDF parser

    emit(read_shapes(profile))


def _load(file: Path | None, roots: list[str] | None) -> "TBox":
    from usd2kg.ontology import load_home_tbox, load_tbox  # noqa: PLC0415 - loads the OWL parser
    from usd2kg.progress import show_steps  # noqa: PLC0415

    root_iris = roots or None
    with show_steps("ontology"):
        tbox = load_tbox(file, roots=root_iris) if file is not None else load_home_tbox(roots=root_iris)
    notify_notes(tbox)
    counts = f"{count_noun(len(tbox.classes), 'class')} in scope, {count_noun(len(tbox.roots), 'root')}"
    notify(f"{tbox.source}: {counts}")
    return tbox


def _report_text(report: "OntologyReport") -> str:
    """Return the counts of a readiness report as a table, with their share of the classes."""
    shares = [
        ("classes with a label of their own", report.labelled),
        ("with a definition or comment", report.described),
        ("with synonyms", report.with_synonyms),
        ("with a known meaning", report.meant),
        ("found by their name alone", report.found_by_name),
        ("with several superclasses", report.several_parents),
    ]
    rows = [(name, f"{count} of {report.classes}", f"{count / report.classes:.0%}") for name, count in shares]
    rows += [
        ("roots", str(report.roots), ""),
        ("largest depth below a root", str(report.depth), ""),
        ("deprecated classes", str(report.deprecated), ""),
        ("residual class", report.default or "none", ""),
    ]
    return format_table(("", "found", "share"), rows) + "\n"


def _tbox_json(tbox: "TBox") -> dict[str, Any]:
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
