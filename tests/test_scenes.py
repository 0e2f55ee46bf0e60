"""Layouts of the authored scenes; tests/end_to_end compares the written scenes with the committed files."""

from pathlib import Path
from types import ModuleType

import pytest

from scenes.writer.assets import Asset, asset
from scenes.writer.layout import GAP, AuthoredScene, Layout, collect_assets
from scenes.writer.palette import ShaderStyle
from scenes.writer.shapes import box


@pytest.fixture
def layout() -> Layout:
    module = ModuleType("assets")

    @asset()
    def table(a: Asset) -> None:
        a.add("top", box((-50, 0, -50), (50, 70, 50)), "oak")
        a.surfaces["shelf"] = 20.0

    @asset()
    def ball(a: Asset) -> None:
        a.add("body", box((-5, -5, -5), (5, 5, 5)), "oak")

    vars(module).update(table=table, ball=ball)
    spec = AuthoredScene("/Room", Path(), (module,), {}, ShaderStyle("shader"), "a room")
    return Layout(spec, collect_assets(spec.modules))


def row(path: str, asset_key: str, at: str, **cells: str) -> dict[str, str]:
    empty = dict.fromkeys(("turn", "on", "inside", "mass", "options", "display", "doc"), "")
    return {"path": path, "asset": asset_key, "at": at, **empty, **cells}


@pytest.mark.parametrize(("on", "height"), [("Table_1", 75), ("Table_1#shelf", 25), ("30", 35), ("", 5)])
def test_an_object_rests_on_its_support_a_height_or_the_ground(layout: Layout, on: str, height: float):
    layout.add(row("Table_1", "table", "100 0 0"))
    layout.add(row("Ball_1", "ball", "100 10", on=on))
    assert layout.placed["/Room/Ball_1"].position == pytest.approx((100, 10, height + GAP))


def test_relations_name_supports_and_containers_but_not_heights(layout: Layout):
    layout.add(row("Table_1", "table", "0 0 0"))
    layout.add(row("Ball_1", "ball", "0 0", on="Table_1#shelf"))
    layout.add(row("Ball_2", "ball", "0 0", on="30"))
    assert layout.relations == [("/Room/Ball_1", "on", "/Room/Table_1")]


def test_rejects_a_path_that_is_taken(layout: Layout):
    layout.add(row("Ball_1", "ball", "0 0"))
    with pytest.raises(ValueError, match="/Room/Ball_1 is placed twice"):
        layout.add(row("Ball_1", "ball", "20 0"))
