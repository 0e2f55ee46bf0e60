"""One object as a card: supporters below, supported objects above, contents and parts left, nearby objects right."""

from collections.abc import Sequence
from typing import NamedTuple

from usd2kg.diagrams.object_tree import CardLine, TreeObject, group_similar, read_object_tree, single_line
from usd2kg.diagrams.svg import LINE, PALE_INK, PAPER, Canvas, colors_of, shorten, text_width
from usd2kg.errors import GraphError
from usd2kg.query.graph_store import GraphStore

__all__ = ["draw_surroundings"]

_ROW = 21.0
_PAD = 14.0
_GAP = 46.0
_MARGIN = 20.0
_HEAD = 58.0
_MAX_LINES = 14
"""Lines per panel."""
_NEAR = "0.5 m"


class _Panel(NamedTuple):
    head: str
    lines: tuple[CardLine, ...]

    @property
    def width(self) -> float:
        texts = [text_width(shorten(line.text), 13) + 9 + text_width(shorten(line.detail), 11.5) for line in self.lines]
        return max([text_width(self.head, 13), *(width + 18 for width in texts)]) + 2 * _PAD

    @property
    def height(self) -> float:
        return (1 + len(self.lines)) * _ROW + 2 * _PAD - 4


def draw_surroundings(store: GraphStore, iri: str, title: str) -> str:
    """Return an SVG diagram of one object and its surroundings within half a metre.

    Raises:
        GraphError: the IRI names no object.
    """
    objects = read_object_tree(store)
    if iri not in objects:
        raise GraphError(f"{title}: <{iri}> is the group of a room; expected an object, or none for the room")
    obj = objects[iri]
    below = _ancestors(obj, objects)
    left = [_panel("in it", [c for c in obj.children if c.tie == "in"])]
    left.append(_panel("parts of it", [c for c in obj.children if c.tie in {"part", "joint"}]))
    above = _panel("on it", [c for c in obj.children if c.tie == "on"])
    under = _Panel("what carries it, down to the floor", tuple(single_line(t) for t in below))
    near = _Panel(f"within {_NEAR}", _near(store, obj, objects, {t.iri for t in below}))
    shown = [obj, *below, *obj.children, *objects.values()]
    return _compose(
        obj, above, under, [panel for panel in left if panel.lines], near, colors_of(t.family for t in shown), title
    )


def _ancestors(obj: TreeObject, objects: dict[str, TreeObject]) -> list[TreeObject]:
    chain = []
    while obj.parent is not None:
        obj = objects[obj.parent]
        chain.append(obj)
    return chain


def _panel(head: str, objects: Sequence[TreeObject]) -> _Panel:
    lines = group_similar(objects)
    return _Panel(f"{head}: {len(objects)}" if objects else head, _cut(lines))


def _cut(lines: Sequence[CardLine]) -> tuple[CardLine, ...]:
    """Return the first lines, and one that counts the rest."""
    more = len(lines) - _MAX_LINES
    return (*lines[:_MAX_LINES], CardLine(f"… {more} more lines", "", "", "", "")) if more > 0 else tuple(lines)


def _near(
    store: GraphStore, obj: TreeObject, objects: dict[str, TreeObject], excluded: set[str]
) -> tuple[CardLine, ...]:
    """Return the lines of nearby objects outside its support tree, nearest first, with distances."""
    answer = store.answer("close-to", {"thing": obj.path, "distance": _NEAR})
    by_path = {t.path: t for t in objects.values()}
    lines: list[CardLine] = []
    for row in answer.values:
        values = dict(zip(answer.columns, row, strict=True))
        other = by_path[str(values["path"])]
        if other.iri not in excluded and obj.iri not in {t.iri for t in _ancestors(other, objects)}:
            lines.append(
                CardLine(
                    other.label,
                    f"{other.class_label}, {float(values['gap_m'] or 0) * 100:.0f} cm",
                    "near",
                    other.family,
                    other.path,
                )
            )
    return _cut(lines)


