"""find_in_the_way: what a door or a window without a joint would hit, by boxes."""

from collections.abc import Collection

import numpy as np

from usd2kg.assistant.settings import OPENING
from usd2kg.query.lookup import SceneFacts

__all__ = ["find_in_the_way"]


def find_in_the_way(facts: SceneFacts, panel: str, ignored: Collection[str]) -> list[str] | None:
    """Return the objects in the space that a panel sweeps if it opens to either side, by prim path.

    The space is as deep as the panel is wide. What reaches through the closed panel is its frame or the wall, and what
    touches it and reaches no farther than a handle does is fixed to it.

    Args:
        facts: the graph.
        panel: a door, a window or a shutter.
        ignored: objects that are not in the way, such as its parts.

    Returns:
        None for an object without a box, or too thick for a panel.
    """
    body, table = facts.body(panel), facts.bodies.table
    if body.lower is None or body.upper is None:
        return None
    sides = (body.upper - body.lower)[:2]
    normal = int(np.argmin(sides))
    width = float(sides[1 - normal])
    if float(sides[normal]) > OPENING.max_thickness * width:
        return None
    lower, upper = body.lower + OPENING.margin, body.upper - OPENING.margin
    lower[normal], upper[normal] = body.lower[normal] - width, body.upper[normal] + width
    # Objects without a box have NaN, which meets nothing.
    is_swept = ((table.lower < upper) & (table.upper > lower)).all(axis=1)
    is_touching = ((table.lower <= body.upper) & (table.upper >= body.lower)).all(axis=1)
    middle = (body.lower[normal] + body.upper[normal]) / 2
    is_through = (table.lower[:, normal] < middle) & (table.upper[:, normal] > middle)
    reach = np.maximum(body.lower[normal] - table.lower[:, normal], table.upper[:, normal] - body.upper[normal])
    is_fixed = is_touching & (is_through | (reach <= OPENING.max_handle))
    rows = np.flatnonzero(is_swept & ~is_fixed).tolist()
    return facts.sorted(iri for row in rows if (iri := table.iris[row]) not in ignored and iri != panel)
