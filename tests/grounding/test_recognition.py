"""Concepts that the words of objects name, independent of ontology and grounder."""

import json

import pytest

from benchmarks.bare import bare_object, bare_scene
from tests.grounding.records import make_class, make_object, make_scene, make_tbox
from tests.kitchen import kitchen_scene
from usd2kg.grounding import Grounding, NamingRegime, Prediction, Status, concepts_named, ground
from usd2kg.grounding.lexical.recognition import ConfidenceWeights, describe_concepts
from usd2kg.knowledge import read_text
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.scene import Scene
from usd2kg.scene.model import Label, ObjectLabels

HALL = make_tbox(make_class("Asset"), make_class("Machine", "Asset", label="machine"))
"""An ontology without a class for any object of a home."""


@pytest.fixture(scope="module")
def demo() -> Scene:
    return kitchen_scene()


def concepts_of(grounding: Grounding) -> dict[str, str | None]:
    """Return prim path → label of the concept."""
    return {
        p.prim_path: grounding.concepts[p.concept].label if p.concept is not None else None
        for p in grounding.predictions
    }


def concept_of(name: str, tbox: TBox = HALL, **known) -> str | None:
    (found,) = concepts_of(ground(make_scene(make_object(f"/World/{name}", **known)), tbox)).values()
    return found


class TestWords:
    @pytest.mark.parametrize(
        ("name", "concept"),
        [
            ("BookE_01_029", "book"),
            ("couch_3", "sofa"),
            ("NightStand", "nightstand"),
            ("coffee_table_oak", "coffee table"),
            ("tulip_red", "tulip"),
            ("TV_01", "television"),
            # A compound of the home vocabulary alone.
            ("HouseWallB_01", "wall"),
            # The head noun comes first.
            ("plate_dinner", "dinner plate"),
            # Words that describe others name an object where they are alone.
            ("safe", "safe"),
            ("notepad", "notepad"),
            # Spanish for fork.
            ("tenedor", "fork"),
        ],
    )
    def test_the_head_noun_names_the_concept(self, name: str, concept: str):
        assert concept_of(name) == concept

    @pytest.mark.parametrize("name", ["Cube_12", "obj_042", "xqzt", "__"])
    def test_words_that_name_nothing_have_none(self, name: str):
        assert concept_of(name) is None

    @pytest.mark.parametrize(
        ("name", "label", "concept"),
        [("SM_PaletteA_01", "pallet", "pallet"), ("armchair_2", "chair", "armchair"), ("chair_77", "Q11442", "chair")],
    )
    def test_a_label_that_contradicts_the_name_decides(self, name: str, label: str, concept: str):
        own = (Label(f"/World/{name}", "Isaac", "class", label),)
        assert concept_of(name, labels=ObjectLabels(own, (), ())) == concept

    def test_an_asset_names_it_where_the_name_does_not(self):
        assert concept_of("obj_042", asset=("teapot",)) == "teapot"

    @pytest.mark.parametrize(
        ("name", "concept"), [("Mesh_03", "mug"), ("xqzt", "mug"), ("red", None), ("safe", "safe")]
    )
    def test_a_group_names_its_members_only_if_their_names_do_not(self, name: str, concept: str | None):
        scene = make_scene(make_object("/World/mugs", kind="group"), make_object(f"/World/mugs/{name}"))
        assert concepts_of(ground(scene, HALL))[f"/World/mugs/{name}"] == concept

    def test_parts_do_not_name_the_whole(self):
        assert concept_of("obj_042", parts=("seat", "backrest")) is None

    def test_a_prefix_that_the_names_of_the_stage_share_is_left_out(self):
        things = ("Bucket", "Chair", "Lamp", "Shelf", "Table", "Cup", "Bottle", "Sofa")
        scene = bare_scene("depot", [bare_object(f"/World/robomaker_{name}_01", (0.5, 0.5, 0.5)) for name in things])
        assert [*concepts_of(ground(scene, HALL)).values()] == [name.lower() for name in things]

    def test_the_size_decides_between_head_nouns(self):
        # Either a stand for a bike, or a bike.
        low = bare_scene("s", [bare_object("/bike_rack", (2.0, 0.6, 0.8))])
        assert [*concepts_of(ground(low, HALL)).values()] == ["bicycle rack"]


class TestIndependence:
    def test_every_ontology_gives_the_same_concepts(self, demo: Scene):
        own, other = ground(demo, load_home_tbox()), ground(demo, HALL)
        # A grounder reads abbreviations with the words of its ontology.
        abbreviated = {p.prim_path for found in (own, other) for p in found.predictions if p.words}
        differing = {path for path, concept in concepts_of(own).items() if concepts_of(other)[path] != concept}
        assert len(abbreviated) < 20
        assert differing <= abbreviated
        assert len(differing) <= 1

    def test_every_grounder_has_them(self):
        scene = make_scene(make_object("/World/couch_3"))
        assert concepts_of(ground(scene, load_home_tbox(), "volume")) == {"/World/couch_3": "sofa"}

    def test_an_object_without_a_class_has_one(self):
        (prediction,) = ground(make_scene(make_object("/World/couch_3")), load_home_tbox(), "volume").predictions
        assert (prediction.status, prediction.class_iri) == (Status.REFUSED, None)
        assert prediction.concept is not None


