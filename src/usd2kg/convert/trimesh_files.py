"""Read files with trimesh: meshes with colours and materials."""

from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from usd2kg.convert.converted import parse_error
from usd2kg.convert.materials import MaterialAuthor, SurfaceMaterial
from usd2kg.convert.prims import PrimAuthor, SourceMesh
from usd2kg.srgb import linear_from_srgb

if TYPE_CHECKING:
    import trimesh

__all__ = ["MeshAuthor", "load_scene", "trimesh_name"]

_MAX_TEXTURE_SIDE = 64
"""Pixels of a side to which a texture is reduced before its mean colour is computed."""


def trimesh_name() -> str:
    """Return name and version of trimesh."""
    return f"trimesh {version('trimesh')}"


def load_scene(path: Path, expected: str, **options: Any) -> "trimesh.Scene":
    """Return the scene of a file, as it is: vertices are not merged.

    Args:
        path: the file.
        expected: what the file should be, for the message of an error.
        options: arguments of trimesh's parser of this format.

    Raises:
        SceneError: trimesh cannot read the file, or it has no triangles.
    """
    import trimesh  # noqa: PLC0415

    try:
        scene = trimesh.load_scene(path, process=False, **options)
    except Exception as error:
        # The parser has no exceptions of its own: a broken file ends in any error of Python or numpy.
        raise parse_error(path, error, expected) from error
    if not any(isinstance(geometry, trimesh.Trimesh) and len(geometry.faces) for geometry in scene.geometry.values()):
        raise parse_error(path, "it holds no triangles", expected)
    return scene


class MeshAuthor:
    """Authors the meshes of a scene with their materials."""

    def __init__(self, author: PrimAuthor, root: str, materials: MaterialAuthor | None = None) -> None:
        """Keep materials in a scope below the path `root`, or with those of `materials`."""
        self._author = author
        self._materials = MaterialAuthor(author, root) if materials is None else materials
        self._read: dict[int, SourceMesh] = {}

    def define(self, parent: str, name: str, geometry: "trimesh.Trimesh") -> Any:
        """Return the prim of a mesh below the path `parent`."""
        mesh = self._read.get(id(geometry))
        if mesh is None:
            is_per_point = getattr(geometry.visual, "kind", None) == "vertex"
            colors = _colors(geometry)
            mesh = SourceMesh(geometry.vertices, geometry.faces, colors, is_per_point=is_per_point)
            self._read[id(geometry)] = mesh
        prim = self._author.define_mesh(parent, name, mesh)
        material = _material(geometry)
        if material is not None:
            self._materials.bind(prim, material)
        return prim


def _colors(geometry: "trimesh.Trimesh") -> NDArray[np.float64] | None:
    """Return linear RGB: per vertex, per face, or of the material; None if the file states none."""
    visual: Any = geometry.visual
    if visual.kind == "vertex":
        return np.asarray(visual.vertex_colors[:, :3], np.float64) / 255
    if visual.kind == "face":
        return np.asarray(visual.face_colors[:, :3], np.float64) / 255
    material = getattr(visual, "material", None)
    factor, image = _base_color(material), _texture(material)
    texture = None if image is None else _mean_color(image)
    if factor is None and texture is None:
        return None
    product = np.ones(3) if factor is None else np.array(factor)
    return (product if texture is None else product * texture)[None]


def _base_color(material: Any) -> tuple[float, float, float] | None:
    factor = getattr(material, "baseColorFactor", getattr(material, "diffuse", None))
    if factor is None or len(factor) < 3:
        return None
    red, green, blue = (float(value) / 255 for value in factor[:3])
    return red, green, blue


def _texture(material: Any) -> Any:
    """Return the image of the base colour, or None."""
    return getattr(material, "baseColorTexture", getattr(material, "image", None))


def _opacity(material: Any) -> float | None:
    """Return the opacity of a material whose alpha counts: glTF ignores alpha unless the mode is BLEND."""
    factor = getattr(material, "baseColorFactor", None)
    if factor is None or len(factor) < 4 or getattr(material, "alphaMode", None) != "BLEND":
        return None
    return float(factor[3]) / 255


def _mean_color(image: Any) -> NDArray[np.float64]:
    """Return the mean colour of a texture, linear RGB."""
    small = image.convert("RGB")
    small.thumbnail((_MAX_TEXTURE_SIDE, _MAX_TEXTURE_SIDE))
    linear = linear_from_srgb(np.asarray(small, np.float64) / 255)
    mean: NDArray[np.float64] = linear.reshape(-1, 3).mean(axis=0)
    return mean


def _material(geometry: "trimesh.Trimesh") -> SurfaceMaterial | None:
    """Return the material of a mesh; None without a name, since an exporter then made it up."""
    material = getattr(geometry.visual, "material", None)
    name = getattr(material, "_name", None) or getattr(material, "_data", {}).get("name")
    if material is None or not isinstance(name, str):
        return None
    return SurfaceMaterial(
        name,
        color=None if _texture(material) is not None else _base_color(material),
        opacity=_opacity(material),
        roughness=_number(getattr(material, "roughnessFactor", None)),
        metallic=_number(getattr(material, "metallicFactor", None)),
    )


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) else None
