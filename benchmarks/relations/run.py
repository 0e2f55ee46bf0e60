"""Time the spatial relations on synthetic rooms: tables, shelves, nested boxes, and small objects on and in them.

Usage: python benchmarks/relations/run.py [--meshes | --pile | --tower] [OBJECTS...] (default 1000 10000 100000)

Scenes are built in memory, without a stage. For each size, times each kind alone and the default set, as the minimum of
a few runs, in processor time. All kinds except part-of include `inside` and `on`, on which they depend.

--meshes gives each table, chair, shelf, bowl, cup and plate a mesh instead of a box of 60
to 240 triangles. --pile puts all objects in one heap, in whose boxes they overlap. --tower makes it 30 cm wide and
as high as it gets. `python -m benchmarks.relations.growth` times the default set only, on all of these.
"""

import gc
import math
import random
import sys
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from usd2kg.grounding import Grounding, Prediction, Status
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.relations import ALL_KINDS, DEFAULT_KINDS, VIEWPOINT_KINDS, RelationOptions, Viewpoint, find_relations
from usd2kg.scene import Box, Scene, SceneObject, StageFrame
from usd2kg.shapes.surface import Surface, SurfacePiece

ROOM = 6.0
"""Side length of a room in metres."""
Corner = tuple[float, float, float]


def box_at(lower: Corner, size: Corner) -> Box:
    """Return a box by its lower corner and its size."""
    x, y, z = (low + side for low, side in zip(lower, size, strict=True))
    return Box(lower, (x, y, z))