class TestRegimes:
    def test_an_opaque_name_has_none(self, demo: Scene):
        for regime in (NamingRegime.OPAQUE, NamingRegime.OPAQUE_ANONYMOUS):
            found = ground(demo, load_home_tbox(), regime=regime)
            assert not any(p.concept for p in found.predictions)
            assert found.concepts == {}

    def test_an_abbreviated_name_has_that_of_the_words_it_was_read_as(self):
        # Neither the name nor the asset may be seen: the view has “tpt”.
        scene = make_scene(make_object("/World/teapot", asset=("dinosaur",)))
        found = ground(scene, load_home_tbox(), regime=NamingRegime.ABBREVIATED)
        (prediction,) = found.predictions
        assert (prediction.words, concepts_of(found)) == (("teapot",), {"/World/teapot": "teapot"})


class TestDecisions:
    SCENE = make_scene(make_object("/World/mug_1"))

    @pytest.mark.parametrize(
        ("chosen", "concept"), [("Cup", "mug"), ("Crockery", "mug"), ("DesignedArtifact", "mug"), ("Fork", None)]
    )
    def test_a_decision_for_another_kind_of_thing_contradicts_the_name(self, chosen: str, concept: str | None):
        tbox = load_home_tbox()
        found = ground(self.SCENE, tbox, decisions={"/World/mug_1": tbox.resolve(chosen)})
        assert concepts_of(found) == {"/World/mug_1": concept}

    @pytest.mark.parametrize(("chosen", "concept"), [("Bowl", None), ("DesignedArtifact", "ball")])
    def test_a_coarse_class_does_not_agree_with_each_of_its_subclasses(self, chosen: str, concept: str | None):
        # By its name the ball is only a designed artifact, of which bowls are a subclass.
        tbox = load_home_tbox()
        found = ground(make_scene(make_object("/World/ball")), tbox, decisions={"/World/ball": tbox.resolve(chosen)})
        assert concepts_of(found) == {"/World/ball": concept}

    def test_a_class_that_no_noun_names_agrees(self):
        tbox = make_tbox(make_class("Item"), make_class("B17", "Item", label="B17"))
        scene = make_scene(make_object("/World/guitar_1"))
        found = ground(scene, tbox, decisions={"/World/guitar_1": tbox.resolve("B17")})
        assert concepts_of(found) == {"/World/guitar_1": "guitar"}


class TestConfidence:
    FITTED = json.loads(read_text("concept_confidence.json"))

    def test_it_is_a_logistic_function_of_the_log_odds(self):
        # 1 / (1 + exp(-(1 + 2 · ln(0.75 / 0.25)))) = 1 / (1 + exp(-1) / 9)
        assert ConfidenceWeights(1.0, 2.0).probability(0.75) == pytest.approx(0.9607295)

    def test_one_known_sense_is_not_certain(self):
        weights = ConfidenceWeights(**self.FITTED["weights"])
        assert weights.probability(1.0) == weights.probability(0.9) < 0.99

    def test_it_is_calibrated_on_lists_that_were_left_out(self):
        assert self.FITTED["names"] > 10_000
        assert self.FITTED["calibration_error_when_left_out"] < 0.06

    def test_predictions_have_it(self):
        (prediction,) = ground(make_scene(make_object("/World/couch_3")), HALL).predictions
        assert prediction.concept_confidence is not None
        assert 0.8 < prediction.concept_confidence < 1


class TestDescriptions:
    def test_all_hypernyms_are_described(self):
        (book,) = [iri for iri in concepts_named("book") if iri.endswith("/02873453-n")]
        described = describe_concepts([book])
        assert described[book].label == "book"
        assert {up for concept in described.values() for up in concept.broader} <= described.keys()
        assert {"product", "creation", "artifact", "entity"} <= {concept.label for concept in described.values()}

    def test_an_unknown_iri_is_left_out(self):
        assert describe_concepts(["https://lab.example/onto#Cup"]) == {}

    def test_nouns_in_the_plural_have_the_same_senses(self):
        assert concepts_named("Coffee tables") == concepts_named("coffee table") != ()
        assert concepts_named("") == concepts_named("xqzt") == ()

    def test_a_grounding_describes_the_concepts_of_its_predictions(self, demo: Scene):
        found = ground(demo, load_home_tbox())
        used = {p.concept for p in found.predictions if p.concept is not None}
        assert used <= found.concepts.keys()
        assert len(used) > 80


def test_a_missing_prim_has_no_concept():
    found = ground(make_scene(make_object("/World/cup")), HALL, paths=["/World/couch"])
    assert found.predictions == (
        Prediction("/World/couch", None, None, Status.MISSING, "lexical", "there is no such prim on the stage"),
    )
