"""The plots of accuracy, ablation, confidence and cost."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from usd2kg.evaluation.matrix import OWN_ABLATION, STUDY_ABLATION
from usd2kg.evaluation.metrics.calibration import ReliabilityBin, reliability_bins, risk_coverage_curve
from usd2kg.evaluation.report.analysis import REGIMES, group_repeats, list_methods, scores_by_method
from usd2kg.evaluation.report.blocks import Figure
from usd2kg.evaluation.report.canvas import (
    add_legend,
    label_text,
    method_color,
    method_marker,
    open_canvas,
    to_figure,
)
from usd2kg.evaluation.report.cell_text import significant_digits
from usd2kg.evaluation.report.published import AS_PUBLISHED, published_ablation, published_main
from usd2kg.evaluation.run_matrix import CellResult, SceneResult
from usd2kg.grounding import NamingRegime

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_ablation", "plot_accuracy", "plot_cost", "plot_reliability", "plot_risk_coverage"]

_SEMANTIC = NamingRegime.SEMANTIC.value
_DARK = "#333333"
_GREY = "#888888"
_BARS_WIDTH = 0.8
"""Width of a group of bars; 1 is the distance between groups."""


def plot_accuracy(result: SceneResult, file: str) -> Figure:
    """Return bars of EMA by naming regime, with 95 % intervals by distinct name, and ticks of the published results."""
    runs, methods = group_repeats(result), list_methods(result)
    with open_canvas(8, 3.6) as (canvas, [axes]):
        for index, method in enumerate(methods):
            shown = [(x, runs[method, regime]) for x, regime in enumerate(REGIMES) if (method, regime) in runs]
            if shown:
                _vertical_bars(axes, [x for x, _ in shown], [done for _, done in shown], index, len(methods), method)
        best = _published_ticks(axes)
        axes.set_xlim(-0.6, len(REGIMES) - 0.4)
        axes.set_xticks(range(len(REGIMES)), REGIMES)
        axes.grid(visible=False, axis="x")
        axes.set(ylim=(0, 100), ylabel="EMA, %")
        add_legend(canvas, axes)
        caption = (
            f"{result.spec.name}: exact match by naming regime; lines are 95 % intervals by distinct name. Grey ticks "
            f"are the methods of the study, {AS_PUBLISHED}; the best: {best}."
        )
        return to_figure(canvas, file, caption)


def _published_ticks(axes: "Axes") -> str:
    """Draw the published results of all methods right of each group of bars, and return the best of each regime."""
    best: list[str] = []
    for place, regime in enumerate(REGIMES):
        results = ((method, done.get(regime)) for method, done in published_main().items())
        found = {method: one.ema for method, one in results if one is not None and one.ema is not None}
        if not found:
            continue
        label = None if best else "published, Kitchen Set"
        places = [place + _BARS_WIDTH / 2 + 0.05] * len(found)
        axes.scatter(places, list(found.values()), 90, color=_GREY, marker="_", label=label)
        method = max(found, key=lambda name: (found[name], name))
        best.append(f"{found[method]:.0f} % {method}, {regime}")
    return "; ".join(best)


def _bar_centers(places: Sequence[int], index: int, total: int) -> list[float]:
    """Return the centres of the bars of one method, whose groups are at `places`."""
    return [place + (index - (total - 1) / 2) * _BARS_WIDTH / total for place in places]


def _vertical_bars(
    axes: "Axes", places: list[int], repeats: list[tuple[CellResult, ...]], index: int, total: int, method: str
) -> None:
    summaries = [done[0].evaluation.summary for done in repeats]
    heights = [_mean_ema(done) for done in repeats]
    lower = [max(0.0, h - s.ema_name_interval.lower) for h, s in zip(heights, summaries, strict=True)]
    upper = [max(0.0, s.ema_name_interval.upper - h) for h, s in zip(heights, summaries, strict=True)]
    centers = _bar_centers(places, index, total)
    axes.bar(centers, heights, 0.94 * _BARS_WIDTH / total, color=method_color(index), label=label_text(method))
    axes.errorbar(centers, heights, yerr=[lower, upper], fmt="none", ecolor=_DARK, elinewidth=1, capsize=3)
    for x, height, up in zip(centers, heights, upper, strict=True):
        axes.annotate(f"{height:.0f}", (x, height + up), (0, 2), textcoords="offset points", ha="center", fontsize=9)


def _mean_ema(repeats: Sequence[CellResult]) -> float:
    return sum(done.evaluation.summary.ema for done in repeats) / len(repeats)


def plot_ablation(result: SceneResult, file: str) -> Figure | None:
    """Return bars of EMA by condition, with one panel each for `STUDY_ABLATION` and `OWN_ABLATION`.

    None if no ablation was run.
    """
    runs, methods = group_repeats(result), list_methods(result)
    kinds = [("the study's conditions, opaque names", STUDY_ABLATION), ("our conditions, authored names", OWN_ABLATION)]
    run = {condition for _, condition in runs}
    kinds = [(title, conditions) for title, conditions in kinds if not run.isdisjoint(conditions)]
    if not kinds:
        return None
    height = 1.2 + 0.14 * len(STUDY_ABLATION) * (1 + len(methods))
    with open_canvas(10, height, (1, len(kinds))) as (canvas, panels):
        for axes, (title, conditions) in zip(panels, kinds, strict=True):
            names = [name for name in conditions if name in run]
            for index, method in enumerate(methods):
                shown = [(y, _mean_ema(runs[method, name])) for y, name in enumerate(names) if (method, name) in runs]
                _horizontal_bars(axes, shown, index, len(methods), method)
            if conditions is STUDY_ABLATION:
                _published_ablation_ticks(axes, names)
            axes.set_yticks(range(len(names)), names)
            axes.invert_yaxis()
            axes.grid(visible=False, axis="y")
            axes.set(xlim=(0, 108), xlabel="EMA, %", title=title)
        add_legend(canvas, *panels)
        shown_ticks = f"Grey ticks are the study's methods, {AS_PUBLISHED}."
        caption = f"{result.spec.name}: exact match by available evidence. {shown_ticks}"
        return to_figure(canvas, file, caption)


def _published_ablation_ticks(axes: "Axes", conditions: Sequence[str]) -> None:
    """Draw the published results of all methods below the bars of each condition."""
    places = {condition: y + _BARS_WIDTH / 2 + 0.05 for y, condition in enumerate(conditions)}
    found = [
        (one.ema, places[condition])
        for done in published_ablation().values()
        for condition, one in done.items()
        if one.ema is not None and condition in places
    ]
    if found:
        x, y = zip(*found, strict=True)
        axes.scatter(x, y, 60, color=_GREY, marker="|", label="published, Kitchen Set")


def _horizontal_bars(axes: "Axes", shown: Sequence[tuple[int, float]], index: int, total: int, method: str) -> None:
    if not shown:
        return
    centers = _bar_centers([y for y, _ in shown], index, total)
    values = [value for _, value in shown]
    axes.barh(centers, values, 0.94 * _BARS_WIDTH / total, color=method_color(index), label=label_text(method))
    for y, value in zip(centers, values, strict=True):
        axes.annotate(f"{value:.0f}", (value, y), (3, 0), textcoords="offset points", va="center", size=9)


def plot_reliability(result: SceneResult, file: str) -> Figure | None:
    """Return a reliability diagram under authored names; None if no answer has a confidence."""
    bins = {method: reliability_bins(scores) for method, scores in scores_by_method(result, _SEMANTIC).items()}
    if not any(bins.values()):
        return None
    with open_canvas(5.6, 5.2) as (canvas, [axes]):
        axes.plot([0, 1], [0, 1], color="#999999", linewidth=1, linestyle="--", label="perfectly calibrated")
        for index, (method, filled) in enumerate(bins.items()):
            _reliability_line(axes, filled, method, index)
        axes.set(xlim=(0, 1.04), ylim=(-0.06, 1.06), xlabel="confidence", ylabel="accuracy")
        add_legend(canvas, axes)
        caption = f"{result.spec.name}: accuracy by confidence. Numbers and areas of the markers count answers."
        return to_figure(canvas, file, caption)


def _reliability_line(axes: "Axes", filled: Sequence[ReliabilityBin], method: str, index: int) -> None:
    x, y = [b.confidence for b in filled], [b.accuracy for b in filled]
    color, marker = method_color(index), method_marker(index)
    axes.plot(x, y, color=color, marker=marker, markersize=4, linewidth=1, label=label_text(method), zorder=3)
    total = sum(b.count for b in filled)
    for b in filled:
        area = 20 + 500 * b.count / total
        axes.scatter([b.confidence], [b.accuracy], area, color=color, alpha=0.3, linewidth=0, marker=marker)
        below = (0, -math.sqrt(area) / 2 - 10)
        axes.annotate(str(b.count), (b.confidence, b.accuracy), below, textcoords="offset points", ha="center", size=8)


def plot_risk_coverage(result: SceneResult, file: str) -> Figure | None:
    """Return risk-coverage curves under authored names; None if no answer has a confidence."""
    curves = {method: risk_coverage_curve(scores) for method, scores in scores_by_method(result, _SEMANTIC).items()}
    if not any(curves.values()):
        return None
    with open_canvas(7, 3.8) as (canvas, [axes]):
        for index, (method, curve) in enumerate(curves.items()):
            x, y = [100 * coverage for coverage, _ in curve], [100 * risk for _, risk in curve]
            color, marker = method_color(index), method_marker(index)
            axes.plot(x, y, marker=marker, markersize=4, color=color, label=label_text(method))
        axes.set(xlim=(0, 102), xlabel="coverage: answered objects, most confident first, %", ylabel="wrong answers, %")
        highest = max(risk for curve in curves.values() for _, risk in curve)
        axes.set_ylim(0, max(5.0, 110 * highest))
        add_legend(canvas, axes)
        return to_figure(canvas, file, f"{result.spec.name}: wrong answers by coverage, authored names.")


def plot_cost(results: Sequence[SceneResult], file: str) -> Figure | None:
    """Return EMA by seconds per object, with a point for each scene and method; None if no times are known."""
    timed = [
        (result.spec.name, method, done)
        for result in results
        for (method, condition), done in group_repeats(result).items()
        if condition == _SEMANTIC and done[0].evaluation.seconds > 0
    ]
    if not timed:
        return None
    methods = list(dict.fromkeys(method for _, method, _ in timed))
    scenes = list(dict.fromkeys(scene for scene, _, _ in timed))
    with open_canvas(7.4, 4) as (canvas, [axes]):
        each = [sum(d.evaluation.seconds / d.evaluation.summary.n for d in done) / len(done) for _, _, done in timed]
        for (scene, method, done), seconds in zip(timed, each, strict=True):
            marker, color = method_marker(scenes.index(scene)), method_color(methods.index(method))
            axes.scatter([seconds], [_mean_ema(done)], 70, color=color, marker=marker, alpha=0.8)
        for index, method in enumerate(methods):
            axes.scatter([], [], 70, color=method_color(index), marker="o", label=label_text(method))
        for index, name in enumerate(scenes):
            marker = method_marker(index)
            axes.scatter([], [], 70, facecolor="none", edgecolor=_DARK, marker=marker, label=label_text(name))
        axes.set_xscale("log")
        # The default labels (10^-3) are formulas. Whole decades guarantee a labelled tick.
        axes.xaxis.set_major_formatter(lambda seconds, _: significant_digits(seconds))
        axes.xaxis.set_minor_formatter("")
        axes.set_xlim(10 ** math.floor(math.log10(min(each)) - 0.1), 10 ** math.ceil(math.log10(max(each)) + 0.1))
        axes.set(xlabel="seconds per object", ylabel="EMA, %", ylim=(-4, 104))
        canvas.legend(*axes.get_legend_handles_labels(), loc="outside right upper")
        return to_figure(canvas, file, "Accuracy by cost, authored names: colours are methods, shapes are scenes.")
