"""The plots of a report, as SVG. Matplotlib is needed only here, and loaded only when a plot is drawn."""

import io
import math
import warnings
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import cycle
from typing import TYPE_CHECKING, Any

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.matrix import OWN_ABLATION, STUDY_ABLATION
from usd2kg.evaluation.metrics.calibration import ReliabilityBin, reliability, risk_coverage
from usd2kg.evaluation.report.analysis import REGIMES, hierarchy_order, methods_of, runs_of, scores_under
from usd2kg.evaluation.report.document import Figure, class_text, plain_number, printable
from usd2kg.evaluation.reproduce import CellResult, SceneResult
from usd2kg.evaluation.sample import Score
from usd2kg.grounding import NamingRegime
from usd2kg.ontology import ClassIRI

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas

__all__ = [
    "check_matplotlib",
    "plot_ablation",
    "plot_accuracy",
    "plot_confusion",
    "plot_cost",
    "plot_reliability",
    "plot_risk_coverage",
]

_SEMANTIC = NamingRegime.SEMANTIC.value
_COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#7F7F7F", "#000000")
"""Okabe and Ito's colours, which people with any colour vision tell apart; in the order of the methods."""
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
_MOST_CLASSES = 45
"""More classes than this make a heat map unreadable; those without any confusion are then left out."""
_SETTINGS: Mapping[Any, Any] = {
    "svg.hashsalt": "usd2kg",
    # Text stays text: sharp, searchable, and drawn by the reader's fonts where ours lacks a script.
    "svg.fonttype": "none",
    # A name may hold a dollar sign, which would start a formula.
    "text.parse_math": False,
    "font.family": ["DejaVu Sans", "sans-serif"],
    "font.size": 11,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e3e3e3",
    "legend.frameon": False,
    "axes.titlesize": 11,
    "axes.titlelocation": "left",
}


def check_matplotlib() -> None:
    """Raise EvaluationError, with the command that mends it, if matplotlib is not installed."""
    try:
        import matplotlib.figure  # noqa: F401, PLC0415
    except ImportError as error:
        raise EvaluationError(
            f"plots need matplotlib, which cannot be imported ({error}); pip install 'usd2kg[plots]'"
        ) from error


@contextmanager
def _drawing(width: float, height: float, panels: tuple[int, int] = (1, 1)) -> Iterator[tuple["Canvas", list["Axes"]]]:
    """Yield a canvas of so many inches and its panels, with our settings and not the user's."""
    check_matplotlib()
    import matplotlib as mpl  # noqa: PLC0415
    from matplotlib.figure import Figure as Canvas  # noqa: PLC0415

    with mpl.rc_context(), warnings.catch_warnings():
        mpl.rcdefaults()
        mpl.rcParams.update(_SETTINGS)
        # A script that the font lacks is drawn by the reader's fonts; matplotlib only cannot measure it.
        warnings.filterwarnings("ignore", message="Glyph .* missing from", category=UserWarning)
        canvas = Canvas(figsize=(width, height), layout="constrained")
        yield canvas, list(canvas.subplots(*panels, squeeze=False).flat)


