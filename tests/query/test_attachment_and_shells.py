"""What is attached to what, and distances to hollow objects, asked of graphs in both profiles."""

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.ontology import load_home_tbox
from usd2kg.query import GraphStore
from usd2kg.relations import Relation
from usd2kg.scene import Box

WALLS = (Box((0, 0, 0), (8, 0.2, 2.5)), Box((0, 4.8, 0), (8, 5, 2.5)))


@pytest.fixture(params=["soma", "plain"])
def store(request) -> GraphStore:
    placed = [
        (thing("/walls", (0, 0, 0), (8, 5, 2.5), shell_boxes=WALLS), "Wall"),
        (thing("/table", (3, 2, 0), (1, 1, 0.7)), "Table"),
        (thing("/picture", (3, 4.77, 1.4), (0.6, 0.02, 0.5)), "DesignedArtifact"),
    ]
    relations = [Relation("attached-to", "/picture", "/walls", "attached-to/1", {"gap": 0.01}, 0.93)]
    return open_store(build_graph(load_home_tbox(), placed, profile=request.param, relations=relations))


@pytest.mark.parametrize(
    "question", ["attached to walls", "what is attached to walls?", "hanging from walls", "fixed to walls"]
)
def test_lists_what_is_attached(store: GraphStore, question: str):
    answer = store.ask(question.split())
    assert answer.columns == ("object", "class", "path", "anchor", "gap_m")
    assert answer.rows == (("picture", "artifact", "/picture", "walls", "0.01"),)


def test_says_where_an_attached_object_is(store: GraphStore):
    (row,) = store.ask(["where", "is", "picture"]).rows
    assert row[-2:] == ("walls", None)


def test_relations_carry_rule_and_confidence(store: GraphStore):
    answer = store.sparql(
        "SELECT ?r ?c WHERE { ?x owl:annotatedProperty u2k:attachedTo ; u2k:rule ?r ; sssom:confidence ?c }"
    )
    assert answer.rows == (("attached-to/1", "0.93"),)


def test_walls_are_as_far_away_as_they_are(store: GraphStore):
    # 1.8 m on both sides of the table, in whose middle the box of the walls lies.
    answer = store.answer("close-to", {"thing": "table", "distance": "3 m"})
    gaps = dict(zip((row[0] for row in answer.rows), (row[-1] for row in answer.rows), strict=True))
    assert float(gaps["walls"]) == pytest.approx(1.8)
    assert "walls" not in {row[0] for row in store.answer("close-to", {"thing": "table", "distance": "1 m"}).rows}
