"""From visible triangles to colours: lights, edge lines, transparency, sRGB."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.camera import Camera
from usd2kg.render.raster import Hits, rasterise
from usd2kg.render.settings import LIGHTING
from usd2kg.render.triangle_soup import TriangleSoup, corner_normals
from usd2kg.srgb import srgb_from_linear

__all__ = ["ShadedImage", "draw", "to_srgb"]

Image = NDArray[np.float64]

_KEY_LIGHT, _FILL_LIGHT = (
    np.array(light) / np.linalg.norm(light) for light in (LIGHTING.key_light, LIGHTING.fill_light)
)


class ShadedImage(NamedTuple):
    """An image before it is composited over a background."""

    light: Image
    """(height, width, 3), linear RGB premultiplied by `alpha`."""
    alpha: Image
    """(height, width), 0 to 1."""
    nearness: NDArray[np.float32]
    """(height, width), 1 / metres; 0 where there is nothing."""
    mesh: NDArray[np.int32]
    """(height, width): number of the visible mesh, -1 where there is none."""

    def over(self, background: Image) -> Image:
        """Return the image composited over a background, a colour or an image."""
        return self.light + background * (1 - self.alpha)[..., None]


def draw(camera: Camera, soup: TriangleSoup, *, is_smooth: bool = True) -> ShadedImage:
    """Return the shaded triangles; the nearest transparent surface is blended over the solid ones.

    Without `is_smooth`, triangles are shaded flat, which is faster.
    """
    is_solid = soup.opacity >= 1
    solid = _shade(camera, soup.part(is_solid), is_smooth)
    if is_solid.all():
        return solid
    pane = _shade(camera, soup.part(~is_solid), is_smooth)
    alpha = np.where(pane.nearness > solid.nearness, LIGHTING.transparent_alpha, 0.0)
    return ShadedImage(
        pane.light * alpha[..., None] + solid.light * (1 - alpha[..., None]),
        alpha + solid.alpha * (1 - alpha),
        np.maximum(pane.nearness, solid.nearness),
        np.where(alpha > 0, pane.mesh, solid.mesh),
    )


def _shade(camera: Camera, soup: TriangleSoup, is_smooth: bool) -> ShadedImage:
    hits = rasterise(camera, soup.points, soup.triangles)
    shape = hits.triangle.shape
    light, normals = np.zeros((*shape, 3)), np.zeros((*shape, 3))
    mesh = np.full(shape, -1, np.int32)
    is_hit = hits.triangle >= 0
    if is_hit.any():
        triangle = hits.triangle[is_hit]
        position, rays = _positions(camera, hits, is_hit)
        normal = _normals(camera, soup, triangle, position, is_smooth)
        light[is_hit] = _lit(camera, soup.colors[triangle].astype(np.float64), normal, rays)
        normals[is_hit] = normal
        mesh[is_hit] = soup.mesh[triangle]
        light[_lines(hits.nearness, normals)] *= LIGHTING.line
    return ShadedImage(light, is_hit.astype(np.float64), hits.nearness, mesh)


def _positions(camera: Camera, hits: Hits, is_hit: NDArray[np.bool_]) -> tuple[Image, Image]:
    """Return positions (n, 3) and unit view rays (n, 3) of the hit pixels, in camera axes."""
    y, x = np.nonzero(is_hit)
    rays = camera.rays(x + 0.5, y + 0.5)
    position = rays / hits.nearness[is_hit].astype(np.float64)[:, None]
    return position, rays / np.linalg.norm(rays, axis=1, keepdims=True)


def _normals(
    camera: Camera, soup: TriangleSoup, triangle: NDArray[np.int32], position: Image, is_smooth: bool
) -> Image:
    """Return unit normals (n, 3) in camera axes that face the viewer."""
    visible, which = np.unique(triangle, return_inverse=True)
    which = which.reshape(-1)
    view = camera.to_view(soup.points[soup.triangles[visible]])
    # Right, up and forward form a left-handed frame, which flips the cross product.
    face = np.cross(view[:, 2] - view[:, 0], view[:, 1] - view[:, 0])
    face = (face / np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-30))[which]
    normal = face
    if is_smooth:
        corners = corner_normals(soup.points, soup.triangles, visible)
        normal = np.einsum("ij,ijk->ik", _barycentric(view[which], position), corners[which]) @ camera.axes.T
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    is_back = np.einsum("ij,ij->i", face, position) > 0
    facing: Image = np.where(is_back[:, None], -normal, normal)
    return facing


def _barycentric(corners: Image, position: Image) -> Image:
    """Return the barycentric coordinates (n, 3) of points in their triangles (n, 3, 3)."""
    a = corners[:, 0]
    ab, ac, ap = corners[:, 1] - a, corners[:, 2] - a, position - a
    bb, bc, cc = (np.einsum("ij,ij->i", u, v) for u, v in ((ab, ab), (ab, ac), (ac, ac)))
    pb, pc = np.einsum("ij,ij->i", ap, ab), np.einsum("ij,ij->i", ap, ac)
    determinant = bb * cc - bc * bc
    is_degenerate = determinant <= 1e-30
    safe = np.where(is_degenerate, 1.0, determinant)
    v = np.where(is_degenerate, 0.0, np.clip((cc * pb - bc * pc) / safe, 0, 1))
    w = np.where(is_degenerate, 0.0, np.clip((bb * pc - bc * pb) / safe, 0, 1 - v))
    return np.stack([1 - v - w, v, w], axis=1)


def _lit(camera: Camera, colors: Image, normal: Image, rays: Image) -> Image:
    settings = LIGHTING
    up = camera.axes[:, 2]
    diffuse = settings.ground + (settings.sky - settings.ground) * (0.5 + 0.5 * (normal @ up))
    diffuse += settings.key_intensity * np.maximum(normal @ _KEY_LIGHT, 0)
    diffuse += settings.fill_intensity * np.maximum(normal @ _FILL_LIGHT, 0)
    half = _KEY_LIGHT - rays
    half /= np.maximum(np.linalg.norm(half, axis=1, keepdims=True), 1e-9)
    gloss = settings.gloss * np.maximum(np.einsum("ij,ij->i", normal, half), 0) ** settings.gloss_exponent
    rim = settings.rim * (1 - np.clip(-np.einsum("ij,ij->i", normal, rays), 0, 1)) ** 3
    lit: Image = colors * diffuse[:, None] + (gloss + rim + settings.lift)[:, None]
    return lit


def _lines(nearness: NDArray[np.float32], normals: Image) -> NDArray[np.bool_]:
    """Return the pixels on creases, depth steps and silhouettes."""
    lines = np.zeros(nearness.shape, np.bool_)
    near = nearness.astype(np.float64)
    for axis in (0, 1):
        first, second, inner = (_along(axis, s) for s in (slice(None, -1), slice(1, None), slice(1, -1)))
        cosine = np.einsum("ijk,ijk->ij", normals[first], normals[second])
        lines[first] |= (near[first] > 0) & (near[second] > 0) & (cosine < LIGHTING.crease_cosine)
        # Inverse depth is linear over a plane in image space: its second difference shows steps, not slopes.
        step = np.abs(np.diff(near, n=2, axis=axis)) > LIGHTING.depth_step * near[inner]
        lines[inner] |= step & (near[inner] > 0)
    return lines


def _along(axis: int, part: slice) -> tuple[slice, slice]:
    return (part, slice(None)) if axis == 0 else (slice(None), part)


def to_srgb(light: Image) -> NDArray[np.uint8]:
    """Return linear light as sRGB bytes; highlights are compressed, not clipped."""
    knee = 0.8
    over = np.maximum(light - knee, 0)
    soft = np.where(light > knee, knee + (1 - knee) * over / (over + (1 - knee)), np.maximum(light, 0))
    pixels: NDArray[np.uint8] = np.round(srgb_from_linear(soft) * 255).astype(np.uint8)
    return pixels