def _compose(
    obj: TreeObject, above: _Panel, under: _Panel, left: list[_Panel], near: _Panel, colors: dict[str, str], title: str
) -> str:
    sure = "" if obj.confidence is None else f", confidence {obj.confidence:.2f}"
    words = (shorten(obj.label), shorten(f"{obj.class_label}{sure}", 60), obj.size)
    own_width = max(text_width(words[0], 17), *(text_width(word, 12.5) for word in words[1:])) + 50
    middle = max(own_width, *(panel.width for panel in (above, under) if panel.lines or panel is under))
    left_width = max([panel.width for panel in left], default=0.0)
    left_height = sum(panel.height + 14 for panel in left) - 14 if left else 0.0
    above_height = above.height + _GAP if above.lines else 0.0
    under_height = under.height + _GAP if under.lines else 0.0
    x = _MARGIN + (left_width + _GAP if left else 0)
    own_height = 80.0
    half = max(above_height + own_height / 2, left_height / 2, near.height / 2 if near.lines else 0)
    center = _HEAD + half
    width = x + middle + (_GAP + near.width if near.lines else 0) + _MARGIN
    width = max(width, text_width(shorten(title, 90), 18) + 2 * _MARGIN)
    canvas = Canvas()
    canvas.text(_MARGIN, 34, shorten(title, 90), size=18, bold=True)
    spine = x + middle / 2
    if above.lines:
        canvas.path([(spine, center - own_height / 2), (spine, center - own_height / 2 - _GAP)])
        _draw(canvas, above, spine - above.width / 2, center - own_height / 2 - above_height, colors)
    if under.lines:
        canvas.path([(spine, center + own_height / 2), (spine, center + own_height / 2 + _GAP)])
        _draw(canvas, under, spine - under.width / 2, center + own_height / 2 + _GAP, colors)
    y = center - left_height / 2
    for panel in left:
        canvas.path(
            [
                (spine - own_width / 2, center),
                (_MARGIN + left_width + _GAP / 2, center),
                (_MARGIN + left_width + _GAP / 2, y + panel.height / 2),
                (_MARGIN + left_width, y + panel.height / 2),
            ]
        )
        _draw(canvas, panel, _MARGIN + left_width - panel.width, y, colors)
        y += panel.height + 14
    if near.lines:
        canvas.path([(spine + own_width / 2, center), (x + middle + _GAP, center)], dashed=True)
        _draw(canvas, near, x + middle + _GAP, center - near.height / 2, colors)
    _draw_own(canvas, obj, words, (spine, center), (own_width, own_height), colors[obj.family])
    bottom = center + max(own_height / 2 + under_height, left_height / 2, near.height / 2 if near.lines else 0) + 16
    used = {line.family for panel in (above, under, near, *left) for line in panel.lines if line.family} | {obj.family}
    legend = {name: color for name, color in colors.items() if name in used}
    bottom += canvas.legend(_MARGIN, bottom, legend, width - 2 * _MARGIN)
    return canvas.document(width, bottom + 12, title)


def _draw_own(
    canvas: Canvas,
    obj: TreeObject,
    words: tuple[str, str, str],
    middle: tuple[float, float],
    size: tuple[float, float],
    color: str,
) -> None:
    (x, y), (width, height) = middle, size
    canvas.rectangle(x - width / 2, y - height / 2, width, height, color, radius=12)
    canvas.rectangle(x - width / 2 + 8, y - height / 2 + 1.5, width - 9.5, height - 3, PAPER, radius=10)
    canvas.text(x, y - 12, words[0], size=17, bold=True, title=obj.path, middle=True)
    canvas.text(x, y + 9, words[1], size=12.5, fill=PALE_INK, middle=True)
    canvas.text(x, y + 27, words[2], size=12.5, fill=PALE_INK, middle=True)


def _draw(canvas: Canvas, panel: _Panel, x: float, y: float, colors: dict[str, str]) -> None:
    canvas.rectangle(x, y, panel.width, panel.height, PAPER, LINE)
    canvas.text(x + _PAD, y + _PAD + 10, panel.head, size=12, bold=True, fill=PALE_INK)
    for number, line in enumerate(panel.lines, start=1):
        at = y + _PAD + 5 + number * _ROW
        if line.family:
            canvas.dot(x + _PAD + 5, at, colors[line.family])
        canvas.text(x + _PAD + 15, at + 4.5, shorten(line.text), shorten(line.detail), title=line.names)
