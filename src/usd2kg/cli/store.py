"""usd2kg store: graphs of many scenes in a folder or on a server."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.options.stores import DataAddress, RequiredStore, UpdateAddress
from usd2kg.cli.output import emit, notify, print_json
from usd2kg.cli.query import read_sparql
from usd2kg.cli.text_table import format_table
from usd2kg.errors import OutputError, StoreError
from usd2kg.tracing import span

if TYPE_CHECKING:
    from usd2kg.stores import NamedGraph, SceneStore

__all__ = ["app", "check_graph_names", "load_graphs", "open_for_loading"]

app = typer.Typer(no_args_is_help=True, help="Keep the graphs of many scenes in a folder or on a SPARQL server.")


def open_for_loading(place: str, update: str | None = None, data: str | None = None) -> "SceneStore":
    """Return a store after a check that graphs can be loaded into it.

    Raises:
        StoreError: the store cannot be changed.
    """
    from usd2kg.stores import open_store  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    store = open_store(place, update=update, data=data)
    store.check()
    return store


def load_graphs(store: "SceneStore", graphs: Sequence["NamedGraph"]) -> None:
    """Load graphs into a store; each replaces the graph with the same IRI."""
    for graph in graphs:
        with span("load"):
            store.load(graph)
        notify(f"{store.address}: loaded <{graph.iri}>, {len(graph.triples)} triples")


def check_graph_names(iris: Sequence[str]) -> None:
    """Check that no two graphs have the same IRI; the second would replace the first.

    Raises:
        OutputError: two graphs have the same IRI.
    """
    repeated = sorted({iri for iri in iris if iris.count(iri) > 1})
    if repeated:
        raise OutputError(f"two graphs have the IRI <{repeated[0]}>, so one would replace the other; build with --base")


@app.command("load")
def load_command(
    graphs: Annotated[list[Path], Argument(metavar="GRAPH...", help="Graphs written by usd2kg build.")],
    place: RequiredStore,
    scene: Annotated[
        str | None,
        Option("--scene", metavar="IRI", help="IRI of the graph in the store; default: as stated in the graph."),
    ] = None,
    update: UpdateAddress = None,
    data: DataAddress = None,
) -> None:
    """Load graphs into a store, each as one transaction; a graph with the same IRI is replaced."""
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.stores import read_named_graph  # noqa: PLC0415

    if scene is not None and len(graphs) > 1:
        raise StoreError(f"--scene names one graph, found {len(graphs)} files; load them one by one")
    with show_steps("parse", "load"):
        # Read all files before loading the first, so that an invalid file changes nothing.
        named = [read_named_graph(path, scene) for path in graphs]
        check_graph_names([graph.iri for graph in named])
        load_graphs(open_for_loading(place, update, data), named)


@app.command("list")
def list_command(place: RequiredStore, json: JsonOutput = False) -> None:
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
        emit(format_table(columns, [tuple(str(row[column]) for column in columns) for row in rows]))


@app.command("remove")
def remove_command(
    scenes: Annotated[list[str], Argument(metavar="SCENE...", help="Scenes, named as in usd2kg store list.")],
    place: RequiredStore,
    update: UpdateAddress = None,
) -> None:
    """Remove scenes from a store."""
    from usd2kg.stores import choose_graph, open_store  # noqa: PLC0415

    store = open_store(place, update=update)
    graphs = store.graphs()
    for graph in [choose_graph(graphs, scene, place) for scene in scenes]:
        store.remove(graph.iri)
        notify(f"{store.address}: removed <{graph.iri}>")


@app.command("update")
def update_command(
    sparql: Annotated[
        str, Argument(metavar="UPDATE", help="SPARQL 1.1 update, or @FILE; common prefixes are predefined.")
    ],
    place: RequiredStore,
    update: UpdateAddress = None,
) -> None:
    """Change a store by a SPARQL 1.1 update, as one transaction."""
    from usd2kg.stores import open_store  # noqa: PLC0415

    text = read_sparql(sparql)
    store = open_store(place, update=update)
    store.update(text)
    notify(f"{store.address}: updated")
