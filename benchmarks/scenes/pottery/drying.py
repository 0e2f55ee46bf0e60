"""The racks and cupboards of the hall in which pots dry: ware boards, a damp cupboard and a trolley."""

from benchmarks.scenes.pottery.shapes import Mesh, box, carcass, lathe, merge, moved, rod, tube, vessel
from benchmarks.scenes.pottery.stage import Group, Part, Pottery, Shape, shape
from benchmarks.scenes.pottery.things import (
    BLACK,
    BRICK,
    CELADON,
    CLAY,
    STEEL,
    WHITE,
    WOOD,
    bowl,
    bucket,
    bucket_lid,
    cardboard,
    door,
    mug,
    plate,
    slab,
    teapot,
    teapot_lid,
    vase,
)

__all__ = ["build_drying"]


def build_drying(pottery: Pottery) -> None:
    """Add the racks and cupboards."""
    hall = pottery.root._replace(path="/Pottery/Hall")
    _build_rack(pottery, pottery.group(hall, "Drying_rack", (700, 310, 0), -90))
    _build_cupboard(pottery, pottery.group(hall, "Damp_cupboard", (700, 538, 0), -90))
    stack = pottery.group(hall, "Spare_stools", (610, 44, 0))
    for number in range(2):
        pottery.put(stack, f"Spare_stool_{number + 1}", _stacking_stool(), (0.2 * number, 0, 3.2 * number), 22 * number)


def _stacking_stool() -> Shape:
    """Return a stool whose legs are outside the edge of its seat, so that copies stack with a step of 3.2."""
    legs = [
        tube([(20 * x, 20 * y, 0), (17 * x, 17 * y, 41), (12 * x, 12 * y, 43.5)], 1)
        for x, y in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))
    ]
    return shape(rod(13.5, 2, z=43, n=24), WOOD, Part(merge(*legs), STEEL), asset="stacking_stool")


def _rack_frame() -> Mesh:
    posts = [box(3, 3, 185, x, y) for x in (-50, 0, 50) for y in (-3.5, -50.5)]
    arms = [box(2.5, 44, 3, x, -27, z - 3) for x in (-50, 0, 50) for z in (28, 62, 96, 130, 164)]
    beams = [box(97, 2, 3, 0, y, z) for y in (-3.5, -50.5) for z in (8, 182)]
    return merge(*posts, *arms, *beams)


def _build_rack(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Rack", shape(_rack_frame(), STEEL), (0, -0.4, 0))
    board = slab(124, 20, 2, WOOD, "ware_board")
    places = [
        (28, -38, 0.4),
        (62, -38, -0.6),
        (62, -15, 0),
        (96, -26, 1),
        (130, -38, 0),
        (130, -15.5, 0.5),
        (164, -30, -1),
    ]
    for number, (z, y, turn) in enumerate(places, 1):
        pottery.put(group, f"Ware_board_{number}", board, (1.5 * (number % 3), y, z), turn)
    for number, x in enumerate((-30, 16), 1):
        pottery.put(group, f"Tall_vase_{number}", vase(8.5, 27, CLAY, 0.4 + 0.1 * number), (x, -38, 30), 20 * number)
    for number in range(3):
        pottery.put(
            group, f"Stacked_bowl_{number + 1}", bowl(9, 7.5, CLAY), (-44, -38.5, 64 + 1.35 * number), 3 * number
        )
    for number in range(3):
        pottery.put(group, f"Stacked_plate_{number + 1}", plate(9.5, CLAY), (-18, -38, 64 + 0.75 * number), 5)
    for number, x in enumerate((-45, -20), 1):
        pottery.put(group, f"Raw_mug_{number}", mug(CLAY), (x, -15 + 0.5 * (number % 2), 64), 50 * number)
    for number, x in enumerate((-38, 2), 1):
        pottery.put(group, f"Raw_teapot_{number}", teapot(BRICK), (x, -26, 98), 10 - 30 * number)
    pottery.put(group, "Raw_teapot_lid_1", teapot_lid(BRICK), (-38, -26, 109))
    for number, x in enumerate((-46, -22), 1):
        for level in range(3 - number):
            pottery.put(
                group,
                f"Cylinder_{number}{level + 1}",
                shape(vessel([(6, 0), (6, 11)], 0.8, 1), CLAY),
                (x, -38, 132 + 11 * level),
            )
    pottery.put(
        group,
        "Upturned_bowl",
        shape(
            Mesh(bowl(8, 6, CLAY).parts[0].mesh.points * [1, -1, -1] + [0, 0, 6], bowl(8, 6, CLAY).parts[0].mesh.faces),
            CLAY,
        ),
        (-30, -15.5, 132),
    )
    pottery.put(group, "Batch_label", slab(7, 4, 0.1, WHITE), (20, -15, 132), 8)


def _build_cupboard(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Cupboard", shape(carcass(90, 46, 165, (85,), plinth=8), WHITE), (0, -0.3, 0))
    for name, x, turn, knob in (("left", -44.8, -100, 41), ("right", 44.8, 0, -41)):
        leaf = pottery.group(group, f"Leaf_{name}", (x, -46.5, 8.3), turn)
        panel = (
            door(44.5, 156, 1.8, CELADON)
            if knob > 0
            else shape(moved(box(44.5, 1.8, 156, 22.25, -0.9), -44.5), CELADON)
        )
        pottery.fix(leaf, f"Cupboard_door_{name}", panel, (0, 0, 0))
        pottery.fix(
            leaf,
            f"Cupboard_knob_{name}",
            shape(merge(rod(0.8, 2, "-y"), rod(1.6, 1.2, "-y", 0, -2)), BLACK, asset="knob"),
            (knob, -1.9, 78),
        )
    for number, (x, y) in enumerate(((-43.1, -8), (-43.1, -38), (43.1, -8), (43.1, -38)), 1):
        pin = rod(0.4, 2.4, "x", -0.4) if x < 0 else rod(0.4, 2.4, "x", -2)
        pottery.fix(group, f"Shelf_pin_{number}", shape(pin, STEEL), (x, y, 122))
    pottery.put(group, "Loose_shelf", slab(85.8, 41, 1.8, WOOD), (0, -22, 122.5))
    pottery.put(group, "Damp_bucket", bucket(WHITE), (-20, -23, 9.8), 10)
    pottery.put(group, "Damp_bucket_lid", bucket_lid(WHITE), (-20, -23, 39.8))
    pottery.put(group, "Handled_jug", vase(9, 26, CLAY, 0.6), (-24, -24, 85))
    cover = lathe(
        [(11.2, 0), (11.4, 18), (9, 28), (2, 29), (0, 29.2), (0, 29.1), (2, 28.9), (8.9, 27.9), (11.3, 18), (11.1, 0)]
    )
    pottery.put(group, "Plastic_cover", shape(cover, STEEL, opacity=0.4), (-24, -24, 85), 12)
    for number in range(2):
        pottery.put(group, f"Damp_plate_{number + 1}", plate(12, CLAY), (18, -24, 85 + 0.75 * number))
    pottery.put(group, "Damp_cup", shape(vessel([(3, 0), (4, 8)], 0.4, 0.6), CLAY), (18, -24, 86.45))
    pottery.put(group, "Slip_tub", shape(vessel([(7, 0), (7.5, 12)], 0.3, 0.4), WHITE), (14, -24, 124.3))
    pottery.put(group, "Slip", shape(rod(7, 7, n=24), BRICK), (14, -24, 124.8))
    pottery.put(group, "Scrap_carton", cardboard(40, 30, 18), (-18, -24, 165), 7)
