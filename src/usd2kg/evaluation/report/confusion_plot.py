"""Heat map of the confusions of the default grounder."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from usd2kg.evaluation.report.analysis import scores_by_method, sort_by_hierarchy
from usd2kg.evaluation.report.blocks import Figure
from usd2kg.evaluation.report.canvas import label_text, open_canvas, to_figure
from usd2kg.evaluation.report.cell_text import class_text
from usd2kg.evaluation.run_matrix import SceneResult
from usd2kg.evaluation.score import Score
from usd2kg.evaluation.settings import REPORT
from usd2kg.grounding import NamingRegime
from usd2kg.ontology import ClassIRI

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_confusion"]

_LONGEST_CLASS = 24
"""Characters of a class label."""


def plot_confusion(result: SceneResult, file: str) -> Figure | None:
    """Return a heat map of gold class × answer of the first method under authored names; None if it is empty.

    With more classes than `max_heat_map_classes`, it omits those that are never confused.
    """
    by_method = scores_by_method(result, NamingRegime.SEMANTIC.value)
    if not by_method:
        return None
    method, scores = next(iter(by_method.items()))
    kept, omitted = _select(scores)
    if not kept:
        return None
    classes = sort_by_hierarchy({iri for score in kept for iri in (score.target, score.answer) if iri}, result.tbox)
    columns = [*classes, None] if any(score.answer is None for score in kept) else [*classes]
    counts = Counter((score.target, score.answer) for score in kept)
    with open_canvas(2.6 + 0.2 * len(columns), 2.2 + 0.2 * len(classes)) as (canvas, [axes]):
        _draw_cells(axes, classes, columns, counts)
        for set_ticks, iris in ((axes.set_xticks, columns), (axes.set_yticks, classes)):
            set_ticks(range(len(iris)), [label_text(class_text(iri, result.tbox), _LONGEST_CLASS) for iri in iris])
        axes.tick_params(length=0, labelsize=8)
        axes.tick_params(axis="x", labelrotation=90)
        axes.set(xlabel=f"answer of {label_text(method)}", ylabel="gold")
        note = f" {omitted} classes that are never confused are omitted." if omitted else ""
        caption = f"{result.spec.name}: confusion of classes, authored names; right is blue, wrong orange.{note}"
        return to_figure(canvas, file, caption)


def _select(scores: Sequence[Score]) -> tuple[list[Score], int]:
    """Return the scores of the classes to draw, and the number of omitted classes."""
    classes = {iri for score in scores for iri in (score.target, score.answer) if iri is not None}
    if len(classes) <= REPORT.max_heat_map_classes:
        return list(scores), 0
    confused = {iri for score in scores if not score.is_exact for iri in (score.target, score.answer)}
    return [score for score in scores if score.target in confused], len(classes - confused)


def _draw_cells(
    axes: "Axes",
    rows: Sequence[ClassIRI],
    columns: Sequence[ClassIRI | None],
    counts: Mapping[tuple[ClassIRI, ClassIRI | None], int],
) -> None:
    from matplotlib import colormaps  # noqa: PLC0415
    from matplotlib.patches import Rectangle  # noqa: PLC0415

    # Rectangles instead of an image: sharp at any size, and most cells are empty. The square root separates low counts.
    highest = max(counts.values())
    row_of, column_of = ({iri: place for place, iri in enumerate(iris)} for iris in (rows, columns))
    for (target, answer), count in sorted(counts.items(), key=lambda item: (row_of[item[0][0]], column_of[item[0][1]])):
        x, y, strength = column_of[answer], row_of[target], 0.2 + 0.7 * math.sqrt(count / highest)
        color = colormaps["Blues" if answer == target else "Oranges"](strength)
        axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=color))
        ink = "white" if strength > 0.6 else "black"
        axes.text(x, y, str(count), ha="center", va="center", size=7, color=ink)
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(len(rows) - 0.5, -0.5), aspect="equal")
    axes.grid(visible=True, color="#eeeeee", linewidth=0.5)
