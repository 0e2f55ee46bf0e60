"""Colour of objects, in u2k, USD.owl or KnowRob terms."""

from collections.abc import Iterator
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.graph.physical_properties import aspect_node, declare_individual
from usd2kg.graph.vocabulary import DUL, SOMA, U2K, USD, Triple, text, vector_text
from usd2kg.scene import SceneObject

__all__ = ["knowrob_color", "plain_color", "usd_color"]


class _Color(NamedTuple):
    rgb: tuple[float, float, float]
    source: str


def _color(obj: SceneObject) -> _Color | None:
    """Return the first constant base colour of a material, else the display colour; None if there is neither."""
    for material in obj.material_details:
        if material.base_color is not None:
            return _Color(material.base_color, material.name)
    # A bound material hides the display colour, which is still the best estimate.
    return _Color(obj.display_color, "displayColor") if obj.display_color is not None else None


def plain_color(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield the colour as datatype properties of the object."""
    color = _color(obj)
    if color is not None:
        yield node, U2K.color, text(vector_text(color.rgb))
        yield node, U2K.colorSource, text(color.source)


def usd_color(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield the colour as a USD.owl quality: a JSON array of one colour.

    A plain string, since USD.owl's datatype color3f_array is not OWL 2 DL.
    """
    color = _color(obj)
    if color is not None:
        quality = aspect_node(node, "color")
        yield node, USD.hasColor, quality
        yield from declare_individual(quality, USD.Color)
        yield quality, USD.primvars_displayColor, text(f"[[{', '.join(vector_text(color.rgb).split())}]]")
        yield quality, U2K.colorSource, text(color.source)


def knowrob_color(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield the colour as a SOMA quality with a region, as KnowRob queries it.

    soma:Color is unsatisfiable (SOMA 5d27187 with DUL), so the graph is inconsistent.
    """
    color = _color(obj)
    if color is not None:
        quality, region = aspect_node(node, "color"), aspect_node(node, "rgb")
        yield node, SOMA.hasColor, quality
        yield from declare_individual(quality, SOMA.Color)
        yield quality, DUL.hasRegion, region
        yield from declare_individual(region, SOMA.ColorRegion)
        yield region, SOMA.hasRGBValue, text(vector_text(color.rgb))
        yield region, U2K.colorSource, text(color.source)
