"""From what is hit to how bright it looks: light, contact shade, lines and glass."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.camera import Camera, aim
from usd2kg.render.raster import Hits, rasterise
from usd2kg.render.soup import Soup, corner_normals

__all__ = ["Picture", "blur", "cast_shadow", "draw", "to_srgb"]

Image = NDArray[np.float64]

_KEY_LIGHT = np.array([-0.5, 0.75, -0.9]) / np.linalg.norm([-0.5, 0.75, -0.9])
"""Over the viewer's left shoulder, in the eye's axes (right, up, forward)."""
_FILL_LIGHT = np.array([0.9, 0.1, -0.5]) / np.linalg.norm([0.9, 0.1, -0.5])
_SKY, _GROUND = 0.45, 0.25
_THINNEST_GLASS = 0.22
_LINE = 0.42
"""How much of the light an edge line leaves."""
_CREASE = 0.85
_SHADOW_SIZE = 128


class Picture(NamedTuple):
    """A drawing before it is put on a background."""

    light: Image
    """(height, width, 3), linear RGB, times `cover`."""
    cover: Image
    """(height, width): 1 where something solid is, 0 where the background is seen."""
    mesh: NDArray[np.int32]
    """(height, width): number of the mesh seen, glass included; -1 where there is none."""

    def over(self, background: Image) -> Image:
        """Return the drawing on a background, a colour or an image."""
        return self.light + background * (1 - self.cover)[..., None]


class _Layer(NamedTuple):
    light: Image
    alpha: Image
    nearness: NDArray[np.float32]
    mesh: NDArray[np.int32]


def draw(camera: Camera, soup: Soup, *, is_smooth: bool = True) -> Picture:
    """Return how the triangles look; of glass, the nearest pane is drawn over what is solid.

    Without `is_smooth` round things have facets, which is quicker.
    """
    is_solid = soup.opacity >= 1
    solid = _layer(camera, soup.part(is_solid), is_smooth)
    light, cover, mesh = solid.light * solid.alpha[..., None], solid.alpha, solid.mesh
    if not is_solid.all():
        glass = _layer(camera, soup.part(~is_solid), is_smooth)
        alpha = np.where(glass.nearness > solid.nearness, glass.alpha, 0.0)
        light = glass.light * alpha[..., None] + light * (1 - alpha[..., None])
        cover = alpha + cover * (1 - alpha)
        mesh = np.where(alpha > 0, glass.mesh, mesh)
    return Picture(light, cover, mesh)


def _layer(camera: Camera, soup: Soup, is_smooth: bool) -> _Layer:
    hits = rasterise(camera, soup.points, soup.triangles)
    shape = hits.triangle.shape
    light, normals = np.zeros((*shape, 3)), np.zeros((*shape, 3))
    alpha, mesh = np.zeros(shape), np.full(shape, -1, np.int32)
    seen = hits.triangle >= 0
    if seen.any():
        triangle = hits.triangle[seen]
        position, rays = _positions(camera, hits, seen)
        normal = _normals(camera, soup, triangle, position, is_smooth)
        # Edges of glass catch the light, so that a glass is seen by its outline.
        rim = 1 - np.abs(np.einsum("ij,ij->i", normal, rays))
        opacity = soup.opacity[triangle].astype(np.float64)
        alpha[seen] = np.where(opacity < 1, np.maximum(opacity, _THINNEST_GLASS) + 0.5 * rim**2 * (1 - opacity), 1.0)
        light[seen] = _lit(camera, soup.colors[triangle].astype(np.float64), normal, rays)
        normals[seen] = normal
        mesh[seen] = soup.mesh[triangle]
        light *= _contact_shade(hits.nearness, camera.focal)[..., None]
        lines = _lines(hits.nearness, normals)
        light[lines] *= _LINE
        alpha[lines & seen] = np.maximum(alpha[lines & seen], 0.6)
    return _Layer(light, np.clip(alpha, 0, 1), hits.nearness, mesh)


def _positions(camera: Camera, hits: Hits, seen: NDArray[np.bool_]) -> tuple[Image, Image]:
    """Return where the seen pixels are (n, 3) and the unit directions they are seen along, in the eye's axes."""
    y, x = np.nonzero(seen)
    rays = camera.rays(x + 0.5, y + 0.5)
    position = rays / hits.nearness[seen].astype(np.float64)[:, None]
    return position, rays / np.linalg.norm(rays, axis=1, keepdims=True)


