"""Graph files: format by extension, deterministic bytes, atomic writes."""

import os
import subprocess
import sys
from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.graph.records import build_graph, thing
from usd2kg.errors import GraphError, OutputError
from usd2kg.graph import KnowledgeGraph, graph_format, serialize_graph, write_graph
from usd2kg.graph.formats import serialize
from usd2kg.ontology import TBox

CUP = thing("/Room/Cup", (0, 0, 0), (0.1, 0.1, 0.1))

# Runs in separate processes with different hash seeds.
WRITER = """
import sys
from pathlib import Path
from tests.graph.records import build_graph, thing
from usd2kg.graph import write_graph
from usd2kg.ontology import load_home_tbox

table = thing("/Room/Table", (0, 0, 0), (2, 1, 0.7))
cups = [thing(f"/Room/Cup_{i}", (0.2 * i, 0.3, 0.7), (0.1, 0.1, 0.1), mass_kg=0.2) for i in range(6)]
graph = build_graph(load_home_tbox(), [(table, "Table"), *((cup, "Cup") for cup in cups)])
for ending in (".ttl", ".nt"):
    write_graph(graph, Path(sys.argv[1] + ending))
"""


@pytest.fixture(scope="module")
def graph(home_tbox: TBox) -> KnowledgeGraph:
    return build_graph(home_tbox, [(CUP, "Cup")])


def test_two_processes_write_the_same_bytes(tmp_path: Path):
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        root = Path(__file__).parents[3]
        subprocess.run(
            [sys.executable, "-c", WRITER, str(tmp_path / seed)], check=True, cwd=root, env=environment, timeout=60
        )
    for ending in (".ttl", ".nt"):
        first, second = ((tmp_path / f"{seed}{ending}").read_bytes() for seed in ("1", "2"))
        assert first == second
        assert len(first) > 1000


def test_turtle_begins_with_its_prefixes_in_order(graph: KnowledgeGraph):
    lines = serialize_graph(graph, ox.RdfFormat.TURTLE).decode().splitlines()
    prefixes = [line for line in lines if line.startswith("@prefix")]
    assert lines[: len(prefixes)] == prefixes == sorted(prefixes)
    assert "@prefix : <https://my.lab/k/> ." in prefixes
    assert "@prefix usd: <https://ease-crc.org/ont/USD.owl#> ." in prefixes
    assert len(prefixes) == len(graph.prefixes)


def test_turtle_is_for_people(graph: KnowledgeGraph):
    assert ":Room.Cup a " in serialize_graph(graph, ox.RdfFormat.TURTLE).decode()


def test_n_triples_is_one_line_each(graph: KnowledgeGraph):
    lines = serialize_graph(graph, ox.RdfFormat.N_TRIPLES).decode().splitlines()
    assert len(lines) == len(graph.triples)
    assert all(line.endswith(" .") for line in lines)


@pytest.mark.parametrize("rdf_format", [ox.RdfFormat.TURTLE, ox.RdfFormat.N_TRIPLES])
def test_a_large_graph_is_written_in_pieces_that_say_the_same(
    graph: KnowledgeGraph, rdf_format: ox.RdfFormat, monkeypatch: pytest.MonkeyPatch
):
    whole = serialize_graph(graph, rdf_format)
    monkeypatch.setattr(serialize, "_CHUNK", 3)
    assert len(graph.triples) > 30
    # Chunks end where the subject changes, so the layout is the same.
    assert serialize_graph(graph, rdf_format) == whole


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("a.ttl", "Turtle"),
        ("a.b.TTL", "Turtle"),
        ("a.nt", "N-Triples"),
        ("a.owl", "RDF/XML"),
        ("a.ofn", "OWL functional syntax"),
        ("a.nq.gz", "N-Quads"),
    ],
)
def test_the_ending_says_the_format(name: str, expected: str):
    assert graph_format(Path(name)).name == expected


@pytest.mark.parametrize("name", ["graph", "graph.docx", "graph.ttl.bak", ".ttl", "graph.gz"])
def test_another_ending_is_an_error_and_writes_nothing(tmp_path: Path, graph: KnowledgeGraph, name: str):
    with pytest.raises(GraphError, match=r"names no graph format; expected one of .*ttl, .*nt"):
        write_graph(graph, tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_written_bytes_equal_serialised_bytes(tmp_path: Path, graph: KnowledgeGraph):
    path = tmp_path / "graph.nt"
    write_graph(graph, path)
    assert path.read_bytes() == serialize_graph(graph, ox.RdfFormat.N_TRIPLES)
    assert [p.name for p in tmp_path.iterdir()] == ["graph.nt"]


def test_a_folder_that_is_not_there_is_an_error(tmp_path: Path, graph: KnowledgeGraph):
    with pytest.raises(OutputError, match="does not exist"):
        write_graph(graph, tmp_path / "none" / "graph.ttl")