class Maker:
    """Adds classified objects up to a given number."""

    def __init__(self, wanted: int) -> None:
        self.wanted = wanted
        self.random = random.Random(7)
        self.objects: list[SceneObject] = []
        self.classes: list[str] = []

    def add(self, name: str, cls: str, lower: Corner, size: Corner, parts: tuple[Box, ...] = ()) -> None:
        """Add an object by its lower corner and its size in metres."""
        box = box_at(lower, size)
        known: dict[str, Any] = {"box": box, "own_box": box, "part_boxes": parts}
        blank = dict.fromkeys(("parent_path", "position", "orientation", "mass_kg", "display_color", "instance_of"))
        empty = dict.fromkeys(("asset", "materials", "parts"), ())
        path = f"/World/{name}_{len(self.objects)}"
        texts = {
            "type_name": "Xform",
            "kind": "component",
            "selected_by": "made",
            "display_name": "",
            "documentation": "",
        }
        self.objects.append(SceneObject(prim_path=path, name=name, **blank, **empty, **texts, **known))
        self.classes.append(cls)

    def fill(self, layout: str) -> None:
        """Add room after room, in rows, or a heap."""
        if layout in {"pile", "tower"}:
            side = 0.1 * self.wanted ** (1 / 3)
            self.pile((side, side, side) if layout == "pile" else (0.3, 0.3, 0.01 * self.wanted))
            return
        rooms = 0
        per_row = max(1, math.isqrt(self.wanted // 150))
        while len(self.objects) < self.wanted:
            self.room(rooms % per_row * ROOM, rooms // per_row * ROOM)
            rooms += 1
        del self.objects[self.wanted :], self.classes[self.wanted :]

    def pile(self, space: Corner) -> None:
        """Add a heap of boxes 10 cm long; with one per cubic decimetre, seven overlap each box."""
        for _ in range(self.wanted):
            x, y, z = (self.random.uniform(0, side) for side in space)
            self.add("thing", "DesignedArtifact", (x, y, z), (0.1, 0.1, 0.1))

    def room(self, x: float, y: float) -> None:
        """Add a room with floor, walls, four tables, three shelves and six nests of boxes."""
        self.add("room", "Room", (x, y, 0), (ROOM, ROOM, 2.5))
        self.add("floor", "Floor", (x, y, -0.1), (ROOM, ROOM, 0.1))
        for dx, dy, width, depth in ((0, 0, ROOM, 0.1), (0, ROOM - 0.1, ROOM, 0.1), (0, 0, 0.1, ROOM)):
            self.add("wall", "Wall", (x + dx, y + dy, 0), (width, depth, 2.5))
        for place in range(4):
            self.table(x + 0.8 + place % 2 * 2.4, y + 0.8 + place // 2 * 2.0)
        for place in range(3):
            self.shelf(x + 0.2 + place * 1.4, y + 5.3)
        for place in range(6):
            self.nest(x + 5.2, y + 0.4 + place * 0.8)

    def table(self, x: float, y: float) -> None:
        """Add a table with plates, cups, a tray with a book, a bowl with fruit, and chairs."""
        self.add("table", "Table", (x, y, 0), (1.6, 0.9, 0.75))
        for side in range(4):
            self.add(
                "chair", "DesignedChair", (x + 0.1 + side % 2 * 0.9, y - 0.6 + side // 2 * 1.65, 0), (0.45, 0.45, 0.9)
            )
            plate = (x + 0.15 + side % 2 * 1.0, y + 0.1 + side // 2 * 0.5, 0.75)
            self.add("plate", "DinnerPlate", plate, (0.25, 0.25, 0.02))
            self.add("cup", "Cup", (plate[0] + 0.3, plate[1] + self.random.uniform(0, 0.1), 0.75), (0.08, 0.08, 0.1))
        self.add("tray", "DesignedArtifact", (x + 0.6, y + 0.3, 0.75), (0.4, 0.25, 0.02))
        self.add("book", "DesignedArtifact", (x + 0.62, y + 0.32, 0.77), (0.15, 0.2, 0.03))
        self.add("bowl", "Bowl", (x + 0.78, y + 0.32, 0.77), (0.2, 0.2, 0.1))
        for fruit in range(3):
            self.add("fruit", "DesignedArtifact", (x + 0.79 + fruit * 0.06, y + 0.38, 0.78), (0.06, 0.06, 0.06))
        self.add("lamp", "Appliance", (x + 0.6, y + 0.3, 1.6), (0.4, 0.4, 0.3))

    def shelf(self, x: float, y: float) -> None:
        """Add a shelf of five boards with six books on each."""
        boards = tuple(box_at((x, y, 0.1 + 0.4 * board), (1.2, 0.35, 0.02)) for board in range(5))
        self.add("shelf", "DesignedFurniture", (x, y, 0), (1.2, 0.35, 2.0), boards)
        for board in range(5):
            for place in range(6):
                size = (self.random.uniform(0.03, 0.1), 0.2, self.random.uniform(0.15, 0.3))
                self.add("book", "DesignedArtifact", (x + 0.05 + 0.18 * place, y + 0.05, 0.12 + 0.4 * board), size)

    def nest(self, x: float, y: float) -> None:
        """Add four nested boxes."""
        for depth in range(4):
            side = 0.6 - 0.12 * depth
            self.add("box", "Box", (x + 0.06 * depth, y + 0.06 * depth, 0.03 * depth), (side, side, side))


def boxes_mesh(*boxes: tuple[Corner, Corner]) -> tuple[Any, Any]:
    """Return points and triangles of boxes, given by lower and upper corners in shares of the object's box."""
    ends = np.array(boxes)
    corners = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)])
    points = np.concatenate([np.choose(corners, box) for box in ends])
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return points, np.concatenate([faces + 8 * number for number in range(len(ends))])


def turned_mesh(profile: list[tuple[float, float]], segments: int = 24) -> tuple[Any, Any]:
    """Return points and triangles of a solid of revolution, given by (radius, height) in shares of the object's box."""
    angles = np.arange(segments) * 2 * np.pi / segments
    points = [
        np.stack([0.5 + r / 2 * np.cos(angles), 0.5 + r / 2 * np.sin(angles), np.full(segments, z)], 1)
        for r, z in profile
    ]
    here, after = np.arange(segments), np.roll(np.arange(segments), -1)
    rows = [n * segments for n in range(len(profile) - 1)]
    faces = [np.stack([row + here, row + after, row + segments + after], 1) for row in rows]
    faces += [np.stack([row + here, row + segments + after, row + segments + here], 1) for row in rows]
    return np.concatenate(points), np.concatenate(faces)


LEGS = [((x, y, 0.0), (x + 0.06, y + 0.06, 0.95)) for x in (0.0, 0.94) for y in (0.0, 0.94)]
SHELF = [((0.0, 0.0, 0.05 + 0.2 * board), (1.0, 1.0, 0.06 + 0.2 * board)) for board in range(5)]
VESSEL = [(0.0, 0.0), (0.6, 0.0), (1.0, 1.0), (0.95, 1.0), (0.55, 0.06), (0.0, 0.06)]
MESHES = {
    "table": boxes_mesh(((0.0, 0.0, 0.95), (1.0, 1.0, 1.0)), *LEGS),
    "chair": boxes_mesh(((0.0, 0.0, 0.45), (1.0, 1.0, 0.5)), ((0.0, 0.95, 0.5), (1.0, 1.0, 1.0)), *LEGS),
    "shelf": boxes_mesh(*SHELF, ((0.0, 0.0, 0.0), (0.02, 1.0, 1.0)), ((0.98, 0.0, 0.0), (1.0, 1.0, 1.0))),
    "bowl": turned_mesh(VESSEL),
    "cup": turned_mesh(VESSEL),
    "plate": turned_mesh([(0.0, 0.0), (0.6, 0.0), (1.0, 1.0), (0.6, 0.2), (0.0, 0.2)]),
    "lamp": turned_mesh(VESSEL),
}
"""Name → points in the unit cube and triangles."""


def make_surfaces(objects: list[SceneObject]) -> dict[str, Surface]:
    """Return the meshes of the objects that have one; the points are shared."""
    found = {}
    for obj in objects:
        mesh = MESHES.get(obj.name)
        if mesh is not None and obj.own_box is not None:
            matrix = np.diag([*obj.own_box.size, 1.0])
            matrix[3, :3] = obj.own_box.lower
            found[obj.prim_path] = Surface((SurfacePiece(*mesh, matrix),))
    return found


def make_scene(count: int, tbox: TBox, layout: str) -> tuple[Scene, Grounding]:
    """Return a scene with the given number of objects, and its grounding."""
    maker = Maker(count)
    maker.fill(layout)
    surfaces = make_surfaces(maker.objects) if layout == "meshes" else {}
    iris = {name: tbox.resolve(name) for name in set(maker.classes)}
    predictions = tuple(
        Prediction(obj.prim_path, iris[cls], 1.0, Status.GROUNDED, "made", "made")
        for obj, cls in zip(maker.objects, maker.classes, strict=True)
    )
    frame = StageFrame("Z", 1.0, 1.0, is_authored=True)
    scene = Scene("made", "sha256:0", frame, None, count, tuple(maker.objects), {}, surfaces=surfaces)
    settings = {"regime": "semantic"}
    grounding = Grounding(
        scene="made",
        scene_hash="sha256:0",
        ontology=tbox.ontology_iri,
        ontology_hash=tbox.content_hash,
        grounder="made",
        settings=settings,
        is_calibrated=False,
        tool_version="0",
        predictions=predictions,
    )
    return scene, grounding


def measured(count: int, tbox: TBox, layout: str) -> Iterator[tuple[str, float, int]]:
    """Yield (what, seconds, relations) for each kind and for the default set."""
    scene, grounding = make_scene(count, tbox, layout)
    assert len(grounding.by_path) == count
    chosen = [(kind, (kind,)) for kind in ALL_KINDS if kind not in VIEWPOINT_KINDS]
    for name, kinds in [*chosen, ("sides", VIEWPOINT_KINDS), ("default set", DEFAULT_KINDS)]:
        viewpoint = Viewpoint((0.0, 0.0, 1.6), (1.0, 0.0, 0.0)) if name == "sides" else None
        seconds = []
        for _ in range(5 if count <= 10_000 else 2):
            gc.collect()
            start = time.process_time()
            found = find_relations(scene, tbox, grounding, RelationOptions(tuple(kinds), viewpoint))
            seconds.append(time.process_time() - start)
            relations = len(found)
            del found
        yield name, min(seconds), relations


def exponent(sizes: list[int], seconds: list[float]) -> float:
    """Return the least-squares slope of log seconds over log size: 1 is linear."""
    x, y = [math.log(size) for size in sizes], [math.log(value) for value in seconds]
    middle_x, middle_y = sum(x) / len(x), sum(y) / len(y)
    spread = sum((value - middle_x) ** 2 for value in x)
    return sum((a - middle_x) * (b - middle_y) for a, b in zip(x, y, strict=True)) / spread


def main() -> None:
    """Measure and print a table."""
    layout = next((argument[2:] for argument in sys.argv[1:] if argument.startswith("--")), "boxes")
    sizes = [int(argument) for argument in sys.argv[1:] if argument.isdecimal()] or [1_000, 10_000, 100_000]
    tbox = load_home_tbox()
    columns = [list(measured(size, tbox, layout)) for size in sizes]
    print("| kind | " + " | ".join(f"{size:,} objects, s" for size in sizes) + " | exponent | relations |")
    print("| --- |" + " --- |" * (len(sizes) + 2))
    for row in zip(*columns, strict=True):
        seconds = [value for _, value, _ in row]
        slope = f"{exponent(sizes, seconds):.2f}" if len(sizes) > 1 else "–"
        print(f"| {row[0][0]} | " + " | ".join(f"{value:.3g}" for value in seconds) + f" | {slope} | {row[-1][2]:,} |")


if __name__ == "__main__":
    main()
