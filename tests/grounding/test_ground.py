"""`ground`: which objects are grounded, in which order, and what is recorded of the run."""

from collections.abc import Mapping, Sequence
from importlib.metadata import version

import pytest

from tests.grounding.records import LAB, make_class, make_object, make_scene, make_tbox, scene_of
from usd2kg.errors import GroundingError
from usd2kg.grounding import (
    EVIDENCE_GROUPS,
    NamingRegime,
    ObjectView,
    Prediction,
    Status,
    ground,
    parse_evidence,
    parse_regime,
)
from usd2kg.ontology import TBox
from usd2kg.scene import Box

TBOX = make_tbox(make_class("Thing"))


class Recorder:
    """A grounder that predicts Thing and records the views it gets."""

    name = "recorder"
    is_calibrated = True

    def __init__(self) -> None:
        self.seen: list[tuple[str, ObjectView]] = []

    @property
    def settings(self) -> Mapping[str, str]:
        return {"depth": "7"}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        self.seen.extend(views)
        # A grounder may return another order than it was given.
        return [
            Prediction(path, LAB + "Thing", 0.5, Status.GROUNDED, self.name, view.name)
            for path, view in reversed(views)
        ]


def paths_of(predictions: Sequence[Prediction]) -> list[str]:
    return [p.prim_path for p in predictions]


SCENE = scene_of("/Room/Cup", "/Room/Lamp", "/Room/Oven")


def test_all_objects_in_scene_order():
    grounding = ground(SCENE, TBOX, Recorder())
    assert paths_of(grounding.predictions) == ["/Room/Cup", "/Room/Lamp", "/Room/Oven"]
    assert [p.explanation for p in grounding.predictions] == ["Cup", "Lamp", "Oven"]


def test_requested_paths_are_grounded_in_their_order():
    recorder = Recorder()
    grounding = ground(SCENE, TBOX, recorder, paths=["/Room/Oven", "/Room/Cup"])
    assert paths_of(grounding.predictions) == ["/Room/Oven", "/Room/Cup"]
    assert [path for path, _ in recorder.seen] == ["/Room/Oven", "/Room/Cup"]
    # The other objects remain context.
    assert list(recorder.seen[1][1].siblings) == ["Lamp", "Oven"]


def test_a_repeated_path_is_grounded_once():
    grounding = ground(SCENE, TBOX, Recorder(), paths=["/Room/Cup", "/Room/Lamp", "/Room/Cup"])
    assert paths_of(grounding.predictions) == ["/Room/Cup", "/Room/Lamp"]


def test_an_unknown_path_is_missing_and_not_grounded():
    recorder = Recorder()
    grounding = ground(SCENE, TBOX, recorder, paths=["/Room/Ghost", "/Room/Cup"])
    ghost, cup = grounding.predictions
    assert (ghost.prim_path, ghost.status, ghost.class_iri, ghost.confidence) == (
        "/Room/Ghost",
        Status.MISSING,
        None,
        None,
    )
    assert "no such prim" in ghost.explanation
    assert cup.status is Status.GROUNDED
    assert [path for path, _ in recorder.seen] == ["/Room/Cup"]


def test_no_requested_path_gives_no_prediction():
    assert ground(SCENE, TBOX, Recorder(), paths=[]).predictions == ()


def test_the_run_is_recorded():
    grounding = ground(SCENE, TBOX, Recorder(), regime=NamingRegime.OPAQUE, evidence=frozenset({"position", "name"}))
    assert (grounding.scene, grounding.scene_hash) == ("room.usda", "sha256:5ce7e")
    assert (grounding.ontology, grounding.ontology_hash) == ("https://lab.example/onto", "sha256:7b0c5")
    assert (grounding.grounder, grounding.is_calibrated) == ("recorder", True)
    assert grounding.tool_version == version("usd2kg")
    assert grounding.settings == {"regime": "opaque", "evidence": "name,position", "depth": "7"}


def test_all_evidence_is_recorded_by_name():
    assert ground(SCENE, TBOX, Recorder()).settings["evidence"] == ",".join(sorted(EVIDENCE_GROUPS))


def test_predictions_are_found_by_path():
    grounding = ground(SCENE, TBOX, Recorder())
    assert grounding.by_path["/Room/Lamp"] is grounding.predictions[1]
    assert "/Room" not in grounding.by_path


def test_only_the_allowed_evidence_is_shown():
    box = Box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    cup = make_object("/Room/Cup", box=box, mass_kg=0.2, position=(1.0, 1.0, 1.0), asset=("mug_v1",), parts=("Handle",))
    recorder = Recorder()
    ground(make_scene(cup), TBOX, recorder, evidence=frozenset({"geometry"}))
    ((_, view),) = recorder.seen
    assert (view.size, view.mass_kg) == ((1.0, 2.0, 3.0), 0.2)
    assert (view.name, view.position, view.asset, view.parts, view.parents) == ("", None, (), (), ())


@pytest.mark.parametrize("regime", ["semantic", "abbreviated", "opaque", "opaque-anonymous"])
def test_regimes_by_name(regime: str):
    assert parse_regime(regime).value == regime


@pytest.mark.parametrize("text", ["", "Opaque", "opaque_anonymous", "none"])
def test_rejects_an_unknown_regime_and_lists_the_known_ones(text: str):
    with pytest.raises(GroundingError) as error:
        parse_regime(text)
    assert str(error.value) == (
        f"regime {text!r} is unknown; expected one of semantic, abbreviated, opaque, opaque-anonymous"
    )


@pytest.mark.parametrize(
    ("text", "groups"),
    [("name", {"name"}), ("name, geometry", {"name", "geometry"}), (",parts,,parts,", {"parts"})],
)
def test_evidence_by_name(text: str, groups: set[str]):
    assert parse_evidence(text) == groups


def test_every_evidence_group_can_be_named():
    assert parse_evidence(",".join(EVIDENCE_GROUPS)) == EVIDENCE_GROUPS


@pytest.mark.parametrize(
    ("text", "found"),
    [("", "no group is named"), (" , ", "no group is named"), ("name,colour", "'colour'"), ("Name", "'Name'")],
)
def test_rejects_unknown_evidence_and_lists_the_known_groups(text: str, found: str):
    with pytest.raises(GroundingError) as error:
        parse_evidence(text)
    assert found in str(error.value)
    assert "a list of asset, geometry, hierarchy, labels, materials, name, neighbours, parts, position" in str(
        error.value
    )
