"""Questions about rooms and groups by parts of their names, on a floor of a hotel."""

from pathlib import Path

import pytest

import usd2kg
from benchmarks.scenes.hotel.build import STAGE
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore
from usd2kg.query.lookup.body_measures import BodyMeasures
from usd2kg.query.lookup.related_things import find_below, find_over, find_related


@pytest.fixture(scope="module")
def hotel(tmp_path_factory: pytest.TempPathFactory) -> GraphStore:
    path = tmp_path_factory.mktemp("hotel") / "hotel.ttl"
    usd2kg.write_graph(usd2kg.build(STAGE).graph, path)
    return usd2kg.load_graph(path)


@pytest.mark.parametrize(("name", "room"), [("kitchen", "breakfast_kitchen"), ("linen room", "linen_room")])
def test_a_room_is_found_by_a_part_of_its_name(hotel: GraphStore, name: str, room: str):
    stated = hotel.sparql(f'SELECT ?o {{ ?o u2k:inRoom ?room . ?room rdfs:label "{room}" }}')
    assert len(hotel.inside(name).rows) == len(stated.rows) > 30
    asked = ask_offline(hotel, f"what is in the {name}?")
    assert len(asked.answer.rows) >= len(stated.rows)
    assert asked.sentence.endswith(f" are in the room {room}.")


def test_what_is_below_a_room_may_be_stated_to_be_in_another(tmp_path: Path):
    graph = tmp_path / "flat.ttl"
    graph.write_text(
        "@prefix u2k: <https://w3id.org/usd2kg#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        '<urn:k> u2k:primPath "/Flat/Kitchen" ; rdfs:label "Kitchen" .\n'
        '<urn:h> u2k:primPath "/Flat/Hall" ; rdfs:label "Hall" .\n'
        '<urn:a> u2k:primPath "/Flat/Kitchen/pan" ; rdfs:label "pan" ; u2k:inRoom <urn:k> .\n'
        '<urn:b> u2k:primPath "/Flat/Kitchen/broom" ; rdfs:label "broom" ; u2k:inRoom <urn:h> .\n'
        '<urn:c> u2k:primPath "/Flat/Kitchen/oven" ; rdfs:label "oven" .\n'
    )
    facts = usd2kg.load_graph(graph).facts
    assert find_related(facts, "inside", ["urn:k"], is_direct=True) == {"urn:a", "urn:c"}
    assert find_related(facts, "inside", ["urn:h"], is_direct=True) == {"urn:b"}


@pytest.mark.parametrize(
    ("question", "sentence"),
    [
        ("in which room is the bed?", "bed_frame is in the room guest_room."),
        ("which room is the iron in?", "iron is in the room guest_room."),
        (
            "where is the bed?",
            "bed_frame is on the floor slab floor_slab, in the room guest_room, at (1.24, -1.90, 0.14) m.",
        ),
    ],
)
def test_the_room_of_a_thing_on_the_floor(hotel: GraphStore, question: str, sentence: str):
    assert ask_offline(hotel, question).sentence == sentence


def test_rooms_are_counted(hotel: GraphStore):
    assert ask_offline(hotel, "which rooms are there?").sentence == "There are five rooms."


@pytest.mark.parametrize(
    ("question", "sentence"),
    [
        ("how many beds are there?", "There is 1 bed."),
        ("how many nightstands are there?", "There are 2 nightstands."),
        ("how many toilets are there?", "There is 1 toilet."),
    ],
)
def test_a_group_named_after_a_kind_is_one_of_it(hotel: GraphStore, question: str, sentence: str):
    assert ask_offline(hotel, question).sentence == sentence


def test_a_group_counts_beside_things_of_the_kind(tmp_path: Path):
    graph = tmp_path / "store.ttl"
    graph.write_text(
        "@prefix u2k: <https://w3id.org/usd2kg#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        '<urn:Freezer> a owl:Class ; rdfs:label "fridge" .\n'
        '<urn:a> a <urn:Freezer> ; u2k:primPath "/World/Store/box" ; rdfs:label "box" .\n'
        '<urn:b> u2k:primPath "/World/Store/Fridge/cabinet_body" ; rdfs:label "cabinet_body" .\n'
        '<urn:c> u2k:primPath "/World/Store/Fridge/butter" ; rdfs:label "butter" ; u2k:inside <urn:b> .\n'
    )
    assert ask_offline(usd2kg.load_graph(graph), "how many fridges are there?").sentence == "There are 2 fridges."


def test_what_is_in_a_group_is_on_its_main_object(hotel: GraphStore):
    assert ask_offline(hotel, "is the notepad on the nightstand?").verdict


def test_a_free_place_is_on_the_highest_board(hotel: GraphStore):
    # Its top is at 0.79 m, its shelf at 0.22 m; between them is nothing to put a laptop on.
    assert ", 0.788) m" in ask_offline(hotel, "where can I put the laptop?").sentence


@pytest.mark.parametrize("question", ["which doors are open?", "what drawers are still open?"])
def test_what_is_open_is_not_what_can_be_opened(hotel: GraphStore, question: str):
    with pytest.raises(GraphError, match="is not understood"):
        ask_offline(hotel, question)
    assert ask_offline(hotel, "which drawers can be opened?").answer.rows


def test_what_has_no_place_is_not_said_to_be_elsewhere(tmp_path: Path):
    stage = tmp_path / "lab.usda"
    stage.write_text(
        '#usda 1.0\n(metersPerUnit = 1\nupAxis = "Z")\ndef Xform "Lab" (kind = "group")\n{\n'
        'def Cube "floor_slab" (kind = "component")\n{\ndouble size = 4\ndouble3 xformOp:translate = (0, 0, -1.8)\n'
        'uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
        'def Cube "Table" (kind = "component")\n{\ndouble size = 0.8\ndouble3 xformOp:translate = (0, 0, 0.6)\n'
        'uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
        'def Xform "Milk" (kind = "component")\n{\n}\n}\n'
    )
    graph = tmp_path / "lab.ttl"
    usd2kg.write_graph(usd2kg.build(stage).graph, graph)
    lab = usd2kg.load_graph(graph)
    with pytest.raises(GraphError, match="not known: the graph has no place of Milk"):
        ask_offline(lab, "is the milk on the table?")
    assert ask_offline(lab, "is the table on the floor?").verdict
    # The top of the slab is the floor, not its underside.
    assert BodyMeasures(lab.facts).floor_level == pytest.approx(0.2)
    assert "another time" not in ask_offline(lab, "Was ist auf dem Boden?").sentence


def test_what_a_thing_is_behind_needs_a_viewpoint(hotel: GraphStore):
    with pytest.raises(GraphError, match="not known: the graph does not state what the armchair is behind"):
        ask_offline(hotel, "which table is the armchair behind?")


def test_things_are_below_what_is_over_them(kitchen: GraphStore):
    facts = kitchen.facts
    under = {(iri, one) for iri in facts.things for one in find_below(facts, iri)}
    assert len(under) > 20
    assert {(over, iri) for iri in facts.things for over in find_over(facts, iri)} == under
    assert ask_offline(kitchen, "which table is the rug under?").understood


def test_the_words_behind_an_answer_have_its_values(hotel: GraphStore):
    unsure = ask_offline(hotel, "which objects are you unsure about?")
    assert unsure.understood == "unsure: Which objects have an uncertain class (confidence below 0.5), and why?"
    assert "Not taken into account" not in unsure.sentence
    assert (
        "(two extents below 0.12 m, lighter than 2 kg)?"
        in ask_offline(hotel, "what can I grasp on the desk?").understood
    )
