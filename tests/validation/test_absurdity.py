"""Absurd scenes are found whatever the ontology, with figures worked by hand."""

from typing import Any

import pyoxigraph as ox
import pytest

from tests.graph.records import build_graph, reread, thing
from tests.grounding.records import make_class, make_tbox
from tests.validation.broken import BASE, ROOM, added, found_in, open_room, replaced, rules_in
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.grounding import concepts_named
from usd2kg.grounding.lexical.recognition import describe_concepts
from usd2kg.ontology import TBox
from usd2kg.query import Dataset, GraphStore
from usd2kg.validation import Finding

OWN = make_tbox(make_class("Item"), make_class("Kit", "Item"), make_class("Stuff", "Item"))
"""An ontology that knows nothing about homes."""
PROFILES = pytest.mark.parametrize("profile", ["soma", "plain"])
LINKS = {"soma": ("soma:isOntopOf", "soma:isInsideOf"), "plain": ("u2k:on", "u2k:inside")}


def own_graph(placed: list[tuple[Any, str]], nouns: dict[str, str], update: str = "", **options: Any) -> GraphStore:
    """Return the graph of (object, class of OWN) pairs, whose concepts are given as label of the object → noun."""
    store: ox.Store = reread(build_graph(OWN, placed, profile="plain", **options))
    concepts = {label: concepts_named(noun)[0] for label, noun in nouns.items()}
    triples = [f"k:{label} u2k:concept <{iri}> ; u2k:conceptConfidence 0.9 ." for label, iri in concepts.items()]
    for concept in describe_concepts(concepts.values()).values():
        triples.append(f'<{concept.iri}> skos:prefLabel "{concept.label}" .')
        triples += [f"<{concept.iri}> skos:broader <{above}> ." for above in concept.broader]
    store.update(f"INSERT DATA {{ {' '.join(triples)} }} ; {update}", prefixes={**PREFIXES, "k": BASE})
    return GraphStore(Dataset(store), "room.ttl")


def find(graph: GraphStore, rule: str) -> Finding:
    (finding,) = (finding for finding in found_in(graph) if finding.rule == rule)
    return finding


FLOOR = (thing("/Floor", (-3, -3, -0.1), (6, 6, 0.1)), "Item")
TABLE = (thing("/Table", (0, 0, 0), (1.2, 0.8, 0.75)), "Item")
NOUNS = {"Floor": "floor", "Table": "table"}


# --- in the air ---------------------------------------------------------------------------------------


def with_cup(lower: Any, path: str = "/Cup", noun: str = "cup", update: str = "") -> GraphStore:
    cup = (thing(path, lower, (0.08, 0.08, 0.1)), "Item")
    return own_graph([FLOOR, TABLE, cup], {**NOUNS, path.rpartition("/")[2]: noun}, update)


def test_measures_the_gap_to_the_next_surface_below():
    # 1.15 m - 0.75 m.
    finding = find(with_cup((0.2, 0.2, 1.15)), "in-the-air")
    assert (finding.prim_path, finding.severity) == ("/Cup", "warning")
    assert finding.found == "nothing supports or holds it; its bottom is 40 cm above “Table” (/Table)"
    assert finding.expected == "a supporter, or something that holds it, at most 10 cm away"


def test_measures_the_gap_to_the_ground_beside_the_floor():
    finding = find(with_cup((5, 0, 2.5)), "in-the-air")
    assert finding.found.endswith("its bottom is 2.5 m above the ground, the next surface below")


@pytest.mark.parametrize("noun", ["lamp", "picture", "cupboard", "chandelier", "clock"])
def test_things_that_hang_are_not_in_the_air(noun: str):
    assert "in-the-air" not in rules_in(with_cup((0.2, 0.2, 1.15), noun=noun))


