"""What is on a tablecloth is on the table, unless people ask for what is directly on it."""

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant import ask_offline
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

LAID = [
    (thing("/R/Table", (0, 0, 0), (1, 1, 0.7)), "Table"),
    (thing("/R/Cloth", (0, 0, 0.7), (1, 1, 0.005)), "DesignedArtifact"),
    (thing("/R/Mat", (0.1, 0.1, 0.705), (0.4, 0.3, 0.003)), "DesignedArtifact"),
    (thing("/R/Plate", (0.2, 0.15, 0.708), (0.2, 0.2, 0.02)), "DinnerPlate"),
    (thing("/R/Bowl", (0.7, 0.7, 0.705), (0.2, 0.2, 0.1)), "Bowl"),
    (thing("/R/Apple", (0.75, 0.75, 0.805), (0.08, 0.08, 0.08)), "DesignedArtifact"),
]


@pytest.fixture(scope="module")
def laid(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, LAID))


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        # The mat covers too little of the cloth to count as one, and the bowl is too high.
        ("What is on the table?", ["Bowl", "Cloth", "Mat"]),
        ("What stands on the table?", ["Bowl", "Cloth", "Mat"]),
        ("What is directly on the table?", ["Cloth"]),
        ("What is on the bowl?", ["Apple"]),
    ],
)
def test_what_is_on_a_cover_is_on_what_it_covers(laid: GraphStore, question: str, expected: list[str]):
    assert sorted(str(row[0]) for row in ask_offline(laid, question).answer.rows) == expected