def _normals(camera: Camera, soup: Soup, triangle: NDArray[np.int32], position: Image, is_smooth: bool) -> Image:
    """Return unit normals in the eye's axes that face the viewer."""
    visible, which = np.unique(triangle, return_inverse=True)
    which = which.reshape(-1)
    view = camera.to_view(soup.points[soup.triangles[visible]])
    # Right, up and forward make a left-handed frame, which turns a cross product round.
    face = np.cross(view[:, 2] - view[:, 0], view[:, 1] - view[:, 0])
    face = (face / np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-30))[which]
    normal = face
    if is_smooth:
        corners = corner_normals(soup.points, soup.triangles, visible)
        normal = np.einsum("ij,ijk->ik", _shares(view[which], position), corners[which]) @ camera.axes.T
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    is_away = np.einsum("ij,ij->i", face, position) > 0
    facing: Image = np.where(is_away[:, None], -normal, normal)
    return facing


def _shares(corners: Image, position: Image) -> Image:
    """Return how much of each corner (n, 3) there is in a point of a triangle (barycentric coordinates)."""
    a = corners[:, 0]
    ab, ac, ap = corners[:, 1] - a, corners[:, 2] - a, position - a
    bb, bc, cc = (np.einsum("ij,ij->i", u, v) for u, v in ((ab, ab), (ab, ac), (ac, ac)))
    pb, pc = np.einsum("ij,ij->i", ap, ab), np.einsum("ij,ij->i", ap, ac)
    below = bb * cc - bc * bc
    safe = np.where(below > 1e-30, below, 1.0)
    v = np.where(below > 1e-30, np.clip((cc * pb - bc * pc) / safe, 0, 1), 0.0)
    w = np.where(below > 1e-30, np.clip((bb * pc - bc * pb) / safe, 0, 1 - v), 0.0)
    return np.stack([1 - v - w, v, w], axis=1)


def _lit(camera: Camera, colors: Image, normal: Image, rays: Image) -> Image:
    up = camera.axes[:, 2]
    sky = 0.5 + 0.5 * (normal @ up)
    diffuse = _GROUND + (_SKY - _GROUND) * sky
    diffuse += 0.62 * np.maximum(normal @ _KEY_LIGHT, 0) + 0.1 * np.maximum(normal @ _FILL_LIGHT, 0)
    # A little gloss and rim light: black plastic and steel have a shape by these alone.
    half = _KEY_LIGHT - rays
    half /= np.maximum(np.linalg.norm(half, axis=1, keepdims=True), 1e-9)
    gloss = 0.10 * np.maximum(np.einsum("ij,ij->i", normal, half), 0) ** 30
    rim = 0.05 * (1 - np.clip(-np.einsum("ij,ij->i", normal, rays), 0, 1)) ** 3
    lit: Image = colors * diffuse[:, None] + (gloss + rim + 0.012)[:, None]
    return lit


