"""usd2kg store: graphs of many scenes in one folder or on one server."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.options import DataAddress, JsonOutput, UpdateAddress
from usd2kg.cli.output import emit, format_table, print_json, talk
from usd2kg.cli.query import query_text
from usd2kg.errors import OutputError, StoreError

if TYPE_CHECKING:
    from usd2kg.stores import NamedGraph, SceneStore

__all__ = ["app", "check_names", "open_place", "store_graphs"]

_Place = Annotated[str, typer.Option("--store", metavar="FOLDER|URL", help="A folder, or the address of a server.")]

app = typer.Typer(no_args_is_help=True, help="Keep the graphs of many scenes in one folder or on one server.")


def open_place(place: str, update: str | None = None, data: str | None = None) -> "SceneStore":
    """Return a store that is ready for graphs, before any work is spent on them."""
    from usd2kg.stores import open_store  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    store = open_store(place, update=update, data=data)
    store.check()
    return store


def store_graphs(store: "SceneStore", graphs: Sequence["NamedGraph"]) -> None:
    """Put graphs into a store, and say so."""
    for graph in graphs:
        store.load(graph)
        talk(f"{store.address}: holds <{graph.iri}>, {len(graph.triples)} triples")


@app.command("load")
def load_command(
    graphs: Annotated[list[Path], typer.Argument(metavar="GRAPH...", help="Graphs that usd2kg build wrote.")],
    place: _Place,
    scene: Annotated[
        str | None,
        typer.Option("--scene", metavar="IRI", help="Name of the graph in the store; default: as it names itself."),
    ] = None,
    update: UpdateAddress = None,
    data: DataAddress = None,
) -> None:
    """Put graphs into a store, each in place of what the store has under its name, as a whole or not at all."""
    from usd2kg.stores import read_named_graph  # noqa: PLC0415

    if scene is not None and len(graphs) > 1:
        raise StoreError("--scene names one graph; expected one file with it, or load the files one by one")
    # All are read before the first is loaded, so that a bad file changes nothing.
    read = [read_named_graph(path, scene) for path in graphs]
    check_names([graph.iri for graph in read])
    store_graphs(open_place(place, update, data), read)


@app.command("list")
def list_command(place: _Place, json: JsonOutput = False) -> None:
    """List the scenes and ontologies of a store."""
    from usd2kg.stores import open_store  # noqa: PLC0415

    store = open_store(place)
    rows = [
        {
            "name": graph.name,
            "kind": "scene" if graph.is_scene else "ontology",
            "objects": graph.count_objects(store.select),
            "triples": graph.count_triples(store.select),
            "label": graph.label,
            "iri": graph.iri,
        }
        for graph in store.graphs()
    ]
    if json:
        print_json(rows)
    else:
        columns = ("name", "kind", "objects", "triples", "iri")
        emit(format_table(columns, [tuple(str(row[column]) for column in columns) for row in rows]), None)


@app.command("remove")
def remove_command(
    scenes: Annotated[list[str], typer.Argument(metavar="SCENE...", help="Scenes, as store list names them.")],
    place: _Place,
    update: UpdateAddress = None,
) -> None:
    """Take scenes out of a store."""
    from usd2kg.stores import choose_graph, open_store  # noqa: PLC0415

    store = open_store(place, update=update)
    graphs = store.graphs()
    for graph in [choose_graph(graphs, scene, place) for scene in scenes]:
        store.remove(graph.iri)
        talk(f"{store.address}: no longer holds <{graph.iri}>")


@app.command("update")
def update_command(
    sparql: Annotated[str, typer.Argument(metavar="UPDATE", help="A SPARQL 1.1 update, or @FILE to read one.")],
    place: _Place,
    update: UpdateAddress = None,
) -> None:
    """Change a store by a SPARQL 1.1 update, all of it or nothing; usual prefixes are known."""
    from usd2kg.stores import open_store  # noqa: PLC0415

    text = query_text(sparql)
    store = open_store(place, update=update)
    store.update(text)
    talk(f"{store.address}: updated")


def check_names(iris: Sequence[str]) -> None:
    """Raise OutputError if two graphs have one name, so that the second would replace the first."""
    twice = sorted({iri for iri in iris if iris.count(iri) > 1})
    if twice:
        raise OutputError(f"two graphs are called <{twice[0]}>, so one would replace the other; build them with --base")
