"""Fixtures: small scene graphs and running servers."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.graph.records import build_graph, thing
from tests.stores.servers import fuseki, oxigraph
from usd2kg.graph import KnowledgeGraph
from usd2kg.ontology import TBox
from usd2kg.stores import NamedGraph, make_named_graph
from usd2kg.stores.http_client import SparqlClient
from usd2kg.stores.remote import RemoteStore
from usd2kg.stores.store_limits import HttpLimits, UploadLimits


def scene_graph(tbox: TBox, base: str, names: list[str]) -> KnowledgeGraph:
    """Return the graph of a table with cups on it."""
    table = (thing("/Room/Table", (0, 0, 0), (1.6, 0.8, 0.7)), "Table")
    cups = [(thing(f"/Room/{name}", (0.1 + 0.2 * i, 0.3, 0.7), (0.1, 0.1, 0.1)), "Cup") for i, name in enumerate(names)]
    return build_graph(tbox, [table, *cups], base=base)


@pytest.fixture(scope="session")
def small(home_tbox: TBox) -> NamedGraph:
    """A table with a cup."""
    return make_named_graph(scene_graph(home_tbox, "https://my.lab/k/", ["Mug"]))


@pytest.fixture(scope="session")
def large(home_tbox: TBox) -> NamedGraph:
    """The same scene with three cups."""
    return make_named_graph(scene_graph(home_tbox, "https://my.lab/k/", ["Mug", "Cup_1", "Cup_2"]))


@pytest.fixture(scope="session")
def other(home_tbox: TBox) -> NamedGraph:
    """Another scene, whose blank nodes can have the same labels."""
    return make_named_graph(scene_graph(home_tbox, "https://my.lab/other/", ["Mug"]))


@pytest.fixture(scope="session", params=["oxigraph", "fuseki"])
def server(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a running server."""
    folder: Path = tmp_path_factory.mktemp(request.param)
    with (oxigraph if request.param == "oxigraph" else fuseki)(folder) as address:
        yield address


def open_remote(address: str, **options: object) -> RemoteStore:
    """Return a store that does not pause between attempts and uploads in small chunks."""
    limits = UploadLimits(chunk_triples=40)
    client = SparqlClient(limits=HttpLimits(timeout_s=60), sleep=lambda _: None)
    return RemoteStore(address, client, limits=limits, **options)  # type: ignore[arg-type]
