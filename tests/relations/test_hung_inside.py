"""Hangers in a wardrobe hang on its rail, although they are inside the wardrobe as well."""

from tests.relations.room_builder import FLOOR
from tests.relations.test_surfaces import Room
from tests.shapes.solids import boxes

CARCASS = boxes(
    ((0, 0, 0), (1, 0.6, 0.02)),
    ((0, 0, 1.98), (1, 0.6, 2)),
    ((0, 0, 0), (0.02, 0.6, 2)),
    ((0.98, 0, 0), (1, 0.6, 2)),
    ((0, 0.58, 0), (1, 0.6, 2)),
)


def wardrobe() -> Room:
    room = Room(FLOOR).mesh("wardrobe", "DesignedFurniture", CARCASS)
    return room.box("rail", "DesignedArtifact", (0.022, 0.29, 1.77), (0.956, 0.02, 0.02))


def hung(room: Room) -> Room:
    hanger = boxes(((0.4, 0.1, 1.64), (0.41, 0.5, 1.66)), ((0.4, 0.295, 1.66), (0.41, 0.305, 1.8)))
    coat = boxes(((0.38, 0.08, 0.8), (0.43, 0.52, 1.645)), ((0.38, 0.08, 1.645), (0.43, 0.2, 1.7)))
    return room.mesh("hanger", "DesignedTool", hanger).mesh("coat", "DesignedArtifact", coat)


def test_a_coat_hangs_on_its_hanger_and_that_on_the_rail():
    room = hung(wardrobe())
    assert room.of("hanger") == {("inside", "wardrobe"), ("attached-to", "rail")}
    assert room.of("coat") == {("inside", "wardrobe"), ("attached-to", "hanger")}
    assert ("attached-to", "wardrobe") in room.of("rail")


def test_what_stands_in_the_wardrobe_does_not_hang():
    room = wardrobe().box("box", "DesignedArtifact", (0.6, 0.1, 0.02), (0.2, 0.3, 0.3))
    assert ("on", "wardrobe") in room.of("box") or ("inside", "wardrobe") in room.of("box")
    assert not {row for row in room.of("box") if row[0] == "attached-to"}


def test_nothing_hangs_without_a_rail():
    room = hung(Room(FLOOR).mesh("wardrobe", "DesignedFurniture", CARCASS))
    assert not {row for row in room.of("hanger") if row[0] == "attached-to"}
