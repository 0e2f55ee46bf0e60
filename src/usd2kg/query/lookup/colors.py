"""Colours and materials in words."""

import colorsys
from typing import NamedTuple

from usd2kg.knowledge import word_map, word_set
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.srgb import srgb_from_linear
from usd2kg.words import split_identifier

__all__ = ["COLORS", "color_name", "has_color", "has_material", "is_material", "material_words", "own_colors"]

_MATERIALS = word_map("query", "substances")
"""Word in the name of a material → the substance: oak → wood."""
_SUBSTANCES = word_set("query", "substance_names")
_COLOR_WORDS = word_map("query", "color_words")
"""Word in the name of a material → the colour: navy → blue."""


class _Hue(NamedTuple):
    name: str
    until: float
    """Degrees."""


_HUES = (
    _Hue("red", 15),
    _Hue("orange", 40),
    _Hue("yellow", 70),
    _Hue("green", 165),
    _Hue("blue", 260),
    _Hue("purple", 300),
    _Hue("pink", 340),
    _Hue("red", 361),
)
COLORS = frozenset([*(hue.name for hue in _HUES), "black", "white", "grey", "gray", "brown", "beige"])
"""Names of colours that can be asked for."""


def color_name(rgb: tuple[float, float, float]) -> str:
    """Return the basic colour term of a linear RGB colour, by hue, saturation and lightness after sRGB encoding.

    >>> color_name((0.58, 0.05, 0.04)), color_name((0.9, 0.9, 0.9)), color_name((0.1, 0.05, 0.02))
    ('red', 'white', 'brown')
    """
    encoded = srgb_from_linear(rgb).tolist()
    hue, lightness, saturation = colorsys.rgb_to_hls(*encoded)
    chroma = max(encoded) - min(encoded)
    if chroma < 0.1:
        return "black" if lightness < 0.25 else "white" if lightness > 0.85 else "grey"
    if lightness < 0.1:
        return "black"
    name = next(one.name for one in _HUES if hue * 360 < one.until)
    if name in {"orange", "yellow"} and (lightness < 0.45 or saturation < 0.4):
        return "brown" if lightness < 0.65 else "beige"
    return name


def own_colors(facts: SceneFacts, iri: str) -> list[str]:
    """Return the colours of an object, the main one first: from its material's name, else from its colour."""
    words = [word.lower() for word in split_identifier(facts.color_source(iri))]
    named = [_COLOR_WORDS.get(word, word) for word in words if word in COLORS or word in _COLOR_WORDS]
    if named:
        return named
    rgb = facts.color(iri)
    return [color_name(rgb)] if rgb is not None else []


def has_color(facts: SceneFacts, iri: str, color: str) -> bool:
    """Return whether the main colour of an object is a colour."""
    return own_colors(facts, iri)[:1] == ["grey" if color == "gray" else color]


def material_words(facts: SceneFacts, iri: str) -> list[str]:
    """Return the substances that the names of an object's materials mean."""
    words = [word.lower() for name in facts.materials(iri) for word in split_identifier(name)]
    return list(
        dict.fromkeys(_MATERIALS.get(word, word) for word in words if word in _MATERIALS or word in _SUBSTANCES)
    )


def is_material(word: str) -> bool:
    """Return whether a word is a substance or an adjective of one."""
    return word in _SUBSTANCES or word in _MATERIALS


def has_material(facts: SceneFacts, iri: str, word: str) -> bool:
    """Return whether an object has a material of a substance."""
    return _MATERIALS.get(word, word) in material_words(facts, iri)
