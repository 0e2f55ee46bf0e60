"""Data frames of a build result, in pandas and Polars."""

import math
import sys
from typing import Any

import pytest

from tests.grounding.records import make_object, make_scene
from usd2kg import BuildResult, build, to_tables
from usd2kg.errors import GraphError
from usd2kg.scene import Box, Joint

TABLE = Box((0, 0, 0), (1.6, 0.8, 0.7))
CUP = Box((0.5, 0.3, 0.7), (0.6, 0.4, 0.8))
HINGE = Joint(
    prim_path="/Room/Table/hinge",
    type="revolute",
    body0=None,
    body1="/Room/Table",
    axis="X",
    axis_vector=None,
    origin=None,
    direction=None,
    lower=-1.5,
    upper=None,
    value=None,
    is_enabled=True,
    is_excluded_from_articulation=False,
)


@pytest.fixture(scope="module")
def result() -> BuildResult:
    """A cup on a table, and an object without geometry."""
    return build(
        make_scene(
            make_object("/Room/Table", box=TABLE, own_box=TABLE, mass_kg=20.0, orientation=(0.0, 0.0, 0.0, 1.0)),
            make_object("/Room/Cup", box=CUP, own_box=CUP, position=(0.55, 0.35, 0.7)),
            make_object("/Room/Fork", parent_path="/Room/Table"),
            joints=(HINGE,),
        )
    )


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_objects_have_one_row_each(result: BuildResult, library: Any):
    objects = to_tables(result, library).objects
    assert list(objects["path"]) == ["/Room/Table", "/Room/Cup", "/Room/Fork"]
    assert list(objects["class_name"]) == ["Table", "Cup", "Fork"]
    assert list(objects["iri"])[1] == "https://example.org/room/Room.Cup"
    assert [objects[f"size_{axis}"][1] for axis in "xyz"] == pytest.approx([0.1, 0.1, 0.1])
    assert [objects[f"center_{axis}"][0] for axis in "xyz"] == pytest.approx([0.8, 0.4, 0.35])
    assert [objects[f"position_{axis}"][1] for axis in "xyz"] == pytest.approx([0.55, 0.35, 0.7])
    assert [objects[f"q{axis}"][0] for axis in "xyzw"] == [0, 0, 0, 1]
    assert objects["mass_kg"][0] == 20
    assert list(objects["concept"]) == ["table", "cup", "fork"]
    assert list(objects["concept_iri"]) == [p.concept for p in result.grounding.predictions]
    assert list(objects["concept_confidence"]) == [p.concept_confidence for p in result.grounding.predictions]
    assert list(objects["confidence"]) == [p.confidence for p in result.grounding.predictions]


def test_unknown_values_are_nan_in_pandas_and_null_in_polars(result: BuildResult):
    assert math.isnan(to_tables(result).objects["size_x"][2])
    assert to_tables(result).objects["parent"].isna().tolist() == [True, True, False]
    assert to_tables(result, "polars").objects["size_x"].to_list()[2] is None


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_relations_have_one_row_each_with_measurements(result: BuildResult, library: Any):
    relations = to_tables(result, library).relations
    rows = list(zip(relations["kind"], relations["target"], relations["anchor"], strict=True))
    assert rows == [(r.kind, r.target, r.anchor) for r in result.graph.relations]
    at = rows.index(("on", "/Room/Cup", "/Room/Table"))
    for name, number in result.graph.relations[at].numbers.items():
        assert relations[name][at] == pytest.approx(number)


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_candidates_are_ranked_and_joints_have_limits(result: BuildResult, library: Any):
    _, _, candidates, joints = to_tables(result, library)
    first = [name for name, rank in zip(candidates["class_name"], candidates["rank"], strict=True) if rank == 1]
    assert first == ["Table", "Cup", "Fork"]
    assert (joints["path"][0], joints["lower"][0]) == ("/Room/Table/hinge", -1.5)


def test_empty_tables_keep_their_columns():
    tables = to_tables(build(make_scene(make_object("/Cup"))))
    assert list(tables.joints.columns)[:2] == ["path", "type"]
    assert len(tables.joints) == 0


def test_rejects_an_unknown_library(result: BuildResult):
    with pytest.raises(GraphError, match="expected pandas or polars"):
        to_tables(result, "numpy")  # type: ignore[arg-type]


@pytest.mark.parametrize(("library", "install"), [("pandas", r"usd2kg\[tables\]"), ("polars", "polars")])
def test_names_the_install_command_of_a_missing_library(
    result: BuildResult, library: Any, install: str, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(GraphError, match=f"run: pip install '{install}'"):
        to_tables(result, library)
