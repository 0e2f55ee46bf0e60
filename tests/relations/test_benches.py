"""What hangs at the back of a bench, and what stands in its compartments."""

from tests.relations.test_surfaces import Room, flat
from tests.shapes.solids import Span, boxes, turned

BACK: Span = ((2, 4.74, 0.9), (3.2, 4.76, 1.7))
"""A board, 4 cm in front of the wall."""
LEVELS: tuple[Span, ...] = (((2, 4.2, 0.85), (3.2, 4.76, 0.9)), ((2, 4.2, 1.7), (3.2, 4.76, 1.73)))
"""The worktop, and a shelf on top."""
POSTS: tuple[Span, ...] = tuple(((x, 4.66, 0), (x + 0.05, 4.74, 1.7)) for x in (2, 3.15))
SIDES: tuple[Span, ...] = tuple(((x, 4.2, 0.9), (x + 0.05, 4.74, 1.7)) for x in (2, 3.15))
SAW = boxes(((2.3, 4.72, 1.2), (2.8, 4.739, 1.35)))


def bench(*sides: Span) -> Room:
    return flat().mesh("bench", "Table", boxes(BACK, *LEVELS, *sides))


def test_a_saw_between_the_posts_of_a_bench_hangs_at_its_back_and_not_in_it():
    # The wall behind the board is within reach as well.
    assert bench(*POSTS).mesh("saw", "CuttingTool", SAW).of("saw") == {("attached-to", "bench")}


def test_a_saw_between_the_sides_of_a_bench_is_in_its_compartment():
    assert bench(*SIDES).mesh("saw", "CuttingTool", SAW).of("saw") == {("inside", "bench")}


def test_a_box_as_deep_as_the_sides_of_a_bench_is_in_its_compartment():
    tin = boxes(((2.3, 4.3, 0.9), (2.8, 4.7, 1.3)))
    assert bench(*SIDES).mesh("tin", "DesignedArtifact", tin).of("tin") == {("inside", "bench")}


def test_the_wall_holds_what_is_beside_the_bench():
    saw = boxes(((3.22, 4.72, 1.2), (3.7, 4.76, 1.35)))
    assert bench(*POSTS).mesh("saw", "CuttingTool", saw).of("saw") == {("attached-to", "walls")}


def test_the_wall_holds_what_also_touches_a_thing_at_its_side():
    room = bench(*POSTS).mesh("clock", "DesignedArtifact", boxes(((3.205, 4.7, 1.2), (3.4, 4.76, 1.4))))
    assert room.of("clock") == {("attached-to", "walls")}


def test_a_mug_is_in_a_basin_whose_faces_point_away_from_it():
    outwards = turned((0.0, 0.7), (0.2, 0.7), (0.2, 0.9), at=(3, 2, 0))
    room = (
        flat()
        .mesh("basin", "Sink", outwards)
        .mesh("mug", "Cup", turned((0.0, 0.705), (0.04, 0.705), (0.04, 0.8), at=(3, 2, 0)))
    )
    assert room.of("mug") == {("inside", "basin")}


def test_a_mug_within_the_material_of_a_block_is_not_in_it():
    room = flat().mesh("basin", "Sink", boxes(((2.8, 1.8, 0.7), (3.2, 2.2, 0.9))))
    room.mesh("mug", "Cup", turned((0.0, 0.72), (0.04, 0.72), (0.04, 0.82), at=(3, 2, 0)))
    assert ("inside", "basin") not in room.of("mug")
