"""Graphs that several tests of questions share."""

import pytest

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.query import GraphStore


@pytest.fixture(scope="session")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> GraphStore:
    """The demo kitchen."""
    path = tmp_path_factory.mktemp("kitchen") / "kitchen.ttl"
    usd2kg.write_graph(usd2kg.build(demo_scene()).graph, path)
    return usd2kg.load_graph(path)
