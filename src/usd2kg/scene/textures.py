"""Base-colour textures: which image a material shows, where it lies on a mesh, and the bytes of its file."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Ar, Tf, Usd, UsdGeom, UsdShade

from usd2kg.errors import SceneError
from usd2kg.scene.model import Vector

__all__ = ["Texture", "TextureMapping", "find_texture", "read_corner_uv", "read_texture_file"]

_WHITE: Vector = (1.0, 1.0, 1.0)


class Texture(NamedTuple):
    """An image that is the base colour of a material."""

    name: str
    """The path as it is authored, for messages."""
    file: str
    """Path resolved by OpenUSD's asset resolver, possibly inside a package; empty if the file is missing."""
    wrap: tuple[str, str]
    """Wrap modes along u and v: `repeat`, `mirror`, `clamp` or `black`."""
    scale: Vector
    """Scale of the linear RGB."""


class TextureMapping(NamedTuple):
    """A texture and its place on a mesh: (u, v) = st @ `matrix` + `offset`."""

    texture: Texture
    primvar: str
    """Name of the primvar st."""
    matrix: NDArray[np.float64]
    """(2, 2), for row vectors."""
    offset: NDArray[np.float64]
    """(2,)."""


def find_texture(shader: Any, inputs: Iterable[str], time: Usd.TimeCode) -> TextureMapping | None:
    """Return the UsdUVTexture that is connected to the first of some inputs of a shader; None if there is none."""
    for name in inputs:
        source = _connected(shader, name)
        if source is not None and source.GetShaderId() == "UsdUVTexture":
            return _read_texture(source, time)
    return None


def _read_texture(shader: Any, time: Usd.TimeCode) -> TextureMapping | None:
    asset = _value(shader, "file", time)
    if asset is None or not hasattr(asset, "resolvedPath"):
        return None
    wrap = tuple(str(_value(shader, name, time) or "repeat") for name in ("wrapS", "wrapT"))
    scale = _value(shader, "scale", time)
    factor = _WHITE if scale is None else tuple(min(max(float(part), 0.0), 1.0) for part in tuple(scale)[:3])
    texture = Texture(str(asset.path), str(asset.resolvedPath), (wrap[0], wrap[1]), (factor[0], factor[1], factor[2]))
    primvar, matrix, offset = _read_coordinates(_connected(shader, "st"), time)
    return TextureMapping(texture, primvar, matrix, offset)


def _read_coordinates(shader: Any, time: Usd.TimeCode) -> tuple[str, NDArray[np.float64], NDArray[np.float64]]:
    """Return primvar, matrix and offset of the source of texture coordinates: a reader of a primvar, or a transform."""
    matrix, offset = np.eye(2), np.zeros(2)
    if shader is not None and shader.GetShaderId() == "UsdTransform2d":
        angle = math.radians(_value(shader, "rotation", time) or 0.0)
        scale = np.array(_value(shader, "scale", time) or (1, 1), np.float64)
        # UsdPreviewSurface specification: in * scale * rotate + translation, counter-clockwise.
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        matrix, offset = np.diag(scale) @ turn, np.array(_value(shader, "translation", time) or (0, 0), np.float64)
        shader = _connected(shader, "in")
    name = _value(shader, "varname", time) if shader is not None else None
    return str(name or "st"), matrix, offset


def _connected(shader: Any, name: str) -> Any:
    """Return the shader whose output is connected to an input, also through a node graph; None if there is none."""
    source = shader.GetInput(name)
    for attribute in source.GetValueProducingAttributes() if source else ():
        if UsdShade.Utils.GetType(attribute.GetName()) == UsdShade.AttributeType.Output:
            return UsdShade.Shader(attribute.GetPrim())
    return None


def _value(shader: Any, name: str, time: Usd.TimeCode) -> Any:
    """Return the value of an input, also through the interface of its material; None without a value."""
    source = shader.GetInput(name)
    attributes = source.GetValueProducingAttributes() if source else ()
    return attributes[0].Get(time) if attributes else None


def read_corner_uv(
    prim: Any, mapping: TextureMapping, points: NDArray[np.int32], corners: NDArray[np.int64], time: Usd.TimeCode
) -> NDArray[np.float32] | None:
    """Return texture coordinates (m, 3, 2) at the corners of triangles; None if the mesh has none that fit.

    Args:
        prim: the mesh.
        mapping: the texture and its primvar.
        points: (m, 3), the point of each corner.
        corners: (m, 3), the face vertex of each corner.
        time: time code.
    """
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(mapping.primvar)
    if not primvar or not primvar.HasValue():
        return None
    try:
        values = np.asarray(primvar.ComputeFlattened(time), np.float64)
    except (Tf.ErrorException, TypeError, ValueError):
        return None
    at = corners if primvar.GetInterpolation() == UsdGeom.Tokens.faceVarying else points
    is_fitting = primvar.GetInterpolation() in {
        UsdGeom.Tokens.faceVarying,
        UsdGeom.Tokens.vertex,
        UsdGeom.Tokens.varying,
    }
    if not is_fitting or values.shape[1:] != (2,) or not len(at) or at.max() >= len(values):
        return None
    coordinates: NDArray[np.float32] = (values @ mapping.matrix + mapping.offset)[at].astype(np.float32)
    return coordinates if np.isfinite(coordinates).all() else None


def read_texture_file(texture: Texture, max_bytes: int) -> bytes:
    """Return the bytes of an image that OpenUSD has resolved, from a file or from inside a package.

    Raises:
        SceneError: it is missing, not a regular file, too large, or unreadable.
    """
    outer = Ar.SplitPackageRelativePathOuter(texture.file)[0] if texture.file else ""
    # Reading a device or a pipe would not end.
    if not outer or (not Path(outer).is_file() and "://" not in outer):
        raise SceneError("the file is missing" if not outer else "it is not a file")
    try:
        asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(texture.file))
        if asset is None:
            raise SceneError("the file cannot be opened")
        if asset.GetSize() > max_bytes:
            raise SceneError(f"the file has {asset.GetSize():,} bytes, expected at most {max_bytes:,}")
        return bytes(asset.GetBuffer())
    except (Tf.ErrorException, OSError) as error:
        raise SceneError("the file cannot be read") from error
