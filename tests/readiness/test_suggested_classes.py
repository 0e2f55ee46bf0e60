"""Subclasses suggested for what has only a coarse class."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.conftest import shared_file
from tests.grounding.records import LAB, make_class, make_object, make_scene, make_tbox
from usd2kg.grounding import Status, ground
from usd2kg.ontology import TBox, load_tbox
from usd2kg.readiness import Proposal, SuggestedClass, format_suggestions, suggest_classes
from usd2kg.scene import read_scene

SHOP = make_tbox(make_class("Item", label="item"), make_class("OfficeChair", "Item", label="office chair"))


def suggest(names: str, tbox: TBox = SHOP) -> list[SuggestedClass]:
    scene = make_scene(*(make_object(f"/Shop/{name}") for name in names.split()))
    return suggest_classes([ground(scene, tbox)], tbox)


def summary(suggested: list[SuggestedClass]) -> list[tuple[str, str, int]]:
    return [(one.label, one.parent.removeprefix(LAB), len(one.objects)) for one in suggested]


def test_concepts_are_counted_the_most_frequent_first():
    assert summary(suggest("guitar_1 guitar_2 piano guitar_3")) == [("guitar", "Item", 3), ("piano", "Item", 1)]


def test_scenes_are_counted_together():
    scenes = [make_scene(make_object(f"/{room}/guitar")) for room in ("A", "B")]
    (one,) = suggest_classes((ground(scene, SHOP) for scene in scenes), SHOP)
    assert one.objects == ("/A/guitar", "/B/guitar")


def test_a_concept_has_the_superclass_of_most_of_its_objects():
    tbox = make_tbox(make_class("Item"), make_class("Toy", "Item"), make_class("Tool", "Item"))
    grounding = ground(make_scene(*(make_object(f"/guitar_{n}") for n in range(4))), tbox)

    def suggested(*answers: tuple[str, float]) -> list[tuple[str, str, int]]:
        changed = (
            replace(p, class_iri=LAB + name, confidence=confidence, status=Status.GROUNDED)
            for p, (name, confidence) in zip(grounding.predictions, answers, strict=False)
        )
        return summary(suggest_classes([replace(grounding, predictions=tuple(changed))], tbox))

    assert suggested(("Toy", 0.9), ("Tool", 0.9), ("Toy", 0.9)) == [("guitar", "Toy", 3)]
    # A doubtful class is not hardened.
    assert suggested(("Toy", 0.4), ("Toy", 0.4), ("Tool", 0.9)) == [("guitar", "Item", 3)]


def test_without_a_majority_the_common_superclass_is_the_parent():
    tbox = make_tbox(
        make_class("Item"), make_class("Tool", "Item"), make_class("Saw", "Tool"), make_class("Axe", "Tool")
    )
    grounding = ground(make_scene(*(make_object(f"/guitar_{n}") for n in range(3))), tbox)
    changed = (
        replace(p, class_iri=LAB + name, confidence=0.9, status=Status.GROUNDED)
        for p, name in zip(grounding.predictions, ("Saw", "Axe", "Item"), strict=True)
    )
    found = suggest_classes([replace(grounding, predictions=tuple(changed))], tbox)
    assert summary(found) == [("guitar", "Tool", 3)]


def test_classes_with_foreign_labels_are_not_suggested():
    tbox = make_tbox(
        make_class("Item"), replace(make_class("C1", "Item", label="Stuhl"), foreign_names=(("de", "Stuhl"),))
    )
    assert summary(suggest("chair_1 guitar", tbox)) == [("guitar", "Item", 1)]


@pytest.mark.parametrize("reviewer", ["0000-0002-1825-0097", "orcid:0000-0002-1825-0097"])
def test_an_orcid_id_of_a_proposer_is_an_iri(reviewer: str):
    (one,) = suggest("guitar")
    proposal = Proposal(reviewer, "2026-11-01T10:00:00Z", "")
    text = format_suggestions([replace(one, proposals=(proposal,))], SHOP)
    assert "dcterms:creator <https://orcid.org/0000-0002-1825-0097>" in text


def test_what_the_ontology_names_is_not_suggested():
    # A chair is an office chair here, by the head noun of the label.
    assert summary(suggest("item_1 office_chair chair_2")) == []


def test_other_names_of_a_class_may_be_kinds_of_it(home_tbox: TBox):
    assert summary(suggest("book_1", home_tbox)) == [
        ("book", "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#DesignedArtifact", 1)
    ]


@pytest.mark.parametrize("name", ["Cube_1", "obj_3", "xqzt"])
def test_what_is_not_understood_is_not_suggested(name: str):
    assert suggest(name) == []


def test_the_file_is_an_ontology_that_grounds_to_the_suggestions(tmp_path: Path):
    tbox = make_tbox(make_class("Item", label="item"), make_class("Tool", "Item", label="tool"))
    path = tmp_path / "suggested.ttl"
    path.write_text(format_suggestions(suggest("guitar_1 guitar_2", tbox), tbox), encoding="utf-8")
    extended = load_tbox(path)
    (guitar,) = [cls for cls in extended.classes if cls.label == "guitar"]
    assert guitar.parents == (LAB + "Item",)
    assert guitar.comment == ""
    text = path.read_text("utf-8")
    assert 'skos:editorialNote "suggested by usd2kg for 2 objects"' in text
    assert 'skos:example "/Shop/guitar_1" , "/Shop/guitar_2"' in text
    (prediction,) = ground(make_scene(make_object("/Shop/guitar_9")), extended).predictions
    assert (prediction.class_iri, prediction.status) == (guitar.iri, Status.GROUNDED)


def test_labels_become_local_names(tmp_path: Path):
    path = tmp_path / "suggested.ttl"
    path.write_text(format_suggestions(suggest("13_amp_socket coffee_table"), SHOP), encoding="utf-8")
    names = {cls.local_name for cls in load_tbox(path).classes}
    assert "CoffeeTable" in names


def test_one_name_below_two_classes_is_two_classes(tmp_path: Path):
    tbox = make_tbox(make_class("Item"), make_class("Lamp", "Item"), make_class("Bin", "Item"))
    path = tmp_path / "suggested.ttl"
    said = (Proposal("Ann", "2026-01-05T10:00:00Z", ""),)
    proposed = [
        SuggestedClass(label, None, LAB + parent, (f"/Shop/{parent}",), said)
        for label, parent in (("hall unit", "Lamp"), ("Hall-Unit", "Bin"), ("hall unit", "Lamp"))
    ]
    path.write_text(format_suggestions(proposed, tbox), encoding="utf-8")
    parents = {cls.local_name: cls.parents for cls in load_tbox(path).classes}
    assert (parents["HallUnit"], parents["HallUnit_2"]) == ((LAB + "Lamp",), (LAB + "Bin",))
    assert "HallUnit_3" not in parents


def test_decisions_of_people_count():
    scene = make_scene(make_object("/Shop/guitar"))
    found = ground(scene, SHOP, decisions={"/Shop/guitar": LAB + "Item"})
    assert found.predictions[0].status is Status.REVIEWED
    assert summary(suggest_classes([found], SHOP)) == [("guitar", "Item", 1)]


def test_the_books_of_a_real_scene(home_tbox: TBox):
    scene = read_scene(shared_file("scenes/aws_robomaker/bookstore.usdc"))
    first = suggest_classes([ground(scene, home_tbox)], home_tbox)[0]
    assert (first.label, len(first.objects)) == ("book", 39)
