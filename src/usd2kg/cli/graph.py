"""usd2kg graph: pictures of a graph, and the same graph in other formats."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.options import GraphPlace, SceneName
from usd2kg.cli.output import talk
from usd2kg.errors import GraphError, OutputError
from usd2kg.files import check_apart, check_writable, write_whole

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, help="Draw and convert graphs.")


@app.command("draw")
def draw(
    graph: GraphPlace,
    thing: Annotated[
        str | None,
        typer.Argument(metavar="[OBJECT]", help="Label, class or prim path of one object; default: the whole room."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="SVG or PNG file to write; default: GRAPH.svg here.")
    ] = None,
    scene: SceneName = None,
) -> None:
    """Draw what stands on and in what in a room, or one object with its surroundings, as SVG or PNG."""
    # The name of a file, of a scene in a store, or of the store.
    name = Path((scene or graph).rstrip("/#")).stem
    target = output or Path(f"{name}.svg")
    if target.suffix.lower() not in {".svg", ".png"}:
        raise OutputError(f"{target}: pictures of graphs are SVG or PNG, expected a name ending in .svg or .png")
    check_writable(target)
    check_apart([target], [graph])
    from usd2kg.diagrams import draw_room, draw_surroundings, to_png  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415

    store = open_graph(graph, scene)
    if thing is None:
        picture = draw_room(store, name)
    else:
        found = store.find(thing)
        if len(found) > 1:
            raise GraphError(
                f"{thing!r} means {len(found)} objects; expected one, by its prim path: "
                f"usd2kg query {graph} where is {thing}"
            )
        picture = draw_surroundings(store, found[0].value, f"{thing} in {name}")
    write_whole(target, to_png(picture) if target.suffix.lower() == ".png" else picture.encode("utf-8"))
    talk(f"written to {target}")


@app.command("convert")
def convert(
    graph: Annotated[
        Path, typer.Argument(metavar="GRAPH", help="A graph: .ttl, .trig, .nt, .nq, .rdf, .owl or .jsonld, maybe .gz.")
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            help="File to write: .ttl, .trig, .nt, .nq, .rdf, .owl, .jsonld, .ofn or .graphml; packed with .gz after "
            "it.",
        ),
    ],
) -> None:
    """Write a graph in another format; the order of its statements stays where the format has one."""
    from usd2kg.graph import graph_format, read_document, write_graph  # noqa: PLC0415

    graph_format(output)
    check_writable(output)
    check_apart([output], [graph])
    document = read_document(graph)
    write_graph(document, output)
    talk(f"{len(document.triples)} triples written to {output}")


@app.command("export")
def export(
    graph: Annotated[Path, typer.Argument(metavar="GRAPH", help="A graph that usd2kg build wrote.")],
    target: Annotated[str, typer.Option("--to", help="The database: neo4j (default).")] = "neo4j",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder to write; default: GRAPH-neo4j here.")
    ] = None,
) -> None:
    """Write a graph as a property graph: nodes.csv, relationships.csv and a script that loads them."""
    from usd2kg.graph import read_document, read_property_graph, write_neo4j  # noqa: PLC0415
    from usd2kg.graph.export.neo4j import NEO4J_FILES  # noqa: PLC0415

    if target != "neo4j":
        raise GraphError(f"--to {target!r} is unknown; expected neo4j, or usd2kg graph convert for files of RDF")
    folder = output or Path(f"{graph.stem}-neo4j")
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder}: is not a folder; expected one for the files of the database")
    check_apart((folder / name for name in NEO4J_FILES), [graph])
    found = read_property_graph(read_document(graph))
    write_neo4j(found, folder)
    counts = f"{len(found.nodes)} nodes and {len(found.edges)} relationships"
    talk(f"{counts} written to {folder}; load.cypher says how to load them")
