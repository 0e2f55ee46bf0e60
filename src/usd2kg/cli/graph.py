"""usd2kg graph: diagrams of a graph, and conversion to other formats."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Argument, Option

from usd2kg.cli.options.stores import GraphSource, SceneName
from usd2kg.cli.output import count_noun, notify
from usd2kg.errors import GraphError, OutputError
from usd2kg.files import check_apart, check_writable, write_whole
from usd2kg.tracing import span

if TYPE_CHECKING:
    from usd2kg.graph import PropertyGraph

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, help="Draw and convert graphs.")


@app.command("draw")
def draw_command(
    graph: GraphSource,
    thing: Annotated[
        str | None,
        Argument(metavar="[OBJECT]", help="Object to draw, by label, class or prim path; default: the whole room."),
    ] = None,
    output: Annotated[
        Path | None,
        Option("--output", "-o", help="SVG or PNG file to write; default: GRAPH.svg in the current folder."),
    ] = None,
    scene: SceneName = None,
) -> None:
    """Draw a diagram of the objects on and in each other, for a whole room or around one object, as SVG or PNG."""
    # The stem of a file or folder, or the last part of an IRI or URL.
    name = Path((scene or graph).rstrip("/#")).stem
    target = output or Path(f"{name}.svg")
    if target.suffix.lower() not in {".svg", ".png"}:
        raise OutputError(f"{target}: expected a file name ending in .svg or .png")
    check_writable(target)
    check_apart([target], [graph])
    from usd2kg.diagrams import draw_room, draw_surroundings, to_png  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415

    with show_steps("parse", "draw"):
        store = open_graph(graph, scene)
        with span("draw"):
            if thing is None:
                picture = draw_room(store, name)
            else:
                found = store.find(thing)
                if len(found) > 1:
                    raise GraphError(
                        f"{thing!r} matches {len(found)} objects; expected a prim path, as listed by "
                        f"usd2kg query {graph} where is {thing}"
                    )
                picture = draw_surroundings(store, found[0].value, f"{thing} in {name}")
            content = to_png(picture) if target.suffix.lower() == ".png" else picture.encode("utf-8")
    write_whole(target, content)
    notify(f"written to {target}")


@app.command("convert")
def convert_command(
    graph: Annotated[
        Path,
        Argument(metavar="GRAPH", help="Graph to read: .ttl, .trig, .nt, .nq, .rdf, .owl or .jsonld, or with .gz."),
    ],
    output: Annotated[
        Path,
        Option(
            "--output",
            "-o",
            help="Graph to write: .ttl, .trig, .nt, .nq, .rdf, .owl, .jsonld, .ofn or .graphml, compressed if .gz "
            "follows.",
        ),
    ],
) -> None:
    """Write a graph in another format, with its statements in the same order where the format allows it."""
    from usd2kg.graph import graph_format, read_document, write_graph  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415

    graph_format(output)
    check_writable(output)
    check_apart([output], [graph])
    with show_steps("parse", "write"):
        document = read_document(graph)
        write_graph(document, output)
    notify(f"{len(document.triples)} triples written to {output}")


@app.command("export")
def export_command(
    graph: Annotated[Path, Argument(metavar="GRAPH", help="Graph written by usd2kg build.")],
    target: Annotated[
        str,
        Option(
            "--to",
            help="What to export: neo4j (a property graph), tf (static transforms of ROS 2) or ros2 (detections and "
            "their relations).",
        ),
    ] = "neo4j",
    output: Annotated[
        Path | None, Option("--output", "-o", help="Folder to write; default: GRAPH-TARGET in the current folder.")
    ] = None,
    frame: Annotated[
        str | None, Option("--frame", help="Id of the world frame, for tf and ros2; default: map.")
    ] = None,
) -> None:
    """Write a graph for another system: a property graph for Neo4j, or messages of ROS 2."""
    from usd2kg.graph import read_document, read_property_graph  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415

    exporter = _EXPORTERS.get(target)
    if exporter is None:
        names = ", ".join(_EXPORTERS)
        raise GraphError(f"--to {target!r} is unknown; expected one of {names}; usd2kg graph convert writes RDF")
    if frame is not None and target == "neo4j":
        raise GraphError("--frame is for --to tf and --to ros2")
    folder = output or Path(f"{graph.stem}-{target}")
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder}: is not a folder; expected a folder for the exported files")

    def read() -> "PropertyGraph":
        return read_property_graph(read_document(graph))

    with show_steps("parse", "export"):
        written = exporter(read, graph, folder, frame or "map")
    notify(written)


_Read = Callable[[], "PropertyGraph"]


def _export_neo4j(read: _Read, source: Path, folder: Path, _frame: str) -> str:
    from usd2kg.graph import write_neo4j  # noqa: PLC0415
    from usd2kg.graph.export.neo4j import NEO4J_FILES  # noqa: PLC0415

    check_apart((folder / name for name in NEO4J_FILES), [source])
    exported = read()
    with span("export"):
        write_neo4j(exported, folder)
    return (
        f"{len(exported.nodes)} nodes and {len(exported.edges)} relationships written to {folder}; "
        "load.cypher loads them"
    )


def _export_tf(read: _Read, source: Path, folder: Path, frame: str) -> str:
    from usd2kg.graph import write_tf  # noqa: PLC0415
    from usd2kg.graph.export.ros.transforms import TF_FILES  # noqa: PLC0415

    check_apart((folder / name for name in TF_FILES), [source])
    exported = read()
    with span("export"):
        count = write_tf(exported, folder, frame)
    return f"{count_noun(count, 'transform')} written to {folder}: {', '.join(TF_FILES)}"


def _export_ros2(read: _Read, source: Path, folder: Path, frame: str) -> str:
    from usd2kg.graph import write_ros2  # noqa: PLC0415
    from usd2kg.graph.export.ros.detections import ROS2_FILES  # noqa: PLC0415

    check_apart((folder / name for name in ROS2_FILES), [source])
    exported = read()
    with span("export"):
        detections, relations = write_ros2(exported, folder, frame)
    counts = f"{count_noun(detections, 'detection')} and {count_noun(relations, 'relation')}"
    return f"{counts} written to {folder}: {', '.join(ROS2_FILES)}"


_EXPORTERS = {"neo4j": _export_neo4j, "tf": _export_tf, "ros2": _export_ros2}
