"""One object as a card: supporters below, supported objects above, contents and parts left, nearby objects right."""

from collections.abc import Sequence
from typing import NamedTuple

from usd2kg.diagrams.object_tree import CardLine, TreeObject, group_similar, read_object_tree, single_line
from usd2kg.diagrams.settings import SHAPES, SURROUNDINGS, TEXT
from usd2kg.diagrams.svg import LINE, PALE_INK, PAPER, Canvas, colors_of, shorten, text_width
from usd2kg.errors import GraphError
from usd2kg.query.graph_store import GraphStore

__all__ = ["draw_surroundings"]


_LINE_SPACE = 27.0
"""Width of the dot and of the spaces of a line."""


class _Panel(NamedTuple):
    head: str
    lines: tuple[CardLine, ...]

    @property
    def width(self) -> float:
        return max([text_width(self.head, TEXT.label_size), *map(_line_width, self.lines)]) + 2 * SHAPES.padding

    @property
    def height(self) -> float:
        return (1 + len(self.lines)) * SHAPES.row_height + 2 * SHAPES.padding - 4


def _line_width(line: CardLine) -> float:
    label, detail = shorten(line.text), shorten(line.detail)
    return text_width(label, TEXT.label_size) + text_width(detail, TEXT.detail_measure) + _LINE_SPACE


def draw_surroundings(store: GraphStore, iri: str, title: str) -> str:
    """Return an SVG diagram of one object, what supports it, what is on and in it, and what is nearby.

    Raises:
        GraphError: the IRI names no object.
    """
    objects = read_object_tree(store)
    if iri not in objects:
        raise GraphError(f"{title}: <{iri}> is a room; expected the IRI of an object, or none for the room")
    obj = objects[iri]
    below = _ancestors(obj, objects)
    left = [_panel("in it", [c for c in obj.children if c.tie == "in"])]
    left.append(_panel("parts of it", [c for c in obj.children if c.tie in {"part", "joint"}]))
    above = _panel("on it", [c for c in obj.children if c.tie == "on"])
    under = _Panel("what carries it, down to the floor", tuple(single_line(t) for t in below))
    near = _Panel(f"within {SURROUNDINGS.max_distance_m:g} m", _near(store, obj, objects, {t.iri for t in below}))
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
    """Return the first lines, and a line that counts the others."""
    more = len(lines) - SURROUNDINGS.max_lines
    if more <= 0:
        return tuple(lines)
    return (*lines[: SURROUNDINGS.max_lines], CardLine(f"… {more} more lines", "", "", "", ""))


def _near(
    store: GraphStore, obj: TreeObject, objects: dict[str, TreeObject], excluded: set[str]
) -> tuple[CardLine, ...]:
    """Return the lines of nearby objects outside the object's support tree, nearest first, with distances."""
    answer = store.answer("close-to", {"thing": obj.path, "distance": f"{SURROUNDINGS.max_distance_m:g} m"})
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


class _Layout(NamedTuple):
    """The panels around the box of an object."""

    above: _Panel
    under: _Panel
    left: list[_Panel]
    near: _Panel
    box_width: float
    """Width of the box of the object."""

    @property
    def left_width(self) -> float:
        return max([panel.width for panel in self.left], default=0.0)

    @property
    def left_height(self) -> float:
        gap = SURROUNDINGS.panel_gap
        return sum(panel.height + gap for panel in self.left) - gap if self.left else 0.0

    @property
    def middle_width(self) -> float:
        return max(self.box_width, self.under.width, self.above.width if self.above.lines else 0.0)

    @property
    def middle_left(self) -> float:
        return SURROUNDINGS.margin + (self.left_width + SURROUNDINGS.gap if self.left else 0.0)

    @property
    def width(self) -> float:
        near = SURROUNDINGS.gap + self.near.width if self.near.lines else 0.0
        return self.middle_left + self.middle_width + near + SURROUNDINGS.margin

    def extent(self, panel: _Panel) -> float:
        """Return the height that the side of the box with `panel`, above or below, needs from its centre."""
        own = SURROUNDINGS.object_height / 2 + (panel.height + SURROUNDINGS.gap if panel.lines else 0.0)
        return max(own, self.left_height / 2, self.near.height / 2 if self.near.lines else 0.0)


