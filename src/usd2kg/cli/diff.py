"""usd2kg diff: what changed between two graphs or scenes."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from usd2kg.cli.carry_options import STAGE_ENDINGS
from usd2kg.cli.groups import with_groups
from usd2kg.cli.options import JsonOutput, OntologyFile, ReadingOptions
from usd2kg.cli.output import emit, print_json, printable, talk
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    import pyoxigraph as ox

    from usd2kg.diff import GraphStyle, ObjectState, Tolerances
    from usd2kg.ontology import TBox
    from usd2kg.relations import RelationOptions
    from usd2kg.scene import ReadOptions

__all__ = ["diff_command"]

_FORMATS = ("text", "json", "sparql")
_MOST = 20


@dataclass(frozen=True)
class _ToleranceOptions:
    """What counts as a change."""

    moved: Annotated[
        float, typer.Option("--moved", help="Metres: what is farther than this from where it was has moved.")
    ] = 0.01
    turned: Annotated[float, typer.Option("--turned", help="Degrees: what is turned by more has turned.")] = 1.0
    resized: Annotated[float, typer.Option("--resized", help="Metres: a side that differs by more is resized.")] = 0.01
    resized_percent: Annotated[
        float, typer.Option("--resized-percent", help="Per cent: a side that differs by more is resized, too.")
    ] = 1.0
    match_within: Annotated[
        float,
        typer.Option(
            "--match-within", help="Metres: so far a thing that has another name is looked for by asset and size."
        ),
    ] = 2.0

    def tolerances(self) -> "Tolerances":
        """Return the same for the comparison."""
        from usd2kg.diff import Tolerances  # noqa: PLC0415 - opens OpenUSD, too slow for --help

        return Tolerances(self.moved, self.turned, self.resized, self.resized_percent, self.match_within)


@with_groups
def diff_command(
    old: Annotated[Path, typer.Argument(metavar="OLD", help="A graph that usd2kg build wrote, or a USD stage.")],
    new: Annotated[Path, typer.Argument(metavar="NEW", help="The same of later; either may be a graph or a stage.")],
    tolerances: _ToleranceOptions,
    reading: ReadingOptions,
    file_format: Annotated[
        str,
        typer.Option(
            "--format", help="text (default), json, or sparql: an update that turns the old graph into the new one."
        ),
    ] = "text",
    json: JsonOutput = False,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="File to write; default: stdout.")] = None,
    graph: Annotated[
        str | None,
        typer.Option("--graph", help="IRI of the named graph that the update is for; default: the default graph."),
    ] = None,
    relations: Annotated[
        str,
        typer.Option("--relations", help="Kinds of relations to compare, comma-separated, all or none."),
    ] = "on,inside,part-of,room",
    no_ground: Annotated[
        bool, typer.Option("--no-ground", help="Do not ask for the classes of a stage's objects: quicker.")
    ] = False,
    ontology: OntologyFile = None,
    base: Annotated[
        str | None,
        typer.Option(
            "--base", help="IRI under which a stage's individuals lie; default: that of the graph it is compared with."
        ),
    ] = None,
    every: Annotated[
        bool, typer.Option("--all", help=f"Show every change; default: the first {_MOST} of each kind.")
    ] = False,
) -> None:
    """Tell what changed between two graphs or scenes. Exit code 1 if anything did, as diff has it."""
    from usd2kg.cli.diff_data import changes_data  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.cli.diff_report import report_text  # noqa: PLC0415
    from usd2kg.diff import compare_objects, make_update  # noqa: PLC0415
    from usd2kg.files import check_apart, check_writable  # noqa: PLC0415

    chosen = _format(file_format, is_json=json, graph=graph)
    limits, kinds = tolerances.tolerances(), _kinds(relations)
    if output is not None:
        check_writable(output)
        check_apart([output], [old, new, ontology])
    sides = _Sides(reading.read_options(), ontology, base, kinds, is_grounded=not no_ground)
    before, after = sides.open(old, new)
    if chosen == "sparql":
        update = make_update(before.statements, after.statements, graph)
        _tell_bases(before, after)
        head = f"# {_line(old)} -> {_line(new)}: {update.deleted} statements deleted, {update.inserted} inserted\n"
        emit(head + update.text, output)
        talk(f"{update.deleted} statements deleted, {update.inserted} inserted")
        is_same = not update.text
    else:
        _tell_classes(before, after)
        changes = compare_objects(before.things, after.things, limits, kinds)
        is_same = changes.is_empty
        if chosen == "json":
            print_json(changes_data(changes, limits, str(old), str(new)), output)
        else:
            emit(report_text(changes, limits, f"{_line(old)} → {_line(new)}", None if every else _MOST), output)
    if not is_same:
        raise typer.Exit(1)


def _line(path: Path) -> str:
    return printable(" ".join(str(path).split()))


def _format(file_format: str, *, is_json: bool, graph: str | None) -> str:
    if file_format not in _FORMATS:
        raise GraphError(f"format {file_format!r} is unknown; expected one of {', '.join(_FORMATS)}")
    chosen = "json" if is_json else file_format
    if graph is not None and chosen != "sparql":
        raise GraphError("--graph is about the update; expected it with --format sparql")
    return chosen


def _kinds(text: str) -> frozenset[str]:
    from usd2kg.relations import ALL_KINDS  # noqa: PLC0415

    if text.strip() in {"all", "none"}:
        return frozenset(ALL_KINDS if text.strip() == "all" else ())
    kinds = frozenset(part.strip() for part in text.split(",") if part.strip())
    unknown = sorted(kinds - frozenset(ALL_KINDS))
    if unknown or not kinds:
        found = f"kind {unknown[0]!r} is unknown" if unknown else "no kind is named"
        raise GraphError(f"relations: {found}; expected a list of {', '.join(ALL_KINDS)}, or all, or none")
    return kinds


class _Side(NamedTuple):
    """One of the two that are compared."""

    statements: "frozenset[ox.Triple]"
    things: "tuple[ObjectState, ...]"
    writing: "GraphStyle"


def _tell_bases(before: _Side, after: _Side) -> None:
    bases = before.writing.base, after.writing.base
    if None not in bases and bases[0] != bases[1]:
        talk(
            f"base: the individuals lie under <{bases[0]}> and <{bases[1]}>, so the update replaces nearly everything; "
            "build both with the same --base"
        )


def _tell_classes(before: _Side, after: _Side) -> None:
    if any(thing.classes for thing in before.things) != any(thing.classes for thing in after.things):
        talk("classes: only one side has any, so classes are not compared; relations go by classes, too")


class _Sides:
    """Reads graphs, and builds those of stages as the other side is written."""

    def __init__(
        self,
        options: "ReadOptions",
        ontology: Path | None,
        base: str | None,
        kinds: frozenset[str],
        *,
        is_grounded: bool,
    ) -> None:
        self._options = options
        self._ontology = ontology
        self._base = base
        self._kinds = kinds
        self._is_grounded = is_grounded

    def open(self, old: Path, new: Path) -> tuple[_Side, _Side]:
        """Return both sides."""
        from usd2kg.diff import GraphStyle  # noqa: PLC0415
        from usd2kg.graph.iris import default_base  # noqa: PLC0415

        graphs = {path: _read(path) for path in (old, new) if path.suffix.lower() not in STAGE_ENDINGS}
        writing = next((side.writing for side in graphs.values()), GraphStyle(None, "auto", "owl"))
        writing = writing._replace(base=self._base or writing.base or default_base(str(old)))
        if len({old, new} - graphs.keys()) == 0:
            return graphs[old], graphs[new]
        tbox = self._open_tbox()
        before, after = (graphs.get(path) or self._build(path, tbox, writing) for path in (old, new))
        return before, after

    def _open_tbox(self) -> "TBox":
        from usd2kg.pipeline import open_tbox  # noqa: PLC0415

        tbox = open_tbox(self._ontology)
        for note in tbox.notes:
            talk(f"{note.code}: {note.message}")
        return tbox

    def _build(self, path: Path, tbox: "TBox", writing: "GraphStyle") -> _Side:
        from usd2kg.diff import detect_graph_style, objects_of_graph  # noqa: PLC0415
        from usd2kg.graph import GraphOptions, instantiate  # noqa: PLC0415
        from usd2kg.grounding import ground  # noqa: PLC0415
        from usd2kg.relations import find_relations  # noqa: PLC0415
        from usd2kg.scene import read_scene  # noqa: PLC0415

        scene = read_scene(path, options=self._options)
        grounding = ground(scene, tbox) if self._is_grounded else ground(scene, tbox, "dictionary", paths=())
        graph = instantiate(
            scene,
            tbox,
            grounding,
            base=writing.base,
            profile=writing.profile,
            options=GraphOptions(annotations=writing.annotations),
            relations=find_relations(scene, tbox, grounding, self._relation_options()),
        )
        statements = frozenset(graph.triples)
        return _Side(statements, objects_of_graph(statements, str(path)), detect_graph_style(statements))

    def _relation_options(self) -> "RelationOptions":
        from usd2kg.relations import ALL_KINDS, DEFAULT_KINDS, VIEWPOINT_KINDS, RelationOptions  # noqa: PLC0415

        wanted = {*DEFAULT_KINDS, *self._kinds} - {*VIEWPOINT_KINDS}
        return RelationOptions(kinds=tuple(kind for kind in ALL_KINDS if kind in wanted))


def _read(path: Path) -> _Side:
    from usd2kg.diff import detect_graph_style, objects_of_graph, read_statements  # noqa: PLC0415

    statements = read_statements(path)
    return _Side(statements, objects_of_graph(statements, str(path)), detect_graph_style(statements))
