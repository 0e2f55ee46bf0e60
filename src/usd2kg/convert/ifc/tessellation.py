"""Tessellate the products of an IFC file with IfcOpenShell, in metres."""

import os
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.convert.prims import SourceMesh
from usd2kg.srgb import linear_from_srgb

__all__ = ["NOT_PHYSICAL", "Shape", "instances_of", "tessellate"]

NOT_PHYSICAL = ("IfcFeatureElementSubtraction", "IfcAnnotation", "IfcGrid", "IfcVirtualElement", "IfcPort")
"""Classes that are not physical objects: openings are cut out of walls, the others are not solids."""


class Shape(NamedTuple):
    """The triangles of a product."""

    mesh: SourceMesh
    """In the frame of the product, metres."""
    matrix: NDArray[np.float64]
    """(4, 4), from that frame to the world, for column vectors."""


def tessellate(model: Any) -> Iterator[tuple[int, Shape]]:
    """Yield (STEP id, shape) of each product with a surface, in no particular order."""
    import ifcopenshell.geom  # noqa: PLC0415

    classes = {name for name in NOT_PHYSICAL if instances_of(model, name) is not None}
    settings = ifcopenshell.geom.settings()
    # Use only colours stated in the file.
    settings.set("apply-default-materials", False)
    iterator = ifcopenshell.geom.iterator(settings, model, os.cpu_count() or 1, exclude=sorted(classes))
    is_open = iterator.initialize()
    while is_open:
        found = iterator.get()
        mesh = _mesh(found.geometry)
        if len(mesh.triangles):
            yield found.id, Shape(mesh, np.array(found.transformation.matrix, np.float64).reshape(4, 4).T)
        is_open = bool(iterator.next())


def instances_of(model: Any, name: str) -> list[Any] | None:
    """Return the entities of a class and its subclasses; None if the schema of the file does not have the class."""
    try:
        return list(model.by_type(name))
    except RuntimeError:
        return None


def _mesh(geometry: Any) -> SourceMesh:
    styles = [_color(style) for style in geometry.materials]
    # Triangles without a style have the id -1.
    ids = np.array(geometry.material_ids, np.int64)
    colors = np.array(styles)[ids] if styles and (ids >= 0).all() else None
    return SourceMesh(geometry.verts, geometry.faces, colors)


def _color(style: Any) -> tuple[float, float, float]:
    """Return the diffuse colour of a style, linear RGB.

    IfcColourRgb names no colour space; the programs that write it take the values from sRGB colour pickers.
    """
    diffuse = style.diffuse
    red, green, blue = linear_from_srgb([diffuse.r(), diffuse.g(), diffuse.b()]).tolist()
    return red, green, blue
