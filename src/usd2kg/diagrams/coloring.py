"""Colours of objects by a property, with a legend; the studio colours by the same rules (`web/src/state/colors.ts`)."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from usd2kg.diagrams.settings import COLORS, CONFIDENCE
from usd2kg.scene.model import Vector
from usd2kg.srgb import linear_from_srgb

__all__ = ["Coloring", "LegendEntry", "color_by_answer", "color_by_confidence", "color_by_group"]

_OTHERS = "others"


@dataclass(frozen=True, slots=True)
class LegendEntry:
    """One colour of a picture."""

    label: str
    color: str
    """sRGB, `#rrggbb`."""
    prim_paths: tuple[str, ...]
    """The objects in this colour."""


@dataclass(frozen=True, slots=True)
class Coloring:
    """The colours of all objects."""

    legend: tuple[LegendEntry, ...]

    def linear_colors(self) -> dict[str, Vector]:
        """Return prim path → linear RGB; `/` is everything outside the objects."""
        found = {"/": _linear(COLORS.rest)}
        for entry in self.legend:
            found |= dict.fromkeys(entry.prim_paths, _linear(entry.color))
        return found


def color_by_group(
    group_of: Mapping[str, str | None], labels: Mapping[str, str], ranking: Mapping[str, str | None], none: str
) -> Coloring:
    """Return a colour for each of the largest groups; all other objects share one colour.

    Args:
        group_of: prim path → group; None for an object in no group.
        labels: group → label, in the order that decides between groups of equal size.
        ranking: prim path → group by which groups are ranked, so that a correction changes the colour of one object
            and not of groups.
        none: label of the objects in no group.
    """
    members: dict[str | None, list[str]] = {}
    for path, group in group_of.items():
        members.setdefault(group, []).append(path)
    sizes, order = Counter(ranking.values()), {group: number for number, group in enumerate(labels)}
    # A group that has lost its members keeps its colour.
    ranked = sorted({*members, *sizes} - {None}, key=lambda group: (-sizes[group], order[group or ""]))
    colors = dict(zip(ranked, COLORS.categories, strict=False))
    others = [group for group in ranked if group in members and group not in colors]
    entries = [
        LegendEntry(labels[group or ""], color, tuple(members[group]))
        for group, color in colors.items()
        if group in members
    ]
    entries.sort(key=lambda entry: -len(entry.prim_paths))
    rest = [path for group in (*others, None) for path in members.get(group, ())]
    name = " or ".join(label for label, is_there in ((_OTHERS, others), (none, None in members)) if is_there)
    return Coloring(tuple(entries) + _rest_entry(name, rest))


def color_by_confidence(confidence_of: Mapping[str, float | None]) -> Coloring:
    """Return a colour for each confidence band; objects without a confidence have the colour for other objects."""
    steps: list[list[str]] = [[] for _ in CONFIDENCE.lower_bounds]
    unknown = []
    for path, confidence in confidence_of.items():
        if confidence is None:
            unknown.append(path)
        else:
            steps[next(i for i, bound in enumerate(CONFIDENCE.lower_bounds) if confidence >= bound)].append(path)
    entries = [
        LegendEntry(_step_label(i), CONFIDENCE.colors[i], tuple(paths)) for i, paths in enumerate(steps) if paths
    ]
    return Coloring(tuple(entries) + _rest_entry("not given", unknown))


def _step_label(index: int) -> str:
    low, bounds = CONFIDENCE.lower_bounds[index], CONFIDENCE.lower_bounds
    if low == 0:
        return f"below {bounds[index - 1]:.2f}"
    return f"{low:.2f} to {bounds[index - 1]:.2f}" if index else f"{low:.2f} to 1"


def color_by_answer(prim_paths: Sequence[str], answer: Collection[str]) -> Coloring:
    """Return one colour for the objects of an answer and another for all other objects."""
    rest = [path for path in prim_paths if path not in answer]
    entry = LegendEntry("in the answer", COLORS.answer, tuple(path for path in prim_paths if path in answer))
    return Coloring((entry, *_rest_entry("other", rest)))


def _rest_entry(label: str, prim_paths: Sequence[str]) -> tuple[LegendEntry, ...]:
    return (LegendEntry(label, COLORS.rest, tuple(prim_paths)),) if prim_paths else ()


def _linear(color: str) -> Vector:
    """Return linear RGB of sRGB `#rrggbb`."""
    red, green, blue = linear_from_srgb([int(color[at : at + 2], 16) / 255 for at in (1, 3, 5)]).tolist()
    return red, green, blue