def _contact_shade(nearness: NDArray[np.float32], focal: float) -> Image:
    """Return how much light is left (height, width) where the surface is hollow: in corners and under things.

    At each pixel the mean of two opposite neighbours is compared: 1 / depth is linear over a plane in the picture, so
    that planes stay as they are, however they slope.
    """
    coarse = nearness[::2, ::2].astype(np.float64)
    safe = np.where(coarse > 0, coarse, 1.0)
    widest = max(2, min(coarse.shape) // 24)
    padded = np.pad(coarse, widest, mode="edge")
    height, width = coarse.shape
    dark = np.zeros(coarse.shape)
    for radius in {max(1, widest // 3), widest}:
        reach = 2 * radius / focal
        for y, x in ((0, radius), (radius, 0), (radius * 5 // 7, radius * 5 // 7), (radius * 5 // 7, -radius * 5 // 7)):
            one, other = (
                padded[widest + sign * y :, widest + sign * x :][:height, :width] / safe - 1 for sign in (1, -1)
            )
            # What is much nearer stands in front and has nothing to do with the surface.
            is_beside = (np.maximum(one, other) < 4 * reach) & (coarse > 0)
            dark += np.where(is_beside, np.clip((one + other) / 2 / reach, 0, 1), 0.0)
    light = 1 - 0.6 * blur(np.minimum(dark / 4, 1), max(1, widest // 4))
    return light.repeat(2, axis=0).repeat(2, axis=1)[: nearness.shape[0], : nearness.shape[1]]


def blur(image: Image, radius: int) -> Image:
    """Return the image (height, width) smoothed: two passes of a box, a hat in each direction."""
    for _ in range(2):
        for axis in (0, 1):
            border = [(radius + 1, radius) if i == axis else (0, 0) for i in range(2)]
            total = np.cumsum(np.pad(image, border), axis=axis)
            size = image.shape[axis]
            high = np.take(total, np.arange(2 * radius + 1, 2 * radius + 1 + size), axis=axis)
            image = (high - np.take(total, np.arange(size), axis=axis)) / (2 * radius + 1)
    return image


def _lines(nearness: NDArray[np.float32], normals: Image) -> NDArray[np.bool_]:
    """Return the pixels on creases, steps in depth and outlines."""
    lines = np.zeros(nearness.shape, np.bool_)
    near = nearness.astype(np.float64)
    for axis in (0, 1):
        here, after = (slice(None, -1), slice(1, None))
        first = (here, slice(None)) if axis == 0 else (slice(None), here)
        second = (after, slice(None)) if axis == 0 else (slice(None), after)
        turn = np.einsum("ijk,ijk->ij", normals[first], normals[second])
        both = (near[first] > 0) & (near[second] > 0)
        lines[first] |= both & (turn < _CREASE)
        # 1 / depth is linear over a plane in the picture: its second difference shows steps, not slopes.
        middle = near[1:-1] if axis == 0 else near[:, 1:-1]
        bend = np.abs(np.diff(near, n=2, axis=axis)) > 0.012 * middle
        inner = (slice(1, -1), slice(None)) if axis == 0 else (slice(None), slice(1, -1))
        lines[inner] |= bend & (middle > 0)
    return lines


def cast_shadow(camera: Camera, soup: Soup, points: NDArray[np.float32]) -> Image:
    """Return how dark the ground under an object is at each pixel (height, width), 0 where no ground is seen.

    The object is looked at from below: what is near the ground darkens it, softly.
    """
    below = aim(points, -90.0, -90.0, (_SHADOW_SIZE, _SHADOW_SIZE), margin=0.3)
    nearness = rasterise(below, soup.points, soup.triangles).nearness
    floor, extent = float(points[:, 2].min()), float(np.ptp(points, axis=0).max())
    hit = nearness > 0
    height = below.eye[2] + 1 / np.where(hit, nearness, 1) - floor
    dark = np.where(hit, np.exp(-np.maximum(height, 0) / max(0.2 * extent, 1e-9)), 0.0)
    soft = 0.38 * blur(dark, 3) + 0.26 * blur(dark, 12)
    y, x = np.mgrid[0 : camera.height, 0 : camera.width] + 0.5
    rays = camera.rays(x, y) @ camera.axes
    is_down = rays[..., 2] < -1e-6
    ground = camera.eye + rays * ((floor - camera.eye[2]) / np.where(is_down, rays[..., 2], -1))[..., None]
    place = below.to_pixels(below.to_view(ground)) - 0.5
    return np.where(is_down, _between(soft, place[..., 1], place[..., 0]), 0.0)


def _between(image: Image, row: Image, column: Image) -> Image:
    """Return the image at places between its pixels; its border beyond them."""
    row, column = (np.clip(place, 0, _SHADOW_SIZE - 1.001) for place in (row, column))
    top, left = row.astype(np.int64), column.astype(np.int64)
    down, along = row - top, column - left
    upper = image[top, left] * (1 - along) + image[top, left + 1] * along
    lower = image[top + 1, left] * (1 - along) + image[top + 1, left + 1] * along
    blend: Image = upper * (1 - down) + lower * down
    return blend


def to_srgb(light: Image) -> NDArray[np.uint8]:
    """Return linear light as sRGB bytes (IEC 61966-2-1); what is too bright is rolled off, not cut."""
    knee = 0.8
    over = np.maximum(light - knee, 0)
    soft = np.where(light > knee, knee + (1 - knee) * over / (over + (1 - knee)), np.maximum(light, 0))
    curve = np.where(soft <= 0.0031308, soft * 12.92, 1.055 * np.maximum(soft, 1e-9) ** (1 / 2.4) - 0.055)
    pixels: NDArray[np.uint8] = np.round(np.clip(curve, 0, 1) * 255).astype(np.uint8)
    return pixels