@pytest.mark.parametrize("held_by", ["u2k:attachedTo", "u2k:partOf", "u2k:inside", "u2k:on"])
def test_things_that_something_holds_are_not_in_the_air(held_by: str):
    graph = with_cup((0.2, 0.2, 0.86), update=added(f"k:Cup {held_by} k:Table"))
    assert "in-the-air" not in rules_in(graph)


def test_a_thing_against_a_wall_is_not_in_the_air():
    wall = (thing("/Wall", (-0.1, 0, 0), (0.1, 3, 2.5)), "Item")
    hook = (thing("/Cup", (0.01, 1, 1.6), (0.08, 0.08, 0.1)), "Item")
    nouns = {**NOUNS, "Wall": "wall", "Cup": "cup"}
    assert rules_in(own_graph([FLOOR, wall, hook], nouns)) == []
    # 12 cm are more than a contact, and than the gap of what is attached.
    away = (thing("/Cup", (0.12, 1, 1.6), (0.08, 0.08, 0.1)), "Item")
    assert rules_in(own_graph([FLOOR, wall, away], nouns)) == ["in-the-air"]


def test_the_empty_box_of_walls_in_one_mesh_holds_nothing():
    walls = (thing("/Wall", (-3, -3, 0), (6, 6, 2.5)), "Item")
    cup = (thing("/Cup", (0.2, 0.2, 1.15), (0.08, 0.08, 0.1)), "Item")
    graph = own_graph([FLOOR, TABLE, walls, cup], {**NOUNS, "Wall": "wall", "Cup": "cup"})
    assert rules_in(graph) == ["in-the-air"]


def test_objects_of_an_unknown_kind_may_hang_high_up():
    assert rules_in(with_cup((0.2, 0.2, 1.15), noun="gadget")) == ["in-the-air"]
    assert rules_in(with_cup((0.2, 0.2, 1.85), noun="gadget")) == []


def test_many_objects_in_the_air_are_one_finding():
    cups = [(thing(f"/Cup{i}", (i, 2, 1 + i / 10), (0.08, 0.08, 0.1)), "Item") for i in range(5)]
    nouns = {**NOUNS, **{f"Cup{i}": "cup" for i in range(5)}}
    floor = (thing("/Floor", (-3, -3, -0.1), (9, 6, 0.1)), "Item")
    finding = find(own_graph([floor, TABLE, *cups], nouns), "in-the-air")
    # The gaps are 1, 1.1, 1.2, 1.3 and 1.4 m.
    assert finding.found.startswith(
        "nothing supports or holds 5 of 7 objects, whose median gap to the next surface below is 1.2 m: "
        "“Cup0” (/Cup0) 1 m above “Floor” (/Floor); “Cup1”"
    )
    assert (finding.prim_path, finding.iri) == ("", "")


# --- scale --------------------------------------------------------------------------------------------

THINGS = (("chair", 0.85), ("mug", 0.11), ("fork", 0.19), ("plate", 0.24), ("sofa", 2.0))


def scaled(scale: float, metres_per_unit: float = 0.01) -> GraphStore:
    placed = [
        (thing(f"/Thing{i}", (i * scale, 0, 0), (size * scale, size * scale / 2, size * scale / 3)), "Item")
        for i, (_, size) in enumerate(THINGS)
    ]
    update = replaced("?stage", "u2k:metresPerUnit", str(metres_per_unit))
    return own_graph(placed, {f"Thing{i}": noun for i, (noun, _) in enumerate(THINGS)}, update)


def test_a_scene_of_plausible_scale_has_no_findings():
    assert rules_in(scaled(1.0)) == []


@pytest.mark.parametrize(("scale", "unit"), [(0.01, 1), (0.0254, 0.3048), (10.0, 0.001), (100.0, 0.0001)])
def test_a_wrong_unit_is_one_finding_with_a_proposal(scale: float, unit: float):
    (finding,) = found_in(scaled(scale))
    assert (finding.rule, finding.severity, finding.prim_path) == ("scene-scale", "error", "")
    assert "times as long as usual, by the median of 5: " in finding.found
    if unit in {1, 0.001}:
        assert finding.expected == (
            f"objects of about their usual size; with metersPerUnit = {unit:g} instead of 0.01 they would be "
            "0.97 times as long as usual"
        )