def _figure(canvas: "Canvas", file: str, caption: str) -> Figure:
    text = io.StringIO()
    canvas.savefig(text, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    svg = text.getvalue()
    return Figure(file, printable(caption), svg[svg.index("<svg") :].strip())


def _label(text: str, longest: int = 40) -> str:
    # A leading underscore would hide the label from the legend.
    text = " " + printable(text) if text.startswith("_") else printable(text)
    return text if len(text) <= longest else text[: longest - 1] + "…"


def _legend(canvas: "Canvas", *panels: "Axes") -> None:
    entries = [zip(*axes.get_legend_handles_labels(), strict=True) for axes in panels]
    by_label = {label: handle for panel in entries for handle, label in panel}
    canvas.legend([*by_label.values()], [*by_label], loc="outside upper left", ncols=4)


def plot_accuracy(result: SceneResult, file: str) -> Figure:
    """Return bars of EMA by regime, with 95 % intervals by distinct name."""
    runs, methods = runs_of(result), methods_of(result)
    with _drawing(8, 3.6) as (canvas, [axes]):
        for index, method in enumerate(methods):
            shown = [(x, runs[method, regime]) for x, regime in enumerate(REGIMES) if (method, regime) in runs]
            if shown:
                _bars(axes, [x for x, _ in shown], [done for _, done in shown], index, len(methods), method)
        axes.set_xticks(range(len(REGIMES)), REGIMES)
        axes.grid(visible=False, axis="x")
        axes.set(ylim=(0, 100), ylabel="EMA, %")
        _legend(canvas, axes)
        caption = f"{result.spec.name}: exact match by naming regime; lines are 95 % intervals by distinct name."
        return _figure(canvas, file, caption)


def _bars(
    axes: "Axes", places: list[int], repeats: list[tuple[CellResult, ...]], index: int, total: int, method: str
) -> None:
    width = 0.8 / total
    summaries = [done[0].evaluation.summary for done in repeats]
    heights = [_mean_ema(done) for done in repeats]
    lower = [max(0.0, h - s.ema_name_interval.lower) for h, s in zip(heights, summaries, strict=True)]
    upper = [max(0.0, s.ema_name_interval.upper - h) for h, s in zip(heights, summaries, strict=True)]
    middles = [place + (index - (total - 1) / 2) * width for place in places]
    axes.bar(middles, heights, width * 0.94, color=_COLOURS[index % len(_COLOURS)], label=_label(method))
    axes.errorbar(middles, heights, yerr=[lower, upper], fmt="none", ecolor="#333333", elinewidth=1, capsize=3)
    for x, height, up in zip(middles, heights, upper, strict=True):
        axes.annotate(f"{height:.0f}", (x, height + up), (0, 2), textcoords="offset points", ha="center", fontsize=9)


def _mean_ema(repeats: Sequence[CellResult]) -> float:
    return sum(done.evaluation.summary.ema for done in repeats) / len(repeats)


def plot_ablation(result: SceneResult, file: str) -> Figure | None:
    """Return bars of EMA by condition, the study's and ours apart; None if no ablation was run."""
    runs, methods = runs_of(result), methods_of(result)
    kinds = [("the study's conditions, opaque names", STUDY_ABLATION), ("our conditions, authored names", OWN_ABLATION)]
    run = {condition for _, condition in runs}
    kinds = [(title, conditions) for title, conditions in kinds if not run.isdisjoint(conditions)]
    if not kinds:
        return None
    with _drawing(10, 1.2 + 0.14 * 6 * (1 + len(methods)), (1, len(kinds))) as (canvas, panels):
        for axes, (title, conditions) in zip(panels, kinds, strict=True):
            names = [name for name in conditions if name in run]
            for index, method in enumerate(methods):
                shown = [(y, _mean_ema(runs[method, name])) for y, name in enumerate(names) if (method, name) in runs]
                _lying_bars(axes, shown, index, len(methods), method)
            axes.set_yticks(range(len(names)), names)
            axes.invert_yaxis()
            axes.grid(visible=False, axis="y")
            axes.set(xlim=(0, 108), xlabel="EMA, %", title=title)
        _legend(canvas, *panels)
        return _figure(canvas, file, f"{result.spec.name}: exact match by the evidence that may be used.")


def _lying_bars(axes: "Axes", shown: Sequence[tuple[int, float]], index: int, total: int, method: str) -> None:
    if not shown:
        return
    places = [y + (index - (total - 1) / 2) * 0.8 / total for y, _ in shown]
    values = [value for _, value in shown]
    axes.barh(places, values, 0.75 / total, color=_COLOURS[index % 8], label=_label(method))
    for y, value in zip(places, values, strict=True):
        axes.annotate(f"{value:.0f}", (value, y), (3, 0), textcoords="offset points", va="center", size=9)


def plot_reliability(result: SceneResult, file: str) -> Figure | None:
    """Return accuracy against confidence under authored names; None if no answer has a confidence."""
    bins = {method: reliability(scores) for method, scores in scores_under(result, _SEMANTIC).items()}
    if not any(bins.values()):
        return None
    with _drawing(5.6, 5.2) as (canvas, [axes]):
        axes.plot([0, 1], [0, 1], color="#999999", linewidth=1, linestyle="--", label="well calibrated")
        for index, (method, filled) in enumerate(bins.items()):
            _bins(axes, filled, method, index)
        axes.set(xlim=(0, 1.04), ylim=(-0.06, 1.06), xlabel="confidence", ylabel="share that is right")
        _legend(canvas, axes)
        caption = f"{result.spec.name}: is a confidence the probability of being right? Numbers count answers."
        return _figure(canvas, file, caption)


def _bins(axes: "Axes", filled: Sequence[ReliabilityBin], method: str, index: int) -> None:
    x, y = [b.confidence for b in filled], [b.accuracy for b in filled]
    colour = _COLOURS[index % 8]
    marker = _MARKERS[index % 8]
    axes.plot(x, y, color=colour, marker=marker, markersize=4, linewidth=1, label=_label(method), zorder=3)
    total = sum(b.count for b in filled)
    for b in filled:
        # The area tells how many answers a point stands for.
        area = 20 + 500 * b.count / total
        axes.scatter([b.confidence], [b.accuracy], area, color=colour, alpha=0.3, linewidth=0, marker=marker)
        below = (0, -math.sqrt(area) / 2 - 10)
        axes.annotate(str(b.count), (b.confidence, b.accuracy), below, textcoords="offset points", ha="center", size=8)


def plot_risk_coverage(result: SceneResult, file: str) -> Figure | None:
    """Return the share of wrong answers as more are accepted, under authored names; None without confidences."""
    curves = {method: risk_coverage(scores) for method, scores in scores_under(result, _SEMANTIC).items()}
    if not any(curves.values()):
        return None
    with _drawing(7, 3.8) as (canvas, [axes]):
        for index, (method, curve) in enumerate(curves.items()):
            x, y = [100 * coverage for coverage, _ in curve], [100 * risk for _, risk in curve]
            axes.plot(x, y, marker=_MARKERS[index % 8], markersize=4, color=_COLOURS[index % 8], label=_label(method))
        axes.set(xlim=(0, 102), xlabel="coverage: objects answered, surest first, %", ylabel="wrong answers, %")
        highest = max(risk for curve in curves.values() for _, risk in curve)
        axes.set_ylim(0, max(5.0, 110 * highest))
        _legend(canvas, axes)
        return _figure(canvas, file, f"{result.spec.name}: what abstaining would buy, authored names.")


def plot_cost(results: Sequence[SceneResult], file: str) -> Figure | None:
    """Return EMA against seconds per object, a point for each scene and method; None if nothing was timed."""
    timed = [
        (result, method, done)
        for result in results
        for (method, condition), done in runs_of(result).items()
        if condition == _SEMANTIC and done[0].evaluation.seconds > 0
    ]
    if not timed:
        return None
    methods = list(dict.fromkeys(method for _, method, _ in timed))
    scenes = list(dict.fromkeys(result.spec.name for result, _, _ in timed))
    with _drawing(7.4, 4) as (canvas, [axes]):
        each = [sum(d.evaluation.seconds / d.evaluation.summary.n for d in done) / len(done) for _, _, done in timed]
        for (result, method, done), seconds in zip(timed, each, strict=True):
            marker, colour = _MARKERS[scenes.index(result.spec.name) % 8], _COLOURS[methods.index(method) % 8]
            axes.scatter([seconds], [_mean_ema(done)], 70, color=colour, marker=marker, alpha=0.8)
        for index, method in enumerate(methods):
            axes.scatter([], [], 70, color=_COLOURS[index % 8], marker="o", label=_label(method))
        for marker, name in zip(cycle(_MARKERS), scenes, strict=False):
            axes.scatter([], [], 70, facecolor="none", edgecolor="#333333", marker=marker, label=_label(name))
        axes.set_xscale("log")
        # The usual 10^-3 would be a formula. Whole decades, so that there is always a labelled tick.
        axes.xaxis.set_major_formatter(lambda seconds, _: plain_number(seconds))
        axes.xaxis.set_minor_formatter("")
        axes.set_xlim(10 ** math.floor(math.log10(min(each)) - 0.1), 10 ** math.ceil(math.log10(max(each)) + 0.1))
        axes.set(xlabel="seconds per object", ylabel="EMA, %", ylim=(-4, 104))
        canvas.legend(*axes.get_legend_handles_labels(), loc="outside right upper")
        return _figure(canvas, file, "Cost against accuracy, authored names: colours are methods, shapes are scenes.")


def plot_confusion(result: SceneResult, file: str) -> Figure | None:
    """Return which class the default grounder takes for which, under authored names; None if there is nothing to show.

    Up to 45 classes are drawn all; of more, those that were confused.
    """
    by_method = scores_under(result, _SEMANTIC)
    if not by_method:
        return None
    method, scores = next(iter(by_method.items()))
    kept, left_out = _shown(scores)
    if not kept:
        return None
    classes = hierarchy_order({iri for score in kept for iri in (score.target, score.answer) if iri}, result.tbox)
    columns = [*classes, None] if any(score.answer is None for score in kept) else [*classes]
    counts = Counter((score.target, score.answer) for score in kept)
    with _drawing(2.6 + 0.2 * len(columns), 2.2 + 0.2 * len(classes)) as (canvas, [axes]):
        _heat_map(axes, classes, columns, counts)
        axes.set_xticks(range(len(columns)), [_label(class_text(iri, result.tbox), 24) for iri in columns])
        axes.set_yticks(range(len(classes)), [_label(class_text(iri, result.tbox), 24) for iri in classes])
        axes.tick_params(length=0, labelsize=8)
        axes.tick_params(axis="x", labelrotation=90)
        axes.set(xlabel=f"answer of {_label(method)}", ylabel="gold")
        note = f" {left_out} classes that are never confused are left out." if left_out else ""
        what = "classes taken for one another, authored names; blue is right, orange wrong"
        caption = f"{result.spec.name}: {what}.{note}"
        return _figure(canvas, file, caption)


def _shown(scores: Sequence[Score]) -> tuple[list[Score], int]:
    """Return the scores of the classes to draw, and the number of classes left out."""
    classes = {iri for score in scores for iri in (score.target, score.answer) if iri is not None}
    if len(classes) <= _MOST_CLASSES:
        return list(scores), 0
    confused = {iri for score in scores if not score.is_exact for iri in (score.target, score.answer)}
    return [score for score in scores if score.target in confused], len(classes - confused)


def _heat_map(
    axes: "Axes",
    rows: Sequence[ClassIRI],
    columns: Sequence[ClassIRI | None],
    counts: Mapping[tuple[ClassIRI, ClassIRI | None], int],
) -> None:
    from matplotlib import colormaps  # noqa: PLC0415
    from matplotlib.patches import Rectangle  # noqa: PLC0415

    # Squares and no image: the drawing stays sharp, and most cells are empty. The root keeps small counts apart.
    highest = max(counts.values())
    for y, target in enumerate(rows):
        for x, answer in enumerate(columns):
            if count := counts.get((target, answer), 0):
                strength = 0.2 + 0.7 * math.sqrt(count / highest)
                colour = colormaps["Blues" if answer == target else "Oranges"](strength)
                axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=colour))
                ink = "white" if strength > 0.6 else "black"
                axes.text(x, y, str(count), ha="center", va="center", size=7, color=ink)
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(len(rows) - 0.5, -0.5), aspect="equal")
    axes.grid(visible=True, color="#eeeeee", linewidth=0.5)
