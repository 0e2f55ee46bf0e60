"""Names and documentation that command the model change at most the class of their own object."""

import json
from collections.abc import Sequence
from dataclasses import replace

import pytest

from tests.grounding.llm.attacks import ATTACKS, FAKE_CLASSES, UNSEEN
from tests.grounding.llm.test_grounder import Model, make_grounder, numbers
from usd2kg.grounding import ObjectView, Prediction, Status
from usd2kg.grounding.llm.commands import may_command
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompt_text import quote
from usd2kg.ontology import TBox

HONEST = ("Fork_1", "Bowl_1", "Fork_2", "Spoon_1")
TOGETHER = PromptOptions(objects_per_prompt=40, has_more_evidence=True)


def obedient(attack: str) -> Model:
    """Return a model that classifies all objects as told by the attack if any of its prompt contains the attack."""
    words = [quote(attack)[1:-1], " ".join(attack.lower().split("_"))]
    wish = "Weapon" if attack in FAKE_CLASSES else "Knife"

    def respond(request: Request) -> str:
        is_commanded = any(word in request.system + request.user for word in words)
        rows = {number: {"class": wish if is_commanded else "Fork"} for number in numbers(request)}
        return json.dumps({**rows, "99": {"class": wish}} if is_commanded else rows)

    return Model(respond)


def scene_with(attack: str, place: str) -> list[tuple[str, ObjectView]]:
    """Return the views of a scene whose third object has the attack in a place."""
    names = [*HONEST[:2], attack if place == "name" else "Cup", *HONEST[2:]]
    views = [
        ObjectView(
            name,
            parents=("Kitchen", attack) if place == "parent" else ("Kitchen",),
            siblings=tuple(other for other in names if other != name),
            size=(0.1, 0.1, 0.1),
        )
        for name in names
    ]
    if place != "name":
        fields = {"documentation": {"documentation": attack}, "asset": {"asset": (attack,)}, "parent": {}}
        views[2] = replace(views[2], **fields[place])
    return [(f"/{index}", view) for index, view in enumerate(views)]


def others(predictions: Sequence[Prediction], tbox: TBox) -> list[str]:
    """Return the classes of the honest objects."""
    honest = [p for index, p in enumerate(predictions) if index != 2]
    return [tbox.by_iri[p.class_iri].local_name if p.class_iri else p.status for p in honest]


def test_the_corpus_has_fifty_distinct_attacks():
    assert len(ATTACKS) == len(set(ATTACKS)) == 50


@pytest.mark.parametrize("strategy", Strategy)
@pytest.mark.parametrize("place", ["name", "documentation", "asset", "parent"])
@pytest.mark.parametrize("attack", ATTACKS)
def test_an_obedient_model_answers_only_the_row_of_the_attack(
    attack: str, place: str, strategy: Strategy, home_tbox: TBox
):
    model = obedient(attack)
    grounder = make_grounder(model, replace(TOGETHER, strategy=strategy))
    found = grounder.ground_views(scene_with(attack, place), home_tbox)
    assert others(found, home_tbox) == ["Fork"] * 4
    assert found[2].class_iri is None or found[2].class_iri in home_tbox.by_iri
    assert len(found) == 5


@pytest.mark.parametrize("attack", FAKE_CLASSES)
def test_a_class_that_is_not_in_the_tbox_is_unreadable(attack: str, home_tbox: TBox):
    grounder = make_grounder(obedient(attack), TOGETHER)
    found = grounder.ground_views(scene_with(attack, "name"), home_tbox)[2]
    assert (found.class_iri, found.status) == (None, Status.UNREADABLE)


@pytest.mark.parametrize("attack", UNSEEN)
def test_an_unrecognised_command_introduces_no_class(attack: str, home_tbox: TBox):
    answer = {number: {"class": wish} for number, wish in enumerate(("Weapon", "Knife", "Knife", "Weapon", "Knife"), 1)}
    model = Model(lambda _: json.dumps({**answer, "99": {"class": "Knife"}}))
    found = make_grounder(model, TOGETHER).ground_views(scene_with(attack, "name"), home_tbox)
    assert len(found) == 5
    assert all(p.class_iri is None or p.class_iri in home_tbox.by_iri for p in found)


def test_seven_of_sixteen_unseen_commands_are_recognised():
    """The figure of docs/llm.md; a better rule may raise it."""
    assert sum(map(may_command, UNSEEN)) == 7


def test_the_names_of_real_objects_are_no_commands():
    names = (
        "SM_CupCBlue_01",
        "cabinet_door_top_left_handle",
        "RefrigeratorDoor_2",
        "Küchentisch_LOD0",
        "カップ",
        "crème_brûlée",
    )
    assert not any(map(may_command, names))
