"""What the words of an object's view are, one source after the other, and which of them a program made up."""

import re

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.settings import EVIDENCE
from usd2kg.words import words_of

__all__ = ["is_generated_name", "texts_of"]

_PRIMITIVES = frozenset(
    ["box", "cube", "sphere", "cylinder", "capsule", "cone", "plane", "torus", "convex", "hull", "poly", "surface"]
)
"""Parts named after a geometric primitive say how a thing was modelled, not what it is."""
_NUMBERED_BOX = re.compile(r"[a-z]_?\d{3,}$", re.IGNORECASE)


def is_generated_name(name: str) -> bool:
    """Return whether a modelling program made the name up from a primitive: `pCube3`, `polySurface12`.

    A `Box_3` may be a box; programs write `Box003`.
    """
    words = words_of(name)
    return _PRIMITIVES.issuperset(words) and bool(
        _NUMBERED_BOX.search(name) if words == ("box",) else name[-1:].isdigit()
    )


def texts_of(view: ObjectView) -> list[tuple[str, str]]:
    """Return (evidence group, text) in the order in which they are asked."""
    texts = [("name", view.name), ("name", view.display_name)]
    texts += [("asset", asset) for asset in view.asset]
    texts += [("labels", label) for label in view.labels]
    texts.append(("documentation", _first_phrase(view.documentation)))
    texts += [("hierarchy", group) for group in reversed(view.groups) if _is_plural(group)]
    texts += [
        ("parts", part) for part in view.parts[: EVIDENCE.max_parts] if not _PRIMITIVES.issuperset(words_of(part))
    ]
    return [(group, text) for group, text in dict.fromkeys(texts) if text]


def _first_phrase(documentation: str) -> str:
    """Return the beginning of a description up to the first mark or relation: `A stool for the bar.` → stool."""
    words: list[str] = []
    for word in documentation.replace("\n", " ").split():
        bare = word.strip(".,;:!?()\"'").lower()
        if words and bare in {"for", "of", "with", "in", "on", "to", "from", "that", "which", "by", "is", "at"}:
            break
        if bare not in {"a", "an", "the", "this", "is", "one", "some"}:
            words.append(bare)
        if word[-1:] in ".,;:!?":
            break
    return " ".join(words[:6])


def _is_plural(name: str) -> bool:
    """Return whether a group is named after what it holds (`mugs`, `wallUnits`) and not after a place."""
    words = words_of(name)
    return bool(words) and load_taxonomy().singular(words[-1]) != words[-1]
