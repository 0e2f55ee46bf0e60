"""Arguments and options that name a graph or a store of graphs."""

from typing import Annotated

from typer import Argument, Option

__all__ = [
    "FOLDER_OR_URL",
    "DataAddress",
    "GraphSource",
    "OptionalGraphSource",
    "OptionalStore",
    "RequiredStore",
    "SceneName",
    "UpdateAddress",
]

_GRAPH = Argument(metavar="GRAPH", help="Graph written by usd2kg build, folder of a store, or URL of a SPARQL server.")
GraphSource = Annotated[str, _GRAPH]
OptionalGraphSource = Annotated[str | None, _GRAPH]

FOLDER_OR_URL = "FOLDER|URL"
"""Metavar of options that take a folder path or an address."""

_STORE = Option(
    "--store",
    metavar=FOLDER_OR_URL,
    help="Store of graphs: a folder, or the URL of a SPARQL 1.1 server. Credentials are read from the environment: "
    "USD2KG_STORE_USER and USD2KG_STORE_PASSWORD, or USD2KG_STORE_TOKEN.",
)
RequiredStore = Annotated[str, _STORE]
OptionalStore = Annotated[str | None, _STORE]
SceneName = Annotated[
    str | None,
    Option(
        "--scene", metavar="NAME", help="Scene of a store, by IRI, last part of the IRI, or label; default: all scenes."
    ),
]
UpdateAddress = Annotated[
    str | None, Option("--store-update", metavar="URL", help="Update endpoint of the server; default: discovered.")
]
DataAddress = Annotated[
    str | None,
    Option("--store-data", metavar="URL", help="Graph Store Protocol endpoint of the server; default: discovered."),
]
