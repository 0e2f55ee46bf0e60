"""Each rule of plausibility finds its violation and nothing else."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.graph.records import thing
from tests.validation.broken import CONFIDENCE, ROOM, UPRIGHT, added, found_in, open_room, rules_in
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.validation import read_graph_objects, read_rules

ROOM_ONLY = ROOM[:5]
PROFILES = pytest.mark.parametrize("profile", ["soma", "plain"])


def with_thing(path: str, lower: Any, size: Any, cls: str, **known: Any) -> list[Any]:
    """Return the room with one more object."""
    return [*ROOM_ONLY, (thing(path, lower, size, **known), cls)]


STRETCHED = (0.0, 0.0, 0.0, 1.1)
CASES = [
    ("unusual-size", with_thing("/Fork2", (-2, -2, 0), (3.0, 0.3, 0.1), "Fork"), "/Fork2", "3 m (3 × 0.3 × 0.1 m)"),
    (
        "orientation-not-unit",
        with_thing("/Mug", (-2, -2, 0), (0.1, 0.1, 0.1), "Cup", position=(0, 0, 0), orientation=STRETCHED),
        "/Mug",
        "has length 1.1",
    ),
    (
        "density",
        with_thing("/Mug", (-2, -2, 0), (0.1, 0.1, 0.1), "Cup", position=(0, 0, 0), orientation=UPRIGHT, mass_kg=30.0),
        "/Mug",
        "30 kg in a box of 0.1 × 0.1 × 0.1 m is 3e+04 kg/m³",
    ),
    (
        "below-floor",
        with_thing("/Mug", (1, 1, -2), (0.1, 0.1, 0.1), "Cup"),
        "/Mug",
        "the top of its box is at z = -1.9 m",
    ),
    ("duplicate", with_thing("/Cup_2", (0.2, 0.2, 0.75), (0.08, 0.08, 0.1), "Cup"), "/Cup_2", "“Cup” (/Cup)"),
]


@PROFILES
@pytest.mark.parametrize(("rule", "placed", "path", "text"), CASES, ids=[case[0] for case in CASES])
def test_finds_one_implausible_object(home_tbox: TBox, profile: str, rule: str, placed: Any, path: str, text: str):
    (finding,) = found_in(open_room(home_tbox, profile, placed=placed))
    assert (finding.rule, finding.prim_path) == (rule, path)
    assert text in finding.found


LINKS = {"soma": ("soma:isOntopOf", "soma:isInsideOf"), "plain": ("u2k:on", "u2k:inside")}


@PROFILES
def test_finds_a_table_on_a_cup(home_tbox: TBox, profile: str):
    found = found_in(open_room(home_tbox, profile, added(f"k:Table {LINKS[profile][0]} k:Cup")))
    by_rule = {finding.rule: finding for finding in found}
    assert set(by_rule) == {"support-odd", "support-smaller", "support-lighter", "support-circle"}
    assert by_rule["support-odd"].found == "it is a table on “Cup” (/Cup), a cup"
    # 1.2 · 0.8 · 0.75 over 0.08 · 0.08 · 0.1 is 1125; 1.2 over 0.1 is 12; 20 kg over 0.3 kg is 67.
    assert "1125 times the volume and 12.0 times the length" in by_rule["support-smaller"].found
    assert by_rule["support-lighter"].found == "it has 20 kg and is on “Cup” (/Cup) with 0.3 kg"


@PROFILES
def test_disables_rules_one_by_one(home_tbox: TBox, profile: str, tmp_path: Path):
    graph = open_room(home_tbox, profile, added(f"k:Table {LINKS[profile][0]} k:Cup"))
    rules = {"support-odd", "support-smaller", "support-lighter", "support-circle"}
    for rule in sorted(rules):
        others = rules - {rule}
        path = tmp_path / "rules.toml"
        path.write_text("\n".join(f"[{other}]\nenabled = false" for other in others))
        assert {f.rule for f in found_in(graph, rules=read_rules(path))} == {rule}


@PROFILES
def test_finds_an_object_larger_than_its_container(home_tbox: TBox, profile: str):
    finding, apart = found_in(open_room(home_tbox, profile, added(f"k:Table {LINKS[profile][1]} k:Bowl")))
    # From x = 1.2 m to 2.2 m.
    assert (apart.rule, apart.found) == ("relation-apart", "it is inside “Bowl” (/Bowl), but their boxes are 1 m apart")
    assert (finding.rule, finding.severity, finding.prim_path) == ("inside-smaller", "error", "/Table")
    assert finding.expected == "a box that fits into 0.16 × 0.16 × 0.07 m"


@PROFILES
def test_finds_an_object_far_from_all_others(home_tbox: TBox, profile: str):
    cups = [(thing(f"/Cup_{i}", (i / 4, 1, 0), (0.08, 0.08, 0.1)), "Cup") for i in range(12)]
    far = (thing("/Lost", (500, 0, 0), (0.08, 0.08, 0.1)), "Cup")
    (finding,) = found_in(open_room(home_tbox, profile, placed=[*ROOM_ONLY, *cups, far]))
    assert (finding.rule, finding.prim_path) == ("far-away", "/Lost")


@PROFILES
def test_finds_a_low_confidence_only_if_calibrated_and_with_many_dependants(home_tbox: TBox, profile: str):
    on = LINKS[profile][0]
    unsure = CONFIDENCE.replace("k:Cup", "k:Table").format("0.2")
    probable = "DELETE { ?r u2k:isCalibrated ?o } INSERT { ?r u2k:isCalibrated true } WHERE { ?r u2k:isCalibrated ?o }"
    three = added(f"k:Cupboard {on} k:Table")
    assert rules_in(open_room(home_tbox, profile, f"{unsure}; {three}")) == ["relation-apart"]
    assert found_in(open_room(home_tbox, profile, f"{unsure}; {probable}")) == ()
    apart, finding = found_in(open_room(home_tbox, profile, f"{unsure}; {probable}; {three}"))
    assert (apart.rule, finding.rule, finding.severity) == ("relation-apart", "low-confidence", "note")
    assert finding.found == (
        "1 object has a class of low confidence, and at least 3 objects on or in it: "
        "“Table” (/Table) with 3, class table, confidence 0.20"
    )


def test_nested_prims_are_not_duplicates(home_tbox: TBox):
    nested = with_thing("/Cup/Mesh", (0.2, 0.2, 0.75), (0.08, 0.08, 0.1), "Cup")
    assert found_in(open_room(home_tbox, "plain", placed=nested)) == ()


def test_measures_rotated_objects_along_their_own_axes(home_tbox: TBox):
    turned = replace(thing("/Mug", (1, 1, 0), (1.0, 1.0, 1.0)), oriented_size=(0.1, 0.1, 0.1))
    assert found_in(open_room(home_tbox, "soma", placed=[*ROOM_ONLY, (turned, "Cup")])) == ()


def test_a_file_overrides_single_values(home_tbox: TBox, tmp_path: Path):
    path = tmp_path / "rules.toml"
    path.write_text('[density]\nhighest = 100.0\nseverity = "note"\nadvice = "Weigh it."\n')
    (finding,) = found_in(open_room(home_tbox, "soma"), rules=read_rules(path))
    # 0.3 kg in 0.08 · 0.08 · 0.1 m³ is 469 kg/m³.
    assert (finding.prim_path, finding.severity, finding.advice) == ("/Cup", "note", "Weigh it.")
    assert (finding.found, finding.expected) == (
        "0.3 kg in a box of 0.08 × 0.08 × 0.1 m is 469 kg/m³",
        "1 to 100 kg/m³",
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[densities]\nlowest = 1", "'densities' is not a rule; expected tables named scene-scale, "),
        ("lowest = 1", "'lowest' is not a rule"),
        ("[density]\nleast = 1", "[density] has no key 'least'; expected enabled, severity, lowest, highest, advice"),
        ('[density]\nlowest = "1"', "[density] lowest is '1'; expected a number of at least 0"),
        ("[density]\nlowest = nan", "[density] lowest is nan; expected a number of at least 0"),
        ("[density]\nlowest = true", "[density] lowest is True; expected a number of at least 0"),
        ("[density]\nenabled = 1", "[density] enabled is 1; expected true or false"),
        ('[density]\nseverity = "bad"', "[density] severity is 'bad'; expected one of error, warning, note"),
        ("[below-floor]\nfloors = [1]", "[below-floor] floors is [1]; expected a list of strings"),
        ("[density", "cannot be read"),
    ],
)
def test_rejects_invalid_overrides(tmp_path: Path, text: str, message: str):
    path = tmp_path / "rules.toml"
    path.write_text(text)
    with pytest.raises(GraphError) as caught:
        read_rules(path)
    assert message in str(caught.value)


@PROFILES
def test_accepts_a_spoon_that_sticks_out_of_a_cup(home_tbox: TBox, profile: str):
    placed = with_thing("/Spoon", (0.21, 0.21, 0.76), (0.03, 0.02, 0.25), "Spoon")
    graph = open_room(home_tbox, profile, added(f"k:Spoon {LINKS[profile][1]} k:Cup"), placed=placed)
    assert "inside-smaller" not in {finding.rule for finding in found_in(graph)}


@PROFILES
def test_accepts_what_grows_wider_than_its_container(home_tbox: TBox, profile: str, tmp_path: Path):
    path = tmp_path / "rules.toml"
    path.write_text('[inside-smaller]\ngrowing_words = ["table"]\n')
    graph = open_room(home_tbox, profile, added(f"k:Table {LINKS[profile][1]} k:Bowl"))
    assert "inside-smaller" not in {finding.rule for finding in found_in(graph, rules=read_rules(path))}


@PROFILES
def test_accepts_a_top_on_several_slim_legs_but_not_on_one(home_tbox: TBox, profile: str):
    legs = [(thing(f"/Leg_{i}", (x, 4, 0), (0.05, 0.05, 0.7)), "DesignedComponent") for i, x in enumerate((4, 6.95))]
    placed = [*with_thing("/Top", (4, 3.6, 0.7), (3, 0.8, 0.04), "DesignedComponent"), *legs]
    one, other = (f"k:Top {LINKS[profile][0]} k:Leg_{i} ." for i in (0, 1))
    found = {f.rule for f in found_in(open_room(home_tbox, profile, added(one), placed=placed[:-1]))}
    assert "support-smaller" in found
    found = {f.rule for f in found_in(open_room(home_tbox, profile, added(one + other), placed=placed))}
    assert "support-smaller" not in found


@PROFILES
def test_ignores_the_confidence_of_relations(home_tbox: TBox, profile: str):
    update = (
        'DELETE { ?x sssom:confidence ?o } INSERT { ?x sssom:confidence "0.01"^^xsd:decimal } '
        "WHERE { ?x sssom:confidence ?o ; owl:annotatedProperty ?p . FILTER(?p != rdf:type) }"
    )
    assert {obj.confidence for obj in read_graph_objects(open_room(home_tbox, profile, update).store)} == {0.75}
