"""The accuracy tables of README and docs have the figures that `make accuracy` kept."""

import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
KEPT = json.loads((ROOT / "benchmarks/accuracy/results.json").read_text("utf-8"))
REGIMES = ("semantic", "abbreviated", "opaque", "opaque-anonymous")
NAMES = {
    "flat (test)": "Flat (test)",
    "flat (test, never tuned on)": "Flat (test)",
    "AWS small house, an ontology of 1,877 classes": "AWS small house, SOMA+DFL",
    "demo kitchen": "Demo kitchen",
    "office": "Office",
    "warehouse": "Warehouse",
}
"""Scene in a table → scene in the kept figures, where they differ."""
_CELL = re.compile(r"\**(\d+) \((\d+)\)\**")


def rows(page: str) -> dict[str, list[tuple[int, ...]]]:
    """Return the scene of each row → the (exact, accepted) percentages of its cells, but for MiniLM's."""
    found = {}
    for line in (ROOT / page).read_text("utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        scene = cells[0].strip("*")
        if NAMES.get(scene, scene) in KEPT:
            figures = [match for cell in cells[2:] if (match := _CELL.fullmatch(cell))]
            found[scene] = [tuple(map(int, figure.groups())) for figure in figures[: len(REGIMES)]]
    return found


@pytest.mark.parametrize("page, count", [("README.md", 5), ("docs/accuracy.md", 9)])
def test_the_tables_have_the_kept_figures(page: str, count: int):
    found = rows(page)
    assert len(found) == count
    for scene, figures in found.items():
        cells = KEPT[NAMES.get(scene, scene)]["grounders"]["lexical"]
        kept = [(cells[regime]["ema"], cells[regime]["ema_also"]) for regime in REGIMES[: len(figures)]]
        assert figures == [tuple(round(value) for value in pair) for pair in kept], scene