def test_a_room_that_nobody_can_stand_in():
    graph = open_box("Room", (0.36, 0.3, 0.25))
    finding = find(graph, "room-size")
    assert finding.found == "it has 0.36 × 0.3 × 0.25 m, and its class, item, is a room"
    assert finding.expected == "longest extent from 1 m to 2 km"


def open_box(label: str, size: Any) -> GraphStore:
    return own_graph([(thing(f"/{label}", (0, 0, 0), size), "Item")], {label: label.lower()})


def test_a_tiny_scene_of_unknown_things():
    placed = [(thing(f"/G{i}", (i / 1000, 0, 0), (0.001, 0.001, 0.001)), "Item") for i in range(5)]
    finding = find(own_graph(placed, {}), "scene-scale")
    # Corners from 0.4 mm to 4.6 mm, without the outermost tenth: (0.1 and 0.9 quantiles of 0…4 and 1…5).
    assert finding.found == "5 objects are within 4.2 mm, without the outermost tenth"


@pytest.mark.parametrize(("size", "rules"), [((2.9, 2, 1), ["unusual-size"]), ((0.3, 0.2, 0.1), [])])
def test_the_concept_gives_the_usual_size(size: Any, rules: list[str]):
    # A mug is usually 0.12 m long: five times as much is 0.6 m.
    assert rules_in(open_box("Mug", size)) == rules


def test_a_size_that_fits_the_name_but_not_the_class(home_tbox: TBox):
    """A mug that was grounded to a refrigerator."""
    graph = open_room(home_tbox, "plain", replaced("k:Cup", "a", "soma:Refrigerator"))
    finding = find(graph, "unusual-size")
    assert "and it is a refrigerator" in finding.found
    mug = concepts_named("mug")[0]
    named = f'k:Cup u2k:concept <{mug}> . <{mug}> skos:prefLabel "mug"'
    graph = open_room(home_tbox, "plain", replaced("k:Cup", "a", "soma:Refrigerator") + ";" + added(named))
    finding = find(graph, "unusual-size")
    assert "and it is a refrigerator; its name means mug, usually 12 cm" in finding.found


# --- relations ----------------------------------------------------------------------------------------


@PROFILES
def test_names_the_shortest_circle_of_supporters(home_tbox: TBox, profile: str):
    on = LINKS[profile][0]
    finding = find(open_room(home_tbox, profile, added(f"k:Table {on} k:Cup")), "support-circle")
    assert (finding.prim_path, finding.severity) == ("/Cup", "error")
    assert finding.found == "it is on “Table” (/Table), which is on “Cup” (/Cup)"
    graph = open_room(home_tbox, profile, added(f"k:Table {on} k:Fork . k:Fork {on} k:Cup . k:Cup {on} k:Cup"))
    finding = find(graph, "support-circle")
    assert finding.found == "it is on itself; 3 objects are in this and overlapping cycles"


@PROFILES
def test_circles_may_pass_through_containers(home_tbox: TBox, profile: str):
    on, inside = LINKS[profile]
    graph = open_room(home_tbox, profile, added(f"k:Cupboard {on} k:Bowl"))
    finding = find(graph, "support-circle")
    assert finding.found == "it is inside “Cupboard” (/Cupboard), which is on “Bowl” (/Bowl)"
    assert "support-circle" not in rules_in(open_room(home_tbox, profile, added(f"k:Fork {inside} k:Bowl")))


def test_abbreviates_a_long_circle(home_tbox: TBox):
    chain = " ".join(f"k:Table{i} u2k:on k:Table{(i + 1) % 10} ." for i in range(10))
    tables = [(thing(f"/Table{i}", (2 * i, 0, 0), (1.2, 0.8, 0.75)), "Table") for i in range(10)]
    finding = find(open_room(home_tbox, "plain", added(chain), placed=tables), "support-circle")
    assert finding.found.count("which is on") == 5
    assert "which is … (4 more), which is on “Table0” (/Table0)" in finding.found


