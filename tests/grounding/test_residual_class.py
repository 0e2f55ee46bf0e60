"""Classes for everything else, as in NYU40 (Gupta et al., CVPR 2013), and ontologies without a general class."""

from dataclasses import replace

import pytest

from tests.grounding.ontologies import load_ontology, parse_outline
from tests.grounding.records import LAB, ground_names, scene_of
from usd2kg.grounding import ObjectView, Status, ground
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.alignment.residual_class import find_default_class, residue_of
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import load_home_tbox


@pytest.mark.parametrize(
    ("label", "residue"),
    [
        ("otherfurniture", "furniture"),
        ("other structures", "structure"),
        ("Miscellaneous kitchen tools", "kitchen tool"),
        ("otherprop", ""),
        ("sundry item", ""),
        ("Sundries", ""),
        ("Misc", ""),
        ("miscellaneous objects", ""),
        ("furniture", None),
        ("mother", None),
        ("prop", None),
        ("another chair", None),
        ("", None),
    ],
)
def test_residue_is_the_category_that_a_label_covers_the_rest_of(label: str, residue: str | None):
    assert residue_of(label, load_taxonomy()) == residue


@pytest.mark.parametrize(
    ("outline", "default"),
    [
        ("Chair\nTable", None),
        ("Furniture\n  Chair\n  Table\nTool", None),
        # The only root: true of its kinds alone, or of anything.
        ("Furniture\n  Chair\n  Table", None),
        ("Vehicle\n  Car\n  Truck\n    Forklift", None),
        ("Component\n  Pump\n  Valve", "Component"),
        ("Artifact\n  Chair\nPerson", "Artifact"),
        ("StockItem\n  Chair\nPerson", "StockItem"),
        # A word that no dictionary has may mean anything.
        ("Zorkable\n  Chair\nPerson", "Zorkable"),
        ("Object\n  Table\nActivity\n  Other", "Object"),
        ("chair\ntable\notherfurniture", None),
        ("Alone\nWide\n  A\n  B", "Wide"),
        # No physical thing is a command.
        ("Command\n  OpenCommand\n  CloseCommand\n  StopCommand\nManaged\n  Fridge", "Managed"),
        ("Managed\n  Fridge\nUnManaged\n  Wall", "UnManaged"),
    ],
)
def test_default_class_is_a_root_that_most_things_belong_to(outline: str, default: str | None):
    iri = build_lexicon(parse_outline(outline), load_taxonomy(), {}).default_class
    assert (iri and iri.removeprefix(LAB)) == default


def test_a_residual_class_of_one_category_is_no_default():
    assert find_default_class(load_ontology("other activities"), load_taxonomy()) == LAB + "Object"
    assert find_default_class(load_ontology("chairs, tables and other furniture"), load_taxonomy()) is None


def test_general_classes_are_roots_and_residual_classes():
    grounder, home = LexicalGrounder(), load_home_tbox()
    assert grounder.general_classes(load_ontology("shop")) == {LAB + n for n in ("ShopThing", "MiscItem", "Process")}
    assert LAB + "chair" not in grounder.general_classes(load_ontology("labels"))
    assert grounder.general_classes(home) == frozenset(home.roots)


class TestWithoutGeneralClass:
    FLAT = load_ontology("no general class")
    OTHERS = ("kitchen_scale", "table_fork", "teddy", "qwrtzx", "pCube3", "")

    @pytest.mark.parametrize("abstains", [False, True])
    def test_an_object_of_no_class_is_refused_without_confidence(self, abstains: bool):
        views = [(f"/x{at}", ObjectView(name)) for at, name in enumerate(self.OTHERS)]
        predictions = LexicalGrounder(abstains=abstains).ground_views(views, self.FLAT)
        assert {(p.class_iri, p.status, p.confidence) for p in predictions} == {(None, Status.REFUSED, None)}

    def test_an_object_of_a_class_is_grounded_with_confidence(self):
        predictions = ground_names(["chair_06", "Fridge_01"], self.FLAT)
        assert all(p.confidence > 0.5 for p in predictions)

    def test_explanation_says_why_no_class_is_predicted(self):
        scale, unknown = ground_names(["kitchen_scale", "qwrtzx"], self.FLAT)
        assert scale.explanation.startswith("“kitchen scale” is a kind of ")
        assert scale.explanation.endswith("“artifact”, which is no class of the ontology")
        assert unknown.explanation.endswith("; no class of the ontology applies to most objects")

    def test_all_predicted_classes_and_candidates_are_classes_of_the_ontology(self):
        scene = scene_of(*(f"/World/{name}" for name in ["chair_06", "side_plate", *filter(None, self.OTHERS)]))
        for prediction in ground(scene, self.FLAT).predictions:
            assert {candidate.class_iri for candidate in prediction.candidates} <= self.FLAT.by_iri.keys()
            assert prediction.class_iri is None or prediction.class_iri in self.FLAT.by_iri

    def test_part_of_the_home_ontology_needs_no_general_class(self):
        home = load_home_tbox()
        names = ("Cup", "Bowl", "Sofa")
        part = replace(home, classes=tuple(replace(home.by_iri[home.resolve(name)], parents=()) for name in names))
        cup, teddy = ground_names(["coffee_mug", "teddy"], part)
        assert (cup.class_iri, teddy.class_iri) == (home.resolve("Cup"), None)
