"""What each source says about each candidate."""

import pytest

from usd2kg.demo import demo_scene
from usd2kg.grounding.context.views import view_objects
from usd2kg.grounding.lexical.candidate_evidence import CandidateEvidence
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import read_scene

GLASS = "/KitchenDining/diningArea/wineGlass_04"
TBOX = load_home_tbox()


@pytest.fixture(scope="module")
def weighed() -> dict[str, dict[str, CandidateEvidence]]:
    """Class name → evidence group → evidence about a wine glass of the demo."""
    view = next(view for obj, view in view_objects(read_scene(demo_scene())) if obj.prim_path == GLASS)
    classes = {name: TBOX.resolve(name) for name in ("WineGlass", "WineBottle", "Wardrobe")}
    found = LexicalGrounder().weigh(view, classes.values(), TBOX)
    return {name: {each.group: each for each in found[iri]} for name, iri in classes.items()}


def test_all_sources_speak_not_only_the_one_that_decided(weighed: dict[str, dict[str, CandidateEvidence]]):
    glass = weighed["WineGlass"]
    assert list(glass) == ["name", "asset", "neighbours", "size", "stance", "place"]
    assert "“wine glass” is the label of WineGlass" in glass["name"].explanation
    assert glass["asset"].explanation.endswith("(from its asset)")
    assert "is WineGlass" in glass["neighbours"].explanation
    assert all(0 < (glass[group].score or 0) <= 1 for group in ("name", "asset", "neighbours"))


def test_size_and_place_are_likelihood_ratios(weighed: dict[str, dict[str, CandidateEvidence]]):
    glass, wardrobe = weighed["WineGlass"], weighed["Wardrobe"]
    assert glass["size"].explanation == "0.20 × 0.08 × 0.08 m, usually 0.21 × 0.08 × 0.08 m"
    assert (glass["size"].likelihood_ratio or 0) > 10
    assert (wardrobe["size"].likelihood_ratio or 1) < 0.1
    assert glass["place"].explanation == "in what seems a dining area"
    assert (glass["place"].likelihood_ratio or 0) > 1 > (wardrobe["place"].likelihood_ratio or 1)
    assert {each.score for each in wardrobe.values()} == {None}


def test_words_for_the_wrong_candidate_are_weaker(weighed: dict[str, dict[str, CandidateEvidence]]):
    right, wrong = (weighed[name]["name"].score or 0 for name in ("WineGlass", "WineBottle"))
    assert right > 2 * wrong > 0
    assert "head noun" in weighed["WineBottle"]["name"].explanation


def test_without_geometry_and_neighbours_only_words_are_left():
    groups = frozenset({"name"})
    view = next(v for obj, v in view_objects(read_scene(demo_scene()), groups=groups) if obj.prim_path == GLASS)
    found = LexicalGrounder().weigh(view, [TBOX.resolve("WineGlass"), TBOX.resolve("Wardrobe")], TBOX)
    assert [[each.group for each in evidence] for evidence in found.values()] == [["name"], []]


def test_likelihood_ratios_have_mean_1_over_the_prior():
    scene = read_scene(demo_scene())
    view = next(view for obj, view in view_objects(scene) if obj.prim_path == GLASS)
    grounder = LexicalGrounder()
    found = grounder.weigh(view, [cls.iri for cls in TBOX.classes], TBOX)
    prior = grounder.object_grounder(TBOX)._context.prior
    for group in ("size", "stance", "place"):
        ratios = {iri: e.likelihood_ratio for iri, items in found.items() for e in items if e.group == group}
        assert sum(prior.probability(iri) * (ratio or 0.0) for iri, ratio in ratios.items()) == pytest.approx(1)
