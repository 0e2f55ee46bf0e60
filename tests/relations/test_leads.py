"""Cables and hoses are attached to what their ends are in."""

import numpy as np

from tests.graph.records import thing
from tests.relations.room_builder import FLOOR, RULES, TABLE, Placed
from tests.relations.test_surfaces import Room
from tests.shapes.solids import Surface, boxes, surface_of
from usd2kg.relations.leads import _find_ends, _measure_tubes

SIDES = 8


def tube(*path: tuple[float, float, float], radius: float = 0.003) -> Surface:
    """Return a closed tube along a path."""
    points = np.array(path, float)
    angles = np.arange(SIDES) * 2 * np.pi / SIDES
    rings = []
    for here, before, after in zip(points, [points[0], *points[:-1]], [*points[1:], points[-1]], strict=True):
        along = (after - before) / np.linalg.norm(after - before)
        aside = np.cross(along, [0, 1, 0] if abs(along[1]) < 0.9 else [1, 0, 0])
        aside /= np.linalg.norm(aside)
        up = np.cross(along, aside)
        rings.append(here + radius * (np.outer(np.cos(angles), aside) + np.outer(np.sin(angles), up)))
    here, there = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
    faces = []
    for row in range(len(points) - 1):
        low, high = row * SIDES, (row + 1) * SIDES
        faces += [
            np.stack([low + here, low + there, high + there], 1),
            np.stack([low + here, high + there, high + here], 1),
        ]
    first, last = len(points) * SIDES, len(points) * SIDES + 1
    faces.append(
        np.stack([here + (len(points) - 1) * SIDES, there + (len(points) - 1) * SIDES, np.full(SIDES, last)], 1)
    )
    faces.append(np.stack([there, here, np.full(SIDES, first)], 1))
    return surface_of(np.concatenate([*rings, points[:1], points[-1:]]), np.concatenate(faces))


DEVICE: Placed = (thing("/device", (0.1, 0.4, 0.7), (0.2, 0.2, 0.1)), "DesignedArtifact")
PHONE: Placed = (thing("/phone", (0.7, 0.45, 0.7), (0.08, 0.15, 0.012)), "DesignedArtifact")
CABLE = tube((0.29, 0.5, 0.73), (0.4, 0.5, 0.705), (0.5, 0.55, 0.7035), (0.6, 0.5, 0.7035), (0.71, 0.5, 0.706))


def cable(surface: Surface, *placed: Placed) -> set[tuple[str, str]]:
    return Room(FLOOR, TABLE, *placed).mesh("cable", "DesignedArtifact", surface).of("cable")


def test_a_cable_is_attached_to_the_larger_of_the_things_that_it_ends_in():
    assert ("attached-to", "device") in cable(CABLE, DEVICE, PHONE)


def test_a_cable_with_a_loose_end_is_attached_to_nothing():
    assert not {row for row in cable(CABLE, DEVICE) if row[0] == "attached-to"}


def test_a_cable_between_walls_is_no_lead():
    wall = (thing("/wall", (0.1, 0.4, 0.7), (0.2, 0.2, 1.0)), "Wall")
    assert ("attached-to", "phone") not in cable(CABLE, wall, PHONE)


def test_what_is_at_the_end_of_a_hose_does_not_rest_on_it():
    hose = tube((0.29, 0.5, 0.73), (0.5, 0.5, 0.72), (0.55, 0.5, 0.8), (0.55, 0.5, 0.98), radius=0.006)
    shower = (thing("/shower", (0.53, 0.48, 0.977), (0.04, 0.04, 0.2)), "DesignedArtifact")
    room = Room(FLOOR, TABLE, DEVICE, shower).mesh("hose", "DesignedArtifact", hose)
    assert ("on", "hose") not in room.of("shower")


class TestTubes:
    def test_the_length_follows_from_area_and_volume(self):
        corners = CABLE.corners
        (found,) = _measure_tubes([corners], np.array([0.5]), RULES.attached)
        assert found is not None
        assert abs(found.length - 0.455) < 0.05
        assert abs(found.thickness - 0.0055) < 0.0007

    def test_a_rod_that_is_thick_and_a_sheet_are_none(self):
        rod = tube((0, 0, 0), (0.1, 0, 0), (0.2, 0, 0), radius=0.02).corners
        sheet = boxes(((0, 0, 0), (1, 1, 0.001))).corners
        measured = _measure_tubes([rod, CABLE.corners, sheet], np.array([0.2, 0.5, 1.4]), RULES.attached)
        assert [found is None for found in measured] == [True, False, True]

    def test_the_ends_are_at_both_ends(self):
        (found,) = _measure_tubes([CABLE.corners], np.array([0.5]), RULES.attached)
        assert found is not None
        ends = _find_ends(CABLE.corners, found)
        assert ends is not None
        first, last = sorted(float(end[..., 0].mean()) for end in ends)
        assert abs(first - 0.29) < 0.02
        assert abs(last - 0.71) < 0.02
