"""The room as cards: each piece of furniture with all that is on and in it, as an indented tree."""

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
_GROUND_SHARE = 0.3
"""Share of all objects below one of them that makes it the ground of the room."""


class _Card(NamedTuple):
    lines: tuple[CardLine, ...]
    width: float
    height: float


def draw_room(store: GraphStore, title: str) -> str:
    """Return a picture of all objects of a graph, as SVG.

    The obj that carries most, the floor, is the head; what stands on it has a card each, and so has what stands on
    nothing but carries something. Things that are alike share a line.
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
    heads = [(shorten(title, 90) + f"  {len(objects)} objects", 18.0)]
    if ground is not None:
        heads.append((shorten(ground.label) + ground.class_label + _CARRIES, 13.0))
    widest = max(text_width(text, size) for text, size in heads) + 80
    total = max(len(columns) * (width + _GAP) + _GAP, widest)
    canvas = Canvas()
    colors = colors_of(obj.family for obj in objects.values())
    used = sorted({obj.family for obj in objects.values()}, key=lambda name: (name == "other", name))
    canvas.text(_GAP, 32, shorten(title, 90), f"{len(objects)} objects", size=18, bold=True)
    note = "Indented: on what is above it; “in”, “part”, “joint” where so. × counts alike objects. Number: confidence."
    canvas.text(_GAP, 54, note if text_width(note, 12) < total else "", size=12, fill=PALE_INK)
    top = 66 + canvas.legend(_GAP, 66, [(name, colors[name]) for name in used], total - 2 * _GAP) + 6
    if ground is not None:
        canvas.rectangle(_GAP, top, total - 2 * _GAP, 30, PAPER, LINE)
        canvas.dot(_GAP + 16, top + 15, colors[ground.family])
        canvas.text(
            _GAP + 28,
            top + 20,
            shorten(ground.label),
            f"{ground.class_label}{_CARRIES}",
            bold=True,
        )
        top += 30 + _GAP
    bottom = top
    for number, column in enumerate(columns):
        y = top
        for card in column:
            _draw_card(canvas, card, _GAP + number * (width + _GAP), y, width, colors)
            y += card.height + _GAP
        bottom = max(bottom, y)
    return canvas.document(total, bottom, title)


def _qualify_shared_labels(heads: list[TreeObject]) -> None:
    """Put the prim above before the label of each of some objects that share theirs: cab_01/carcass."""
    shared = {label for label, count in Counter(obj.label for obj in heads).items() if count > 1}
    for obj in heads:
        above = obj.path.rpartition("/")[0].rpartition("/")[2]
        if obj.label in shared and above:
            obj.label = f"{above}/{obj.label}"


def _count(obj: TreeObject) -> int:
    return 1 + sum(_count(child) for child in obj.children)


def _groups(roots: Iterable[TreeObject], ground: TreeObject | None) -> Iterator[tuple[CardLine, ...]]:
    """Yield the lines of each card: one tree each, the largest first, then what carries nothing."""
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
    # Within a card the indent says "on"; its head hangs on what is not in the card.
    tie = line.tie if depth == 0 or line.tie != "on" else ""
    return shorten(" · ".join(part for part in (tie, line.detail) if part))


def _columns(cards: list[_Card], width: float) -> list[list[_Card]]:
    """Return the cards in columns of like heights, as many as make the picture about half as wide again as high."""
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
    """Draw lines from a height on, each below the one before; return the height after them."""
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