@PROFILES
def test_one_thing_inside_two_containers_that_are_apart(home_tbox: TBox, profile: str):
    inside = LINKS[profile][1]
    oven = (thing("/Oven", (2, 2, 0), (0.6, 0.6, 0.6)), "Oven")
    graph = open_room(home_tbox, profile, added(f"k:Bowl {inside} k:Oven"), placed=[*ROOM, oven])
    finding = find(graph, "containers-exclusive")
    assert finding.prim_path == "/Bowl"
    # The cupboard ends at y = 0.6 m, the oven begins at y = 2 m.
    assert finding.found == (
        "it is inside “Cupboard” (/Cupboard) and inside “Oven” (/Oven), whose boxes are 1.4 m apart"
    )


def test_nested_containers_do_not_exclude_each_other():
    box = (thing("/Box", (0.1, 0.1, 0.76), (0.3, 0.3, 0.2)), "Item")
    crate = (thing("/Crate", (0, 0, 0.75), (0.5, 0.5, 0.4)), "Item")
    cup = (thing("/Cup", (0.2, 0.2, 0.77), (0.08, 0.08, 0.1)), "Item")
    stated = added("k:Cup u2k:inside k:Box , k:Crate . k:Crate u2k:on k:Table")
    assert "containers-exclusive" not in rules_in(own_graph([FLOOR, TABLE, box, crate, cup], NOUNS, stated))


@PROFILES
def test_relations_between_objects_that_are_apart(home_tbox: TBox, profile: str):
    finding = find(open_room(home_tbox, profile, added(f"k:Cupboard {LINKS[profile][0]} k:Table")), "relation-apart")
    # From x = 1.2 m to 2 m.
    assert finding.found == "it is on “Table” (/Table), but their boxes are 80 cm apart"
    assert finding.expected == "boxes at most 15 cm apart"


def crowd(container: str, noun: str, count: int = 12) -> GraphStore:
    whole = (thing(f"/{container}", (-5, -5, 0), (10, 10, 3)), "Item")
    cups = [(thing(f"/Cup{i}", (i / 4, 0, 0), (0.08, 0.08, 0.1)), "Item") for i in range(count)]
    nouns = {container: noun, **{f"Cup{i}": "cup" for i in range(count)}}
    stated = added(" ".join(f"k:Cup{i} u2k:inside k:{container} ." for i in range(count)))
    return own_graph([whole, *cups], nouns, stated)


def test_most_things_inside_a_wall():
    found = found_in(crowd("Wall", "wall"))
    assert {finding.rule for finding in found} == {"container-solid", "container-crowded"}
    assert {finding.prim_path for finding in found} == {"/Wall"}
    solid = next(finding for finding in found if finding.rule == "container-solid")
    assert solid.found == "it is a wall, and 12 objects are inside it: /Cup0, /Cup1, /Cup10 and 9 more"
    assert (solid.severity, solid.expected) == ("error", "nothing inside a wall")
    crowded = next(finding for finding in found if finding.rule == "container-crowded")
    assert crowded.found.startswith("12 objects are directly inside it, 92% of the scene: /Cup0")


@pytest.mark.parametrize(
    ("noun", "count", "rules"), [("room", 12, []), ("crate", 9, []), ("crate", 12, ["container-crowded"])]
)
def test_rooms_and_small_scenes_may_have_one_container(noun: str, count: int, rules: list[str]):
    assert [rule for rule in rules_in(crowd("Whole", noun, count)) if rule != "unusual-size"] == rules


# --- floors, overlaps, classes ------------------------------------------------------------------------


