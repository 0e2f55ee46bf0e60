"""A room as cards: each piece of furniture with the objects on and in it, as an indented tree."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from usd2kg.diagrams.object_tree import CardLine, TreeObject, group_similar, read_object_tree
from usd2kg.diagrams.svg import LINE, PALE_INK, PAPER, Canvas, colors_of, shorten, text_width
from usd2kg.query.graph_store import GraphStore

__all__ = ["draw_room"]

_ROW = 21.0
_INDENT = 20.0
_PAD = 14.0
_GAP = 16.0
_CARRIES = "; carries the cards whose heads are marked “on”"
_NOTE = "Indented: on what is above it; “in”, “part”, “joint” where so. × counts alike things. Number: confidence."
_GROUND_SHARE = 0.3
"""Share of all objects below one that makes it the floor of the room."""


class _Card(NamedTuple):
    lines: tuple[CardLine, ...]
    width: float
    height: float


def draw_room(store: GraphStore, title: str) -> str:
    """Return an SVG diagram of all objects of a graph.

    The object that supports most, usually the floor, is the header. What it supports has a card each, and so has
    every other root with children. Similar objects share a line.
    """
    objects = read_object_tree(store)
    roots = [obj for obj in objects.values() if obj.parent is None]
    ground = max(roots, key=_count, default=None)
    if ground is not None and _count(ground) < _GROUND_SHARE * len(objects):
        ground = None
    _qualify_shared_labels([obj for obj in (*roots, *(ground.children if ground else ())) if obj.children])
    cards = sorted((_card(lines) for lines in _groups(roots, ground)), key=lambda card: -card.height)
    width = max([card.width for card in cards], default=200.0)
    columns = _columns(cards, width)
    subtitle = f"{ground.class_label}{_CARRIES}" if ground is not None else ""
    widest = text_width(shorten(title, 90) + f"  {len(objects)} objects", 18.0)
    if ground is not None:
        widest = max(widest, text_width(shorten(ground.label) + subtitle, 13.0))
    total = max(len(columns) * (width + _GAP) + _GAP, widest + 80)
    canvas = Canvas()
    families = {obj.family for obj in objects.values()}
    colors = colors_of(families)
    legend = {name: color for name, color in colors.items() if name in families}
    top = _draw_header(canvas, title, len(objects), legend, total)
    if ground is not None:
        canvas.rectangle(_GAP, top, total - 2 * _GAP, 30, PAPER, LINE)
        canvas.dot(_GAP + 16, top + 15, colors[ground.family])
        canvas.text(_GAP + 28, top + 20, shorten(ground.label), subtitle, bold=True)
        top += 30 + _GAP
    bottom = top
    for number, column in enumerate(columns):
        y = top
        for card in column:
            _draw_card(canvas, card, _GAP + number * (width + _GAP), y, width, colors)
            y += card.height + _GAP
        bottom = max(bottom, y)
    return canvas.document(total, bottom, title)


def _draw_header(canvas: Canvas, title: str, count: int, legend: dict[str, str], width: float) -> float:
    """Draw title, note and legend; return the y below them."""
    canvas.text(_GAP, 32, shorten(title, 90), f"{count} objects", size=18, bold=True)
    if text_width(_NOTE, 12) < width:
        canvas.text(_GAP, 54, _NOTE, size=12, fill=PALE_INK)
    return 72 + canvas.legend(_GAP, 66, legend, width - 2 * _GAP)


def _qualify_shared_labels(heads: list[TreeObject]) -> None:
    """Prefix shared labels with the name of the parent prim, as in cab_01/carcass."""
    shared = {label for label, count in Counter(obj.label for obj in heads).items() if count > 1}
    for obj in heads:
        above = obj.path.rpartition("/")[0].rpartition("/")[2]
        if obj.label in shared and above:
            obj.label = f"{above}/{obj.label}"


def _count(obj: TreeObject) -> int:
    return 1 + sum(_count(child) for child in obj.children)


def _groups(roots: Iterable[TreeObject], ground: TreeObject | None) -> Iterator[tuple[CardLine, ...]]:
    """Yield the lines of each card: the trees, largest first, then the leaves."""
    standing = ground.children if ground else []
    free = [obj for obj in roots if obj is not ground]
    trees = [line for line in (*group_similar(standing), *group_similar(free)) if line.children]
    yield from ((line,) for line in sorted(trees, key=lambda line: (-_rows((line,)), line.text)))
    for head, group in (
        (f"also on {ground.label}" if ground else "", standing),
        ("on and in nothing that is known", free),
    ):
        lines = tuple(line for line in group_similar(group) if not line.children)
        if lines:
            yield (CardLine(head, "", "", "", "", lines),)


def _rows(lines: Iterable[CardLine]) -> int:
    return sum(1 + _rows(line.children) for line in lines)


def _card(lines: tuple[CardLine, ...]) -> _Card:
    return _Card(lines, max(_widths(lines, 0)) + 2 * _PAD, _rows(lines) * _ROW + 2 * _PAD - 4)


def _widths(lines: Iterable[CardLine], depth: int) -> Iterator[float]:
    for line in lines:
        yield depth * _INDENT + 16 + text_width(shorten(line.text), 13.5) + 9 + text_width(_detail(line, depth), 11.5)
        yield from _widths(line.children, depth + 1)


def _detail(line: CardLine, depth: int) -> str:
    # Within a card, the indent stands for "on".
    tie = line.tie if depth == 0 or line.tie != "on" else ""
    return shorten(" · ".join(part for part in (tie, line.detail) if part))


def _columns(cards: list[_Card], width: float) -> list[list[_Card]]:
    """Return the cards in columns of similar height, for an aspect ratio of about 3:2."""
    total = sum(card.height + _GAP for card in cards)
    count = max(1, min(len(cards), round((1.5 * total / (width + _GAP)) ** 0.5)))
    columns: list[list[_Card]] = [[] for _ in range(count)]
    for card in cards:
        min(columns, key=lambda column: sum(c.height + _GAP for c in column)).append(card)
    return columns


def _draw_card(canvas: Canvas, card: _Card, x: float, y: float, width: float, colors: dict[str, str]) -> None:
    canvas.rectangle(x, y, width, card.height, PAPER, LINE)
    _draw_lines(canvas, card.lines, x + _PAD, y + _PAD + 8, 0, colors)


def _draw_lines(
    canvas: Canvas, lines: tuple[CardLine, ...], x: float, y: float, depth: int, colors: dict[str, str]
) -> float:
    """Draw lines from y downwards; return the y below the last."""
    for line in lines:
        at = x + depth * _INDENT
        if line.family:
            canvas.dot(at + 5, y, colors[line.family])
        canvas.text(
            at + 15 if line.family else at,
            y + 4.5,
            shorten(line.text),
            _detail(line, depth),
            bold=depth == 0,
            title=line.names,
        )
        start, y = y, y + _ROW
        for child in line.children:
            canvas.path(
                [(at + 5, start + 7), (at + 5, y), (at + _INDENT - 2, y)], dashed=child.tie in {"part", "joint"}
            )
            y = _draw_lines(canvas, (child,), x, y, depth + 1, colors)
    return y
