"""usd2kg diff: the changes between two versions of a scene."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Argument, Option

from usd2kg.cli.limits import CHANGES_PER_KIND
from usd2kg.cli.options.bundles import OptionBundle, check_files, expand_bundles
from usd2kg.cli.options.common import JsonOutput, OntologyFile, TextFile
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.output import count_noun, emit, notify, notify_notes, print_json, to_single_line
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    from usd2kg.diff import Tolerances
    from usd2kg.diff.versions import Version
    from usd2kg.ontology import TBox
    from usd2kg.scene import Scene

__all__ = ["diff_command"]

_FORMATS = ("text", "json", "sparql")


@dataclass(frozen=True)
class _ToleranceOptions(OptionBundle):
    """Differences up to which objects count as unchanged."""

    moved: Annotated[float, Option("--moved", help="Metres; an object displaced by more has moved.")] = 0.01
    turned: Annotated[float, Option("--turned", help="Degrees; an object turned by more has turned.")] = 1.0
    resized: Annotated[
        float, Option("--resized", help="Metres; an object with a side that differs by more is resized.")
    ] = 0.01
    resized_percent: Annotated[
        float, Option("--resized-percent", help="Per cent; an object with a side that differs by more is resized, too.")
    ] = 1.0
    match_within: Annotated[
        float,
        Option("--match-within", help="Metres within which an object with a new path is matched by asset and size."),
    ] = 2.0

    def tolerances(self) -> "Tolerances":
        """Return the tolerances of the comparison.

        Raises:
            GraphError: one is negative.
        """
        from usd2kg.diff import Tolerances  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        return Tolerances(self.moved, self.turned, self.resized, self.resized_percent, self.match_within)


@expand_bundles
def diff_command(
    old: Annotated[
        Path, Argument(metavar="OLD", help="Earlier version: a graph written by usd2kg build, or a USD stage.")
    ],
    new: Annotated[Path, Argument(metavar="NEW", help="Later version: a graph or a stage.")],
    tolerances: _ToleranceOptions,
    reading: StageOptions,
    file_format: Annotated[
        str, Option("--format", help="text, json, or sparql: an update that turns the old graph into the new one.")
    ] = "text",
    json: JsonOutput = False,
    output: TextFile = None,
    graph: Annotated[
        str | None,
        Option("--graph", help="IRI of the named graph that the update changes; default: the default graph."),
    ] = None,
    relation_kinds: Annotated[
        str, Option("--relation-kinds", help="Comma-separated kinds of relations to compare, or all, or none.")
    ] = "on,inside,part-of,room",
    no_ground: Annotated[
        bool, Option("--no-ground", help="Do not ground the objects of a stage; faster, without classes.")
    ] = False,
    ontology: OntologyFile = None,
    base: Annotated[
        str | None,
        Option(
            "--base",
            help="Namespace of the individuals of a stage; default: that of the graph it is compared with, otherwise "
            "derived from the name of OLD.",
        ),
    ] = None,
    every: Annotated[
        bool, Option("--all", help=f"Show every change; default: the first {CHANGES_PER_KIND} of each kind.")
    ] = False,
) -> None:
    """Show the changes between two graphs or scenes. Exit code 1 if there are any, as in diff."""
    # Loads OpenUSD, too slow for --help.
    from usd2kg.cli.diff_json import changes_json  # noqa: PLC0415
    from usd2kg.cli.diff_text import changes_text  # noqa: PLC0415
    from usd2kg.diff import compare_objects  # noqa: PLC0415
    from usd2kg.diff.versions import VersionOptions, read_versions  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415

    file_format = _choose_format(file_format, is_json=json, graph=graph)
    limits, kinds = tolerances.tolerances(), _parse_kinds(relation_kinds)
    if output is not None:
        check_writable(output)
        check_files([output], [old, new, ontology], reading)
    options = VersionOptions(reading.read_options(), kinds, base, is_grounded=not no_ground)
    with show_steps("parse", "read", "ground", "relate", "instantiate", is_wanted=not json):
        before, after = read_versions(old, new, partial(_open_tbox, ontology), options)
    if file_format == "sparql":
        title = f"{to_single_line(str(old))} -> {to_single_line(str(new))}"
        is_same = _write_update(before, after, title, graph, output)
    else:
        if any(thing.classes for thing in before.objects) != any(thing.classes for thing in after.objects):
            notify("classes: only one version has classes, so they are not compared; relations also depend on classes")
        changes = compare_objects(before.objects, after.objects, limits, kinds)
        is_same = changes.is_empty
        if file_format == "json":
            print_json(changes_json(changes, limits, str(old), str(new)), output)
        else:
            title = f"{to_single_line(str(old))} → {to_single_line(str(new))}"
            emit(changes_text(changes, limits, title, is_complete=every), output)
    if not is_same:
        raise typer.Exit(1)


def _choose_format(file_format: str, *, is_json: bool, graph: str | None) -> str:
    if file_format not in _FORMATS:
        raise GraphError(f"format {file_format!r} is unknown; expected one of {', '.join(_FORMATS)}")
    chosen = "json" if is_json else file_format
    if graph is not None and chosen != "sparql":
        raise GraphError("--graph names the graph of an update; use it with --format sparql")
    return chosen


def _parse_kinds(text: str) -> frozenset[str]:
    from usd2kg.relations import ALL_KINDS  # noqa: PLC0415

    if text.strip() in {"all", "none"}:
        return frozenset(ALL_KINDS if text.strip() == "all" else ())
    kinds = frozenset(part.strip() for part in text.split(",") if part.strip())
    unknown = sorted(kinds - frozenset(ALL_KINDS))
    if unknown or not kinds:
        found = f"kind {unknown[0]!r} is unknown" if unknown else "no kind is given"
        raise GraphError(f"--relation-kinds: {found}; expected a list of {', '.join(ALL_KINDS)}, or all, or none")
    return kinds


def _open_tbox(ontology: Path | None, scenes: "Iterable[Scene]", stated: "Iterable[str]") -> "TBox":
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    named = list(stated)
    tbox = open_tbox(ontology, *scenes, stated=named)
    if named and tbox.ontology_iri not in named and tbox.by_iri.keys().isdisjoint(named):
        shortest = min(named, key=lambda iri: (len(iri), iri))
        raise GraphError(
            f"the graph states <{shortest}>, which is not built in; give the ontology of its classes with --ontology, "
            "or leave classes out with --no-ground"
        )
    notify_notes(tbox)
    return tbox


def _write_update(before: "Version", after: "Version", title: str, graph: str | None, output: Path | None) -> bool:
    """Write the SPARQL update, and return whether it is empty."""
    from usd2kg.diff import make_update  # noqa: PLC0415

    update = make_update(before.statements, after.statements, graph)
    bases = before.style.base, after.style.base
    if None not in bases and bases[0] != bases[1]:
        notify(
            f"base: the namespaces of the individuals differ, <{bases[0]}> and <{bases[1]}>, so the update replaces "
            "nearly every statement; build both graphs with the same --base"
        )
    counts = f"{count_noun(update.deleted, 'statement')} deleted, {update.inserted} inserted"
    emit(f"# {title}: {counts}\n{update.text}", output)
    notify(counts)
    return not update.text