def furnished(floor_z: float, stated: str) -> GraphStore:
    chairs = [(thing(f"/Chair{i}", (i, 0, 0), (0.45, 0.45, 0.85)), "Item") for i in range(5)]
    floor = (thing("/Floor", (-3, -3, floor_z - 0.1), (9, 6, 0.1)), "Item")
    nouns = {"Floor": "floor", **{f"Chair{i}": "chair" for i in range(5)}}
    return own_graph([floor, *chairs], nouns, stated)


def test_nothing_on_any_floor():
    stated = added("k:Chair0 u2k:on k:Chair1")
    finding = find(furnished(-1.5, stated), "floor-empty")
    assert finding.found == (
        "none of 5 objects is on “Floor” (/Floor); the bottom of “Chair0” (/Chair0) is the nearest in height, "
        "1.5 m above the top of a floor at z = -1.5 m"
    )
    assert "floor-empty" not in rules_in(furnished(0, added("k:Chair0 u2k:on k:Floor")))


def test_interpenetrating_objects():
    def pair(shift: float, update: str = "") -> GraphStore:
        chairs = [(thing(f"/Chair{i}", (i * shift, 0, 0), (0.5, 0.5, 0.8)), "Item") for i in range(2)]
        return own_graph(chairs, {"Chair0": "chair", "Chair1": "chair"}, update)

    # 0.4 / 0.6 of the union.
    finding = find(pair(0.1), "interpenetrating")
    assert finding.found == (
        "its box shares 67% of the joint volume with “Chair1” (/Chair1); the two overlap by 40 cm at least"
    )
    # 0.3 / 0.7 is less than half.
    assert rules_in(pair(0.2)) == []
    assert rules_in(pair(0.1, added("k:Chair0 u2k:attachedTo k:Chair1"))) == []
    assert rules_in(pair(0.0)) == ["duplicate"]


def test_one_concept_with_unrelated_classes():
    def cups(*classes: str) -> GraphStore:
        placed = [(thing(f"/Cup{i}", (i, 0, 0), (0.08, 0.08, 0.1)), cls) for i, cls in enumerate(classes)]
        return own_graph(placed, {f"Cup{i}": "cup" for i in range(len(classes))})

    finding = find(cups("Kit", "Kit", "Stuff"), "concept-classes")
    assert finding.severity == "note"
    assert finding.found == (
        "3 objects have the concept “cup” and 2 classes: 2 of class kit (/Cup0, /Cup1); 1 of class stuff (/Cup2)"
    )
    assert rules_in(cups("Kit", "Item", "Kit")) == []


def test_ignores_concepts_that_are_more_likely_wrong():
    unsure = (
        "DELETE { ?o u2k:conceptConfidence ?c } INSERT { ?o u2k:conceptConfidence 0.3 } "
        "WHERE { ?o u2k:conceptConfidence ?c }"
    )
    assert rules_in(own_graph([(thing("/Mug", (0, 0, 0), (3, 2, 1)), "Item")], {"Mug": "mug"}, unsure)) == []


def test_other_rules_are_checked_after_a_wrong_scale_is_corrected():
    graph = scaled(0.01)
    # 2 kg at 0.01 times the usual scale are the same density as 2,000,000 kg at the usual one.
    mug = replaced("k:Thing1", "u2k:height", "0.05")
    store = own_graph(
        [
            (thing(f"/Thing{i}", (i / 100, 0, 0), (size / 100, size / 200, size / 300), mass_kg=2.0), "Item")
            for i, (_, size) in enumerate(THINGS)
        ],
        {f"Thing{i}": noun for i, (noun, _) in enumerate(THINGS)},
        mug,
    )
    assert rules_in(graph) == ["scene-scale"]
    scale, odd = found_in(store)
    assert (scale.rule, odd.rule, odd.prim_path) == ("scene-scale", "unusual-size", "/Thing1")
    # The mug is 5 cm high where the median thing is at 0.00974 times the usual scale.
    assert odd.found.startswith("after division of all lengths by 0.00974: its longest extent is 5.13 m")
