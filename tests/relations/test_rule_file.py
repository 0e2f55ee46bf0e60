"""Relation rules and their overrides."""

from pathlib import Path

import pytest

from tests.graph.records import related, thing
from tests.relations.room_builder import TABLE, artifact, cup, relate
from usd2kg.errors import GraphError
from usd2kg.ontology import expand_curie, load_home_tbox
from usd2kg.relations import ALL_KINDS, Viewpoint, load_rules


@pytest.fixture
def rules_file(tmp_path: Path):
    def write(text: str) -> Path:
        path = tmp_path / "rules.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_defaults_to_the_packaged_rules():
    assert load_rules() is load_rules()
    assert load_rules().on.rule == "on/1"


def test_every_class_of_the_lists_is_known_to_the_home_ontology():
    known = {cls.iri for cls in load_home_tbox().classes}
    classes = load_rules().classes
    listed = [name for value in classes if isinstance(value, tuple) for name in value]
    concepts = ("http://wordnet-rdf.princeton.edu/id/", "https://w3id.org/usd2kg/concept/")
    classes_listed = [name for name in listed if not name.startswith(concepts)]
    assert not [name for name in classes_listed if expand_curie(name.removeprefix("=")) not in known]


def test_overrides_single_values(rules_file):
    path = rules_file("[on]\nmax_gap = 0.2\nmin_gap = 0.2\n\n[next_to]\nmost = 1\n")
    rules = load_rules(path)
    assert (rules.on.max_gap, rules.next_to.most) == (0.2, 1)
    assert rules.on.min_overlap_ratio == load_rules().on.min_overlap_ratio
    assert rules.inside == load_rules().inside
    (relation,) = relate(TABLE, cup((0.4, 0.4, 0.85)), rules=rules)
    assert relation.numbers == pytest.approx({"gap": 0.15, "overlapRatio": 1})
    assert relate(TABLE, cup((0.4, 0.4, 0.85))) == ()


def test_overrides_the_id_of_a_rule(rules_file):
    rules = load_rules(rules_file('[on]\nrule = "lab-on/1"\n'))
    assert [r.rule for r in relate(TABLE, cup((0.4, 0.4, 0.7)), rules=rules)] == ["lab-on/1"]


class TestClasses:
    AROUND = (thing("/around", (0, 0, 0), (1, 1, 1)), "Table")
    CRUMB = artifact("crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1))

    def test_replaces_a_class_list(self, rules_file):
        rules = load_rules(rules_file('[classes]\ncontainers = ["soma:Table"]\n'))
        assert rules.classes.containers == ("soma:Table",)
        assert related(relate(self.AROUND, self.CRUMB, rules=rules)) == {("crumb", "inside", "around")}
        rack = (thing("/rack", (0, 0, 0), (1, 1, 1)), "Rack")
        assert relate(rack, self.CRUMB, rules=rules) == ()

    def test_extends_a_class_list(self, rules_file):
        rules = load_rules(rules_file('[classes.extend]\ncontainers = ["soma:Table"]\n'))
        assert rules.classes.containers == (*load_rules().classes.containers, "soma:Table")
        rack = (thing("/rack", (0, 0, 0), (1, 1, 1)), "Rack")
        assert related(relate(rack, self.CRUMB, rules=rules)) == {("crumb", "inside", "rack")}

    def test_an_equals_sign_excludes_subclasses(self, rules_file):
        # An armchair is a chair.
        for name, expected in (("soma:DesignedChair", True), ("=soma:DesignedChair", False)):
            rules = load_rules(rules_file(f'[classes]\ncontainers = ["{name}"]\n'))
            armchair = (thing("/around", (0, 0, 0), (1, 1, 1)), "Armchair")
            assert bool(relate(armchair, self.CRUMB, rules=rules)) is expected

    def test_accepts_full_and_unknown_iris(self, rules_file):
        table = "http://www.ease-crc.org/ont/SOMA.owl#Table"
        rules = load_rules(
            rules_file(f'[classes.extend]\ncontainers = ["{table}", "https://lab.example/onto#Bench"]\n')
        )
        assert related(relate(self.AROUND, self.CRUMB, rules=rules)) == {("crumb", "inside", "around")}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "[onn]\n",
            r"section \[onn\] is unknown; expected one of geometry, blocking, on, on_several, hovering, inside",
        ),
        ("[on]\ngap = 1\n", r"\[on\]: key 'gap' is unknown; expected one of rule, min_overlap_ratio"),
        ("on = 3\n", r"on is 3; expected a section \[on\] with keys and values"),
        ('[on]\nmin_gap = "much"\n', r"\[on\] min_gap is 'much'; expected a finite number, like 0.01"),
        ("[on]\nmin_gap = true\n", r"\[on\] min_gap is True; expected a finite number"),
        ("[on]\nmin_gap = nan\n", r"\[on\] min_gap is nan; expected a finite number"),
        ("[near]\nmost = 2.5\n", r"\[near\] most is 2.5; expected a whole number, not negative, like 2"),
        ("[near]\nmost = -1\n", r"\[near\] most is -1; expected a whole number"),
        ("[on]\nrule = 1\n", r"\[on\] rule is 1; expected a text, like 'on/1'"),
        ('[room]\nwords = "hall"\n', r"\[room\] words is 'hall'; expected a list of texts"),
        ("[classes]\nbig = []\n", r"\[classes\]: key 'big' is unknown; expected one of not_placed, not_laid"),
        ("[classes.extend]\nbig = []\n", r"\[classes.extend\]: key 'big' is unknown; expected one of not_placed"),
        ("[classes.extend]\ncontainment_disposition = []\n", "key 'containment_disposition' is unknown"),
        ("[classes.extend]\nrooms = [1]\n", r"\[classes.extend\] rooms is \[1\]; expected a list of texts"),
        ("[classes]\nextend = 1\n", r"\[classes.extend\] is 1; expected lists of classes"),
        ("[on\n", "not valid TOML"),
    ],
)
def test_rejects_invalid_rule_files(rules_file, text: str, message: str):
    path = rules_file(text)
    with pytest.raises(GraphError, match=message) as raised:
        load_rules(path)
    assert str(raised.value).startswith(str(path))


