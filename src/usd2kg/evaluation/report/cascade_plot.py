"""The plot of cascades: accuracy against dollars."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from usd2kg.evaluation.report.analysis import group_cascades, group_repeats
from usd2kg.evaluation.report.blocks import Figure
from usd2kg.evaluation.report.canvas import add_legend, label_text, method_color, method_marker, open_canvas, to_figure
from usd2kg.evaluation.run_matrix import CellResult, SceneResult
from usd2kg.evaluation.summary import Summary

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_cascades"]

_PER_OBJECTS = 1000
_FIRST_TIER = "lexical"
_LABEL_GAP = 0.08
"""Fraction of the largest cost within which points share a label."""
_BELOW = 5
"""Distance of a label from the interval above it, in points."""


class _Point(NamedTuple):
    dollars: float
    """US dollars for `_PER_OBJECTS` objects."""
    summary: Summary
    text: str


def plot_cascades(result: SceneResult, file: str) -> Figure | None:
    """Return EMA by dollars at the thresholds of each cascade; None if none was run or no price is known.

    A line starts at the lexical grounder alone and ends where the model is asked about all objects, if these were run.
    """
    runs = group_repeats(result)
    lines = {key: _line(*key, cells, runs) for key, cells in group_cascades(result).items()}
    lines = {key: points for key, points in lines.items() if points}
    if not lines:
        return None
    models = list(dict.fromkeys(model for model, _ in lines))
    conditions = list(dict.fromkeys(condition for _, condition in lines))
    most = max(point.dollars for points in lines.values() for point in points)
    with open_canvas(max(5.0, 3.2 * len(conditions)), 3.8, (1, len(conditions))) as (canvas, panels):
        for (model, condition), points in lines.items():
            index = models.index(model)
            _draw_line(panels[conditions.index(condition)], points, index, model, most)
        for axes, condition in zip(panels, conditions, strict=True):
            axes.set(title=condition, ylim=(0, 108), xlim=(-0.05 * (most or 1), 1.12 * (most or 1)))
            axes.set_xlabel(f"US dollars for {_PER_OBJECTS:,} objects")
        panels[0].set_ylabel("EMA, %")
        add_legend(canvas, *panels)
        caption = (
            f"{result.spec.name}: exact match by cost of cascades of the lexical grounder and a language model. "
            "Numbers are thresholds: the model is asked about objects below this confidence. Lines are 95 % intervals "
            "by distinct name."
        )
        return to_figure(canvas, file, caption)


def _line(
    model: str,
    condition: str,
    cells: Sequence[CellResult],
    runs: Mapping[tuple[str, str], Sequence[CellResult]],
) -> list[_Point]:
    """Return the points of one line by threshold, without results that lack answers or a price."""
    points = []
    if alone := runs.get((_FIRST_TIER, condition)):
        points.append(_Point(0.0, alone[0].evaluation.summary, "none"))
    priced = [(done, _dollars(done)) for done in (*cells, *runs.get((model, condition), ())[:1])]
    points += [
        _Point(dollars, done.evaluation.summary, "all" if done.cell.cascade is None else f"{done.cell.cascade:g}")
        for done, dollars in priced
        if dollars is not None and not done.failures
    ]
    return points if any(dollars is not None for _, dollars in priced) else []


def _dollars(done: CellResult) -> float | None:
    if done.cost is None or done.cost.dollars is None:
        return None
    return float(done.cost.dollars) * _PER_OBJECTS / done.evaluation.summary.n


def _draw_line(axes: "Axes", points: Sequence[_Point], index: int, model: str, most: float) -> None:
    x, y = [point.dollars for point in points], [point.summary.ema for point in points]
    lower = [max(0.0, p.summary.ema - p.summary.ema_name_interval.lower) for p in points]
    upper = [max(0.0, p.summary.ema_name_interval.upper - p.summary.ema) for p in points]
    color = method_color(index)
    axes.errorbar(x, y, yerr=[lower, upper], fmt="none", ecolor=color, elinewidth=1, capsize=3, alpha=0.5)
    name = label_text(model.partition("@http")[0])
    axes.plot(x, y, color=color, marker=method_marker(index), markersize=5, linewidth=1.4, label=name)
    for near in _group_near(points, _LABEL_GAP * most):
        text = near[0].text if len(near) == 1 else f"{near[0].text} to {near[-1].text}"
        lowest = min(point.summary.ema_name_interval.lower for point in near)
        place = ((near[0].dollars + near[-1].dollars) / 2, lowest)
        # Rotated, since adjacent labels would overlap.
        axes.annotate(
            text,
            place,
            (0, -_BELOW),
            textcoords="offset points",
            rotation=90,
            ha="center",
            va="top",
            size=8,
            color=color,
        )


def _group_near(points: Sequence[_Point], gap: float) -> list[list[_Point]]:
    """Return successive points in groups that share a label; the points of a group are at most `gap` apart."""
    groups: list[list[_Point]] = []
    for point in points:
        if groups and point.dollars - groups[-1][0].dollars <= gap:
            groups[-1].append(point)
        else:
            groups.append([point])
    return groups
