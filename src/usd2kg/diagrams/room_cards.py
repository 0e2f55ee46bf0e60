"""A room as cards: each piece of furniture with the objects on and in it, as an indented tree."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from usd2kg.diagrams.object_tree import CardLine, TreeObject, group_similar, read_object_tree
from usd2kg.diagrams.settings import ROOM, SHAPES, TEXT
from usd2kg.diagrams.svg import LINE, PALE_INK, PAPER, Canvas, colors_of, shorten, text_width
from usd2kg.query.graph_store import GraphStore

__all__ = ["draw_room"]

_SUPPORTS = "; supports the cards marked “on”"
_NOTE = (
    "Indentation: on the object above, or “in”, “part”, “joint”, “attached”. ×: number of similar objects. "
    "Number: confidence."
)


_LINE_SPACE = 25.0
"""Width of the dot and of the spaces of a line."""


class _Card(NamedTuple):
    lines: tuple[CardLine, ...]
    width: float
    height: float


def draw_room(store: GraphStore, title: str) -> str:
    """Return an SVG diagram of all objects of a graph.

    The root with the most descendants, usually the floor, is the header if it carries enough of the objects. Each
    object on it with children has a card, and so has each other root with children. Similar objects share a line.
    """
    objects = read_object_tree(store)
    roots = [obj for obj in objects.values() if obj.parent is None]
    ground = max(roots, key=_count, default=None)
    if ground is not None and _count(ground) < ROOM.min_ground_share * len(objects):
        ground = None
    _qualify_shared_labels([obj for obj in (*roots, *(ground.children if ground else ())) if obj.children])
    cards = sorted((_card(lines) for lines in _groups(roots, ground)), key=lambda card: -card.height)
    width = max([card.width for card in cards], default=200.0)
    columns = _columns(cards, width)
    subtitle = f"{ground.class_label}{_SUPPORTS}" if ground is not None else ""
    widest = text_width(shorten(title, TEXT.max_title_letters) + f"  {len(objects)} objects", TEXT.title_size)
    if ground is not None:
        widest = max(widest, text_width(shorten(ground.label) + subtitle, TEXT.label_size))
    total = max(len(columns) * (width + ROOM.gap) + ROOM.gap, widest + 80)
    canvas = Canvas()
    families = {obj.family for obj in objects.values()}
    colors = colors_of(families)
    legend = {name: color for name, color in colors.items() if name in families}
    top = _draw_header(canvas, title, len(objects), legend, total)
    if ground is not None:
        canvas.rectangle(ROOM.gap, top, total - 2 * ROOM.gap, 30, PAPER, LINE)
        canvas.dot(ROOM.gap + 16, top + 15, colors[ground.family])
        canvas.text(ROOM.gap + 28, top + 20, shorten(ground.label), subtitle, bold=True)
        top += 30 + ROOM.gap
    bottom = top
    for number, column in enumerate(columns):
        y = top
        for card in column:
            _draw_card(canvas, card, ROOM.gap + number * (width + ROOM.gap), y, width, colors)
            y += card.height + ROOM.gap
        bottom = max(bottom, y)
    return canvas.document(total, bottom, title)


def _draw_header(canvas: Canvas, title: str, count: int, legend: dict[str, str], width: float) -> float:
    """Draw title, note and legend; return the y below them."""
    canvas.text(
        ROOM.gap, 32, shorten(title, TEXT.max_title_letters), f"{count} objects", size=TEXT.title_size, bold=True
    )
    if text_width(_NOTE, TEXT.small_size) < width:
        canvas.text(ROOM.gap, 54, _NOTE, size=TEXT.small_size, fill=PALE_INK)
    return 72 + canvas.legend(ROOM.gap, 66, legend, width - 2 * ROOM.gap)


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
        ("no known relation", free),
    ):
        lines = tuple(line for line in group_similar(group) if not line.children)
        if lines:
            yield (CardLine(head, "", "", "", "", lines),)


def _rows(lines: Iterable[CardLine]) -> int:
    return sum(1 + _rows(line.children) for line in lines)


def _card(lines: tuple[CardLine, ...]) -> _Card:
    return _Card(
        lines, max(_widths(lines, 0)) + 2 * SHAPES.padding, _rows(lines) * SHAPES.row_height + 2 * SHAPES.padding - 4
    )


def _widths(lines: Iterable[CardLine], depth: int) -> Iterator[float]:
    for line in lines:
        label = text_width(shorten(line.text), TEXT.label_measure)
        yield depth * SHAPES.indent + label + text_width(_detail(line, depth), TEXT.detail_measure) + _LINE_SPACE
        yield from _widths(line.children, depth + 1)


def _detail(line: CardLine, depth: int) -> str:
    # Within a card, the indentation means "on".
    tie = line.tie if depth == 0 or line.tie != "on" else ""
    return shorten(" · ".join(part for part in (tie, line.detail) if part))


def _columns(cards: list[_Card], width: float) -> list[list[_Card]]:
    """Return the cards in columns of similar height; their number approximates the configured aspect ratio."""
    total = sum(card.height + ROOM.gap for card in cards)
    count = max(1, min(len(cards), round((ROOM.aspect_ratio * total / (width + ROOM.gap)) ** 0.5)))
    columns: list[list[_Card]] = [[] for _ in range(count)]
    for card in cards:
        min(columns, key=lambda column: sum(c.height + ROOM.gap for c in column)).append(card)
    return columns


def _draw_card(canvas: Canvas, card: _Card, x: float, y: float, width: float, colors: dict[str, str]) -> None:
    canvas.rectangle(x, y, width, card.height, PAPER, LINE)
    _draw_lines(canvas, card.lines, x + SHAPES.padding, y + SHAPES.padding + 8, 0, colors)


def _draw_lines(
    canvas: Canvas, lines: tuple[CardLine, ...], x: float, y: float, depth: int, colors: dict[str, str]
) -> float:
    """Draw lines from y downwards; return the y below the last."""
    for line in lines:
        at = x + depth * SHAPES.indent
        if line.family:
            canvas.dot(at + 5, y, colors[line.family])
        canvas.text(
            at + SHAPES.dot_column if line.family else at,
            y + TEXT.baseline_drop,
            shorten(line.text),
            _detail(line, depth),
            bold=depth == 0,
            title=line.names,
        )
        start, y = y, y + SHAPES.row_height
        for child in line.children:
            canvas.path(
                [(at + 5, start + 7), (at + 5, y), (at + SHAPES.indent - 2, y)], dashed=child.tie in {"part", "joint"}
            )
            y = _draw_lines(canvas, (child,), x, y, depth + 1, colors)
    return y