def _compose(
    obj: TreeObject, above: _Panel, under: _Panel, left: list[_Panel], near: _Panel, colors: dict[str, str], title: str
) -> str:
    confidence = "" if obj.confidence is None else f", confidence {obj.confidence:.2f}"
    words = shorten(obj.label), shorten(f"{obj.class_label}{confidence}", TEXT.max_object_letters), obj.size
    text_widths = [text_width(word, TEXT.object_detail_size) for word in words[1:]]
    box_width = max(text_width(words[0], TEXT.object_size), *text_widths) + SURROUNDINGS.object_padding
    layout = _Layout(above, under, left, near, box_width)
    center = (layout.middle_left + layout.middle_width / 2, SURROUNDINGS.title_height + layout.extent(above))
    short_title = shorten(title, TEXT.max_title_letters)
    width = max(layout.width, text_width(short_title, TEXT.title_size) + 2 * SURROUNDINGS.margin)
    canvas = Canvas()
    canvas.text(SURROUNDINGS.margin, 34, short_title, size=TEXT.title_size, bold=True)
    _draw_column(canvas, layout, center, colors)
    _draw_left(canvas, layout, center, colors)
    if near.lines:
        x = layout.middle_left + layout.middle_width + SURROUNDINGS.gap
        canvas.path([(center[0] + box_width / 2, center[1]), (x, center[1])], dashed=True)
        _draw(canvas, near, x, center[1] - near.height / 2, colors)
    _draw_own(canvas, obj, words, center, (box_width, SURROUNDINGS.object_height), colors[obj.family])
    bottom = center[1] + layout.extent(under) + 16
    used = {line.family for panel in (above, under, near, *left) for line in panel.lines if line.family} | {obj.family}
    legend = {name: color for name, color in colors.items() if name in used}
    bottom += canvas.legend(SURROUNDINGS.margin, bottom, legend, width - 2 * SURROUNDINGS.margin)
    return canvas.document(width, bottom + 12, title)


def _draw_column(canvas: Canvas, layout: _Layout, center: tuple[float, float], colors: dict[str, str]) -> None:
    """Draw the panels above and below the box."""
    x, y = center
    half, gap = SURROUNDINGS.object_height / 2, SURROUNDINGS.gap
    if layout.above.lines:
        canvas.path([(x, y - half), (x, y - half - gap)])
        _draw(canvas, layout.above, x - layout.above.width / 2, y - half - gap - layout.above.height, colors)
    if layout.under.lines:
        canvas.path([(x, y + half), (x, y + half + gap)])
        _draw(canvas, layout.under, x - layout.under.width / 2, y + half + gap, colors)


def _draw_left(canvas: Canvas, layout: _Layout, center: tuple[float, float], colors: dict[str, str]) -> None:
    """Draw the panels on the left, each connected to the box by an elbow."""
    right = SURROUNDINGS.margin + layout.left_width
    elbow = right + SURROUNDINGS.gap / 2
    y = center[1] - layout.left_height / 2
    for panel in layout.left:
        middle = y + panel.height / 2
        start = center[0] - layout.box_width / 2, center[1]
        canvas.path([start, (elbow, center[1]), (elbow, middle), (right, middle)])
        _draw(canvas, panel, right - panel.width, y, colors)
        y += panel.height + SURROUNDINGS.panel_gap


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
    canvas.text(x, y - 12, words[0], size=TEXT.object_size, bold=True, title=obj.path, middle=True)
    canvas.text(x, y + 9, words[1], size=TEXT.object_detail_size, fill=PALE_INK, middle=True)
    canvas.text(x, y + 27, words[2], size=TEXT.object_detail_size, fill=PALE_INK, middle=True)


def _draw(canvas: Canvas, panel: _Panel, x: float, y: float, colors: dict[str, str]) -> None:
    canvas.rectangle(x, y, panel.width, panel.height, PAPER, LINE)
    canvas.text(x + SHAPES.padding, y + SHAPES.padding + 10, panel.head, size=TEXT.small_size, bold=True, fill=PALE_INK)
    for number, line in enumerate(panel.lines, start=1):
        at = y + SHAPES.padding + 5 + number * SHAPES.row_height
        if line.family:
            canvas.dot(x + SHAPES.padding + 5, at, colors[line.family])
        canvas.text(
            x + SHAPES.padding + SHAPES.dot_column,
            at + TEXT.baseline_drop,
            shorten(line.text),
            shorten(line.detail),
            title=line.names,
        )