def test_extreme_thresholds_do_not_divide_by_zero(rules_file):
    limits = """
    [on]
    min_overlap_ratio = 1.0
    min_gap = 0
    max_gap = 0
    max_sink = 0
    [hovering]
    max_gap = 0
    [attached]
    max_gap = 0
    max_contact = 0
    [inside]
    min_volume_ratio = 1.0
    [above]
    min_overlap_ratio = 1.0
    [touching]
    max_gap = 0
    max_sink = 0
    min_face_share = 1.0
    [next_to]
    min_gap = 0
    max_gap = 0
    min_height_share = 1.0
    [near]
    min_gap = 0
    max_gap = 0
    [room]
    clear_margin = 0
    [side]
    tolerance_deg = 0
    [part_of]
    max_gap = 0
    """
    row = [thing(f"/a{i}", (i, 0, 0.7), (1, 1, 1)) for i in range(2)]
    room = [(thing("/room", (-1, -1, -1), (5, 5, 5)), "Room"), TABLE, *((obj, "Box") for obj in row)]
    view = Viewpoint((-5, 0.5, 1), (1, 0, 0))
    found = relate(*room, kinds=ALL_KINDS, viewpoint=view, rules=load_rules(rules_file(limits)))
    assert {r.kind for r in found} >= {"touching", "next-to", "room", "front", "behind"}
    assert all(r.confidence == 1 for r in found)


class TestPage:
    """docs/relations.md matches the rules."""

    PAGE = (Path(__file__).parents[2] / "docs/relations.md").read_text("utf-8")

    def test_every_kind_and_rule_is_described(self):
        rules = load_rules()
        assert not [kind for kind in ALL_KINDS if f"`{kind}`" not in self.PAGE]
        names = ("rule", "group_rule", "floor_rule", "surrounded_rule", "stated_rule", "tree_rule", "fitted_rule")
        ids = [getattr(section, name, None) for section in rules for name in names]
        assert not [rule for rule in ids if isinstance(rule, str) and f"`{rule}`" not in self.PAGE]

    def test_documented_example_is_valid(self, rules_file):
        example = self.PAGE.partition('```toml title="my_rules.toml"\n')[2].partition("```")[0]
        rules = load_rules(rules_file(example))
        assert (rules.on.rule, rules.near.most) == ("lab-on/1", 5)
        assert "=soma:Box" in rules.classes.closed

    def test_documented_thresholds_match_the_rules(self):
        rules = load_rules()
        documented = {
            "More than 30 % of what the target stands on": rules.on.min_overlap_ratio == 0.3,
            "hovers at most 7 cm over something": rules.hovering.max_gap == 0.07,
            "wall or ceiling within 6 cm (15 cm for curtains": rules.attached.max_gap == 0.06,
            "hold what touches them, within 1 cm": rules.attached.max_contact == 0.01,
            "3 cm above the ground, furniture 15 cm": (rules.attached.min_clearance, rules.attached.max_plinth)
            == (0.03, 0.15),
            "At least half of the downward rays": rules.inside.min_below == 0.5,
            "70 % of the downward, upward and horizontal rays meet it": rules.inside.min_surrounded == 0.7,
            "At least 60 % of the target's box": rules.inside.min_volume_ratio == 0.6,
            "more than 30 % of the smaller footprint": rules.above.min_overlap_ratio == 0.3,
            "above its nearest four": rules.above.most == 4,
            "within 2.5 mm": rules.touching.max_gap == 0.0025,
            "half the width of the smaller one (5 cm to 50 cm)": rules.next_to.gap_share == 0.5,
            "among the nearest three": rules.next_to.most == 3,
            "mean extent of the smaller one (10 cm to 1 m)": rules.near.gap_share == 1,
            "among the nearest two": rules.near.most == 2,
            "1 m × 1 m × 1.5 m large": (rules.room.min_side, rules.room.min_height) == (1, 1.5),
            "More than 51 % of the target's footprint": rules.between.min_hull_ratio == 0.51,
            "within 40 degrees": rules.side.tolerance_deg == 40,
        }
        page = " ".join(self.PAGE.split())
        assert not [text for text, holds in documented.items() if not holds or text not in page]


def test_rejects_a_missing_file(tmp_path: Path):
    with pytest.raises(GraphError, match=r"none.toml: cannot be read as relation rules .*; expected a TOML file"):
        load_rules(tmp_path / "none.toml")


def test_every_kind_has_a_distinct_rule():
    rules = load_rules()
    names = ("rule", "group_rule", "floor_rule", "surrounded_rule", "stated_rule", "tree_rule", "fitted_rule")
    found = [getattr(section, name, None) for section in rules for name in names]
    ids = [rule for rule in found if isinstance(rule, str)]
    assert len(ids) == len(set(ids))
    kinds = {"side" if kind in {"left", "right", "front", "behind"} else kind for kind in ALL_KINDS} - {"below"}
    assert {rule.partition("/")[0] for rule in ids} == kinds
