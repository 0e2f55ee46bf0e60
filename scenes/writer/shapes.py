"""Parametric shapes in centimetres, Y up; normals point out of the material."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scenes.writer.mesh import Floats, Mesh, Vec3, merge, mesh_from_faces, moved

Point2 = tuple[float, float]
_THIN = 1.15
"""Ends of thinner wires share the points of the side, since their shading is invisible."""
_BEVELLED = 9.0
"""Cylinders of a smaller radius have no bevel, since it is invisible."""
_CREASE_COS = 0.8
"""Cosine of the largest bend of a profile that is shaded smooth, about 37°."""


def box(low: Vec3, high: Vec3, bevel: float = 0.0) -> Mesh:
    """Return a box between two corners with bevelled edges; normals are those of the sides, so bevels look round."""
    lo, hi = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    centre, half = (lo + hi) / 2, (hi - lo) / 2
    bevel = min(bevel, 0.49 * float((hi - lo).min()))
    signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    points, normals = [], []
    for sign in signs:
        for axis in range(3):
            inset = half - bevel
            inset[axis] = half[axis]
            points.append(centre + inset * sign)
            normals.append(np.eye(3)[axis] * sign[axis])
    faces = _box_sides(signs) + (_box_bevels(signs) if bevel else [])
    return mesh_from_faces(points, normals, [_facing_out(np.array(points), f, centre) for f in faces])


def _box_sides(signs: list[tuple[int, int, int]]) -> list[list[int]]:
    faces = []
    for axis in range(3):
        u, v = [other for other in range(3) if other != axis]
        for side in (-1, 1):
            loop = []
            for pair in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                sign = [0, 0, 0]
                sign[axis], sign[u], sign[v] = side, pair[0], pair[1]
                loop.append(3 * signs.index((sign[0], sign[1], sign[2])) + axis)
            faces.append(loop)
    return faces


def _box_bevels(signs: list[tuple[int, int, int]]) -> list[list[int]]:
    faces = [[3 * corner, 3 * corner + 1, 3 * corner + 2] for corner in range(8)]
    for one in range(8):
        for two in range(one + 1, 8):
            along = [axis for axis in range(3) if signs[one][axis] != signs[two][axis]]
            if len(along) == 1:
                u, v = [axis for axis in range(3) if axis != along[0]]
                faces.append([3 * one + u, 3 * two + u, 3 * two + v, 3 * one + v])
    return faces


def _facing_out(points: Floats, face: list[int], centre: Floats) -> list[int]:
    a, b, c = points[face[0]], points[face[1]], points[face[2]]
    outward = points[face].mean(axis=0) - centre
    return face if float(np.cross(b - a, c - a) @ outward) > 0 else face[::-1]


def round_segments(radius: float) -> int:
    """Return the number of sides with which a circle looks round in a view of a room."""
    steps = ((1.2, 8), (2.6, 10), (5.2, 14), (8.0, 16), (13.0, 18))
    return next((count for limit, count in steps if radius < limit), 22)


def arc(centre: Point2, radius: float, start: float, end: float, steps: int = 4) -> list[Point2]:
    """Return points on a circle in the plane of a profile between two angles in degrees; 0 points outward."""
    angles = np.radians(np.linspace(start, end, steps + 1))
    return [(float(centre[0] + radius * np.cos(a)), float(centre[1] + radius * np.sin(a))) for a in angles]


def lathe(profile: Sequence[Point2], segments: int = 0) -> Mesh:
    """Return a solid of revolution about y.

    Args:
        profile: (radius, height) points with the material on the left: from the centre of the bottom outward,
            up the outside, and back along the inside of a hollow object.
        segments: sides of the rings; by default `round_segments` of the radius.
    """
    outline = np.asarray(profile, dtype=float)
    segments = segments or round_segments(float(outline[:, 0].max()))
    steps = np.diff(outline, axis=0)
    across = np.stack([steps[:, 1], -steps[:, 0]], axis=1)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    points: list[Floats] = []
    normals: list[Floats] = []
    faces: list[list[int]] = []
    below: list[int] = []
    for k in range(len(outline)):
        before, after = across[max(k - 1, 0)], across[min(k, len(across) - 1)]
        smooth = float(before @ after) > _CREASE_COS
        below_normal, above_normal = (before + after, before + after) if smooth else (before, after)
        if k:
            ring = _ring(points, normals, outline[k], below_normal, segments)
            faces += _band(below, ring)
            below = ring
        if k < len(across) and (not k or not smooth):
            below = _ring(points, normals, outline[k], above_normal, segments)
    return mesh_from_faces(np.array(points), np.array(normals), faces)


def _ring(points: list[Floats], normals: list[Floats], at: Floats, normal: Floats, segments: int) -> list[int]:
    start, radius, height = len(points), float(at[0]), float(at[1])
    if radius < 1e-6:
        points.append(np.array([0.0, height, 0.0]))
        normals.append(np.array([0.0, 1.0 if normal[1] > 0 else -1.0, 0.0]))
        return [start]
    normal = normal / np.linalg.norm(normal)
    for angle in 2 * np.pi * np.arange(segments) / segments:
        cos, sin = float(np.cos(angle)), float(np.sin(angle))
        points.append(np.array([radius * cos, height, radius * sin]))
        normals.append(np.array([normal[0] * cos, normal[1], normal[0] * sin]))
    return list(range(start, start + segments))


def _band(below: list[int], above: list[int]) -> list[list[int]]:
    count = max(len(below), len(above))
    if len(below) == len(above) == 1:
        return []
    faces = []
    for j in range(count):
        k = (j + 1) % count
        if len(below) == 1:
            faces.append([below[0], above[j], above[k]])
        elif len(above) == 1:
            faces.append([below[j], above[0], below[k]])
        else:
            faces.append([below[j], above[j], above[k], below[k]])
    return faces


def ellipsoid(centre: Vec3, radii: Vec3, segments: int = 0) -> Mesh:
    """Return an ellipsoid with its axes along x, y and z."""
    segments = segments or max(8, round_segments(max(radii)))
    profile = arc((0, 0), 1, -90, 90, max(4, segments // 2))
    profile[0], profile[-1] = (0.0, -1.0), (0.0, 1.0)
    return moved(lathe(profile, segments), by=centre, scale=radii)


def leaf(length: float, width: float) -> Mesh:
    """Return a folded leaf about the origin along x, with both sides; `length` and `width` are half extents."""
    tip, side = (length, 0.0, 0.0), (0.0, 0.3 * width, width)
    end, other = (-length, 0.0, 0.0), (0.0, 0.3 * width, -width)
    half = [facet([end, side, tip]), facet([tip, other, end])]
    under = [facet([tip, side, end]), facet([end, other, tip])]
    return merge(*half, *under)


def cylinder(base: Vec3, radius: float, height: float, bevel: float = 0.0, segments: int = 0) -> Mesh:
    """Return an upright cylinder standing on `base`."""
    side: list[Point2] = [(radius, 0), (radius, height)]
    if bevel and radius > _BEVELLED:
        side = [(radius - bevel, 0), (radius, bevel), (radius, height - bevel), (radius - bevel, height)]
    return moved(lathe([(0, 0), *side, (0, height)], segments), by=base)


def circle(radius: float, segments: int = 6, flatten: float = 1.0) -> list[Point2]:
    """Return a closed section for `sweep`; `flatten` scales its second axis."""
    angles = 2 * np.pi * np.arange(segments) / segments
    return [(radius * float(np.cos(a)), flatten * radius * float(np.sin(a))) for a in angles]


def sweep(
    path: Sequence[Vec3],
    section: Sequence[Point2],
    widths: Sequence[float] | None = None,
    closed: bool = False,
    up: Vec3 = (0.0, 1.0, 0.0),
) -> Mesh:
    """Return a tube: a counter-clockwise section swept along a path, scaled by `widths` at each point.

    The second axis of the section starts as close to `up` as the path allows.
    """
    line = np.asarray(path, dtype=float)
    tangents = _tangents(line, closed)
    flat, outward, edges = _section(section)
    side, lift = _start_frame(tangents[0], np.asarray(up, dtype=float))
    points, normals = [], []
    for k, (at, tangent) in enumerate(zip(line, tangents, strict=True)):
        lift = lift - tangent * float(lift @ tangent)
        lift /= np.linalg.norm(lift)
        side = np.cross(lift, tangent)
        scale = widths[k] if widths is not None else 1.0
        points.append(at + scale * (flat[:, :1] * side + flat[:, 1:] * lift))
        normals.append(outward[:, :1] * side + outward[:, 1:] * lift)
    rings, size = len(line), len(flat)
    faces = []
    for k in range(rings if closed else rings - 1):
        low, high = k * size, (k + 1) % rings * size
        faces += [[low + i, low + j, high + j, high + i] for i, j in edges]
    tube = mesh_from_faces(np.concatenate(points), np.concatenate(normals), faces)
    if closed:
        return tube
    if float(np.abs(flat).max()) < _THIN:
        ends = [[i for i, _ in edges][::-1], [(rings - 1) * size + i for i, _ in edges]]
        return mesh_from_faces(tube.points, tube.normals, faces + ends)
    caps = [i for i, _ in edges]
    return merge(tube, _cap(points[0][caps], -tangents[0], True), _cap(points[-1][caps], tangents[-1], False))


def _section(section: Sequence[Point2]) -> tuple[Floats, Floats, list[tuple[int, int]]]:
    """Return points, normals and edges of a section; a section of up to four corners has hard edges."""
    flat = np.asarray(section, dtype=float)
    count = len(flat)
    if count > 4:
        outward = flat / np.linalg.norm(flat, axis=1, keepdims=True)
        return flat, outward, [(j, (j + 1) % count) for j in range(count)]
    ends = np.roll(flat, -1, axis=0)
    along = (ends - flat) / np.linalg.norm(ends - flat, axis=1, keepdims=True)
    outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
    doubled = np.stack([flat, ends], axis=1).reshape(-1, 2)
    return doubled, np.repeat(outward, 2, axis=0), [(2 * j, 2 * j + 1) for j in range(count)]


def _tangents(line: Floats, closed: bool) -> Floats:
    raw = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0) if closed else np.gradient(line, axis=0)
    return np.asarray(raw / np.linalg.norm(raw, axis=1, keepdims=True), dtype=float)


def _start_frame(tangent: Floats, up: Floats) -> tuple[Floats, Floats]:
    if abs(float(tangent @ up)) > 0.99 * float(np.linalg.norm(up)):
        up = np.array([0.0, 0.0, 1.0])
    side = np.cross(up, tangent)
    side /= np.linalg.norm(side)
    return side, np.cross(tangent, side)


def _cap(ring: Floats, normal: Floats, reverse: bool) -> Mesh:
    face = list(range(len(ring)))
    return mesh_from_faces(ring, np.tile(normal, (len(ring), 1)), [face[::-1] if reverse else face])


def tube(path: Sequence[Vec3], radius: float, segments: int = 6, closed: bool = False) -> Mesh:
    """Return a round tube along a path."""
    return sweep(path, circle(radius, segments), closed=closed)


def bend(start: Vec3, corner: Vec3, end: Vec3, steps: int = 6) -> list[Vec3]:
    """Return points of the quadratic Bézier curve with these control points."""
    a, b, c = (np.asarray(p, dtype=float) for p in (start, corner, end))
    curve = []
    for t in np.linspace(0, 1, steps + 1):
        p = (1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c
        curve.append((float(p[0]), float(p[1]), float(p[2])))
    return curve


def prism(outline: Sequence[Point2], low: float, high: float) -> Mesh:
    """Return a convex, counter-clockwise outline (x, y) extruded along z, with hard edges."""
    flat = np.asarray(outline, dtype=float)
    count = len(flat)
    front = np.column_stack([flat, np.full(count, high)])
    back = np.column_stack([flat, np.full(count, low)])
    parts = [_cap(front, np.array([0, 0, 1.0]), False), _cap(back, np.array([0, 0, -1.0]), True)]
    for j in range(count):
        k = (j + 1) % count
        edge = flat[k] - flat[j]
        normal = np.array([edge[1], -edge[0], 0.0]) / np.linalg.norm(edge)
        parts.append(mesh_from_faces([back[j], back[k], front[k], front[j]], [normal] * 4, [[0, 1, 2, 3]]))
    return merge(*parts)


def sheet(grid: Floats, thickness: float) -> Mesh:
    """Return a curved sheet given by a (U, V, 3) grid of its front, closed at the rim; d/du × d/dv points outward."""
    du, dv = np.gradient(grid, axis=0), np.gradient(grid, axis=1)
    normal = np.cross(du, dv)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    rows, columns = grid.shape[:2]
    back = grid - thickness * normal
    quads = [
        [i * columns + j, (i + 1) * columns + j, (i + 1) * columns + j + 1, i * columns + j + 1]
        for i in range(rows - 1)
        for j in range(columns - 1)
    ]
    front_side = mesh_from_faces(grid.reshape(-1, 3), normal.reshape(-1, 3), quads)
    back_side = mesh_from_faces(back.reshape(-1, 3), -normal.reshape(-1, 3), [q[::-1] for q in quads])
    both = merge(front_side, back_side)
    if thickness < _THIN:
        around = _border(np.arange(rows * columns).reshape(rows, columns)).tolist()
        pairs = zip(around, [*around[1:], around[0]], strict=True)
        strip = [[i, i + rows * columns, j + rows * columns, j] for i, j in pairs]
        flipped = [[k + rows * columns for k in q[::-1]] for q in quads]
        return mesh_from_faces(both.points, both.normals, quads + flipped + strip)
    return merge(both, _rim(_border(grid), _border(back)))


def _border(grid: NDArray[Any]) -> NDArray[Any]:
    return np.concatenate([grid[:, 0], grid[-1, 1:], grid[-2::-1, -1], grid[0, -2:0:-1]])


def _rim(outer: Floats, inner: Floats) -> Mesh:
    count = len(outer)
    parts = []
    for j in range(count):
        k = (j + 1) % count
        corners = [outer[j], inner[j], inner[k], outer[k]]
        normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
        normal /= np.linalg.norm(normal)
        parts.append(mesh_from_faces(corners, [normal] * 4, [[0, 1, 2, 3]]))
    return merge(*parts)


def panel(size: Vec3, holes: Sequence[tuple[float, float, float, float]], open_back: bool = False) -> Mesh:
    """Return an upright slab (x 0..w, y 0..h, z -d..0, front at z = 0) with rectangular holes (x0, y0, x1, y1).

    `open_back` omits the back and the outer edges except the lower one, which keeps the thickness: with back-face
    culling a camera outside sees through it.
    """
    width, height, depth = size
    xs = sorted({0.0, width, *(v for hole in holes for v in (hole[0], hole[2]))})
    ys = sorted({0.0, height, *(v for hole in holes for v in (hole[1], hole[3]))})
    solid = {
        (i, j)
        for i in range(len(xs) - 1)
        for j in range(len(ys) - 1)
        if not any(h[0] <= xs[i] < h[2] and h[1] <= ys[j] < h[3] for h in holes)
    }
    parts = []
    for i, j in sorted(solid):
        x0, x1, y0, y1 = xs[i], xs[i + 1], ys[j], ys[j + 1]
        parts.append(facet([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]))
        if not open_back:
            parts.append(facet([(x1, y0, -depth), (x0, y0, -depth), (x0, y1, -depth), (x1, y1, -depth)]))
        rim = {
            (i - 1, j): [(x0, y0, -depth), (x0, y0, 0), (x0, y1, 0), (x0, y1, -depth)],
            (i + 1, j): [(x1, y0, 0), (x1, y0, -depth), (x1, y1, -depth), (x1, y1, 0)],
            (i, j - 1): [(x0, y0, -depth), (x1, y0, -depth), (x1, y0, 0), (x0, y0, 0)],
            (i, j + 1): [(x0, y1, 0), (x1, y1, 0), (x1, y1, -depth), (x0, y1, -depth)],
        }
        for beside, corners in rim.items():
            outer = not (0 <= beside[0] < len(xs) - 1 and beside[1] < len(ys) - 1)
            if beside not in solid and not (open_back and outer):
                parts.append(facet(corners))
    return merge(*parts)


def facet(corners: Sequence[Vec3]) -> Mesh:
    """Return one flat face, counter-clockwise seen from outside."""
    a, b, d = (np.asarray(corners[k], dtype=float) for k in (0, 1, -1))
    normal = np.cross(b - a, d - a)
    count = len(corners)
    return mesh_from_faces(corners, [normal / np.linalg.norm(normal)] * count, [list(range(count))])
