"""Stationery and personal items; centimetres, standing on y = 0, front towards +z."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import box, cylinder, ellipsoid, lathe, leaf, prism, sweep, tube


@asset("binder_A4_80", looks="")
def binder(a: Asset) -> None:
    """Ring binder standing, spine to the front: 8 wide, 32 high, 29 deep."""
    covers = [box((x, 0, -14), (x + 0.3, 32, 14)) for x in (-4.0, 3.7)]
    a.add("cover", merge(*covers, box((-4, 0, 14), (4, 32, 14.4))), "carton_grey")
    a.add("pages", box((-3.2, 1, -12), (3.2, 30.5, 10)), "paper_white")
    a.add("spine_label", box((-2.6, 12, 14.4), (2.6, 29, 14.5)), "paper_white")


@asset("bk_0031", looks="")
def manual(a: Asset) -> None:
    """Thick book standing, spine to the front: 4 wide, 24 high, 17 deep."""
    boards = [box((x, 0, -8.5), (x + 0.3, 24, 8.5)) for x in (-2.0, 1.7)]
    a.add("cover", merge(*boards, box((-2, 0, 8.5), (2, 24, 8.9))), "carton_blue")
    a.add("block", box((-1.7, 0.4, -8.2), (1.7, 23.6, 8.5)), "paper_white")


@asset("stapler_mini", has_kind=False)
def stapler(a: Asset) -> None:
    a.add("base", box((-1.8, 0, -7), (1.8, 1, 7), 0.3), "steel_dark")
    arm = merge(box((-1.6, 0, 0), (1.6, 2, 13.5), 0.5), box((-1, -1.2, 0.5), (1, 0, 13)))
    a.add("arm", moved(arm, by=(0, 2.8, -6.6), turn=(-8, 0, 0)), "enamel_red")


@asset("td_50")
def tape_dispenser(a: Asset) -> None:
    """Weighted tape dispenser with a roll: 6 wide, 8 high, 17 deep."""
    side = [(-8.0, 0.0), (8.5, 0.0), (8.5, 5.0), (5.5, 2.5), (2.0, 2.2), (-6.0, 2.2)]
    a.add(
        "body",
        moved(
            merge(prism([*side[:3], side[3]], -3, 3), prism([side[0], side[3], side[4], side[5]], -3, 3)),
            turn=(0, -90, 0),
        ),
        "plastic_black",
    )
    ring = lathe([(1.4, -1), (3.6, -1), (3.6, 1), (1.4, 1), (1.4, -1)], 14)
    a.add("roll", moved(ring, by=(0, 4.6, -3), turn=(0, 0, 90)), "honey")


@asset("PenHolder_mesh")
def pen_holder(a: Asset) -> None:
    """Round cup for pens: 8 across, 10 high."""
    a.add("cup", lathe([(0, 0), (4, 0), (4, 10), (3.7, 10), (3.7, 0.4), (0, 0.4)]), "steel_dark")
    a.surfaces["inside"] = 0.4


@asset("ballpen_blue", looks="")
def pen(a: Asset) -> None:
    """Ballpoint pen standing on its tip: 0.9 across, 14 high."""
    a.add("barrel", lathe([(0, 0), (0.12, 0.1), (0.45, 2), (0.45, 12.5), (0, 12.5)], 8), "plastic_blue")
    a.add("clip", box((0.45, 8.5, -0.2), (0.65, 13, 0.2)), "chrome")
    a.add("button", cylinder((0, 12.5, 0), 0.25, 1.4, segments=6), "chrome")


@asset("scissors_21cm")
def scissors(a: Asset) -> None:
    """Scissors lying flat, closed: 8 wide, 1 high, 21 deep."""
    blades = [moved(box((-0.7, 0.2, -12), (0.7, 0.4 + h, 2.4)), turn=(0, t, 0)) for h, t in ((0.0, 4.0), (0.2, -4.0))]
    a.add("blades", merge(*blades), "brushed_steel")
    ring = [(2.4 * float(np.cos(t)), 0.5, 3.2 * float(np.sin(t))) for t in np.linspace(0, 2 * np.pi, 10)[:-1]]
    loop = tube(ring, 0.5, 6, closed=True)
    a.add("handles", merge(moved(loop, by=(2.4, 0, 4.6)), moved(loop, by=(-2.4, 0, 4.6))), "enamel_red")


@asset("punch_2h", has_kind=False)
def hole_punch(a: Asset) -> None:
    """Two-hole punch: 11 wide, 7 high, 11 deep."""
    a.add("tray", box((-5.5, 0, -5), (5.5, 1, 5.5), 0.3), "plastic_black")
    a.add("posts", merge(*(box((x, 1, 0), (x + 1.6, 4, 3)) for x in (-4.8, 3.2))), "steel_light")
    a.add("lever", moved(box((-5, 0, 0), (5, 1.4, 10), 0.4), by=(0, 3.6, -4), turn=(-12, 0, 0)), "steel_dark")


@asset("SL_12D")
def calculator(a: Asset) -> None:
    """Desk calculator: 11 wide, 3 high, 15 deep."""
    a.add("case", moved(box((-5.5, 0, -7.5), (5.5, 1.6, 7.5), 0.4), by=(0, 0.9, 0), turn=(7, 0, 0)), "plastic_grey")
    keys = [box((x, 0, z), (x + 1.5, 1, z + 1.3)) for x in (-4.4, -2.1, 0.2, 2.5) for z in (-1.4, 0.6, 2.6, 4.6)]
    a.add("keys", moved(merge(*keys), by=(0, 2.1, 0), turn=(7, 0, 0)), "plastic_white")
    a.add("lcd", moved(box((-4.5, 0, -6.5), (4.5, 0.8, -3.4)), by=(0, 2.2, 0), turn=(7, 0, 0)), "ceramic_sage")


@asset("ofc_031")
def letter_tray(a: Asset) -> None:
    """Three stacked paper trays: 26 wide, 19 high, 34 deep, open to the front."""
    level = [box((-13, 0, -17), (13, 0.4, 17)), box((-13, 0.4, -17), (13, 4, -16.6))]
    level += [box((x, 0.4, -16.6), (x + 0.4, 4, 17)) for x in (-13.0, 12.6)]
    a.add("trays", copies(merge(*level), [(0, 6.5 * k, 0) for k in range(3)]), "plastic_black")
    posts = [box((x, 0, z), (x + 0.8, 17, z + 0.8)) for x in (-13.9, 13.1) for z in (-15.0, 14.0)]
    a.add("posts", merge(*posts), "plastic_black")
    a.add("sheets", box((-10.5, 0.4, -14.5), (10.5, 1.6, 15)), "paper_white")


@asset("TissueBox_150")
def tissue_box(a: Asset) -> None:
    """Tissue box with a tissue sticking out: 23 wide, 13 high, 12 deep."""
    a.add("carton", box((-11.5, 0, -6), (11.5, 8, 6), 0.2), "carton_blue")
    a.add(
        "tissue",
        merge(moved(leaf(5, 3), by=(0, 10, 0), turn=(60, 20, 30)), moved(leaf(4, 3), by=(1, 10, 0), turn=(-60, 0, 70))),
        "paper_white",
    )


@asset("ofc_044", looks="")
def photo_frame(a: Asset) -> None:
    """Small standing photo frame: 15 wide, 19 high, 10 deep."""
    frame = merge(
        box((-7.5, 0, -0.8), (7.5, 2, 0.6)),
        box((-7.5, 18, -0.8), (7.5, 20, 0.6)),
        box((-7.5, 2, -0.8), (-5.5, 18, 0.6)),
        box((5.5, 2, -0.8), (7.5, 18, 0.6)),
    )
    a.add("frame", moved(frame, turn=(-12, 0, 0)), "oak_light")
    a.add("photo", moved(box((-5.5, 2, -0.5), (5.5, 18, 0.2)), turn=(-12, 0, 0)), "print_fruit")
    a.add("easel", moved(box((-1.5, 0, -0.2), (1.5, 15, 0.2)), by=(0, 0.1, -9), turn=(22, 0, 0)), "paper_kraft")


@asset("M_031")
def mug(a: Asset) -> None:
    """Mug with a handle: 12 wide, 9.5 high."""
    a.add("body", lathe([(0, 0), (3.6, 0), (4, 0.6), (4, 9.5), (3.6, 9.5), (3.5, 1), (0, 1)]), "ceramic_blue")
    a.add("handle", tube([(3.9, 7.8, 0), (6.2, 7.4, 0), (6.6, 5, 0), (6, 2.6, 0), (3.9, 2.2, 0)], 0.55), "ceramic_blue")


@asset("bp_urban")
def backpack(a: Asset) -> None:
    """Backpack standing: 32 wide, 48 high, 24 deep."""
    a.add("main", box((-16, 0, -8), (16, 46, 8), 5.0), "fabric_navy")
    a.add("front_pocket", box((-12, 4, 8), (12, 24, 13), 3.0), "fabric_navy")
    for name, x in (("strap_L", -9.0), ("strap_R", 9.0)):
        line = [(x, 43.0, -7.5), (x, 38.0, -12.0), (x, 20.0, -12.5), (x, 6.0, -7.5)]
        a.add(name, sweep(line, [(2.5, -0.5), (2.5, 0.5), (-2.5, 0.5), (-2.5, -0.5)], up=(0, 0, 1)), "mesh_fabric")
    a.add("top_loop", tube([(-4, 45, 0), (-3, 48, 0), (3, 48, 0), (4, 45, 0)], 0.7), "mesh_fabric")


@asset("waste_basket_14l")
def waste_basket(a: Asset) -> None:
    """Waste-paper basket: 28 across, 32 high."""
    a.add("bin", lathe([(0, 0), (11, 0), (14, 32), (13.5, 32), (10.6, 0.6), (0, 0.6)]), "plastic_black")


@asset("wb_60_blue")
def recycling_bin(a: Asset) -> None:
    """Paper recycling bin with a slotted lid: 36 wide, 76 high, 36 deep."""
    a.add("body", box((-17, 0, -17), (17, 68, 17), 1.5), "plastic_grey")
    lid = [box((-18, 68, -18), (18, 76, -3), 0.8), box((-18, 68, 3), (18, 76, 18), 0.8)]
    lid += [box((-18, 68, -3), (-13, 76, 3)), box((13, 68, -3), (18, 76, 3))]
    a.add("lid_slot", merge(*lid), "bin_blue")
    a.add("sticker", box((-6, 40, 17), (6, 52, 17.1)), "paper_white")


@asset("Plant_Ficus_140")
def floor_plant(a: Asset) -> None:
    """Tall plant in a pot: about 70 wide, 140 high."""
    a.add("pot", lathe([(0, 0), (13, 0), (17, 32), (15.8, 32), (15, 28), (0, 28)]), "ceramic_white")
    a.add("earth", cylinder((0, 28, 0), 15, 0.6), "soil")
    a.add("stem", tube([(0, 28, 0), (2, 60, 1), (-1, 95, 0), (1, 125, 2)], 1.2), "oak_dark")
    leaves = []
    for k in range(30):
        angle, height = 137.5 * k, 60 + 2.5 * k
        out = 8 + 18 * float(np.sin(np.pi * (k + 4) / 36))
        x, z = out * float(np.cos(np.radians(angle))), out * float(np.sin(np.radians(angle)))
        leaves.append(moved(leaf(11, 4.5), by=(x, height, z), turn=(0, -angle, 20)))
    a.add("foliage", merge(*leaves), "leaf_green")


@asset("pt_09")
def desk_plant(a: Asset) -> None:
    """Small succulent in a pot: 10 across, 14 high."""
    a.add("planter", lathe([(0, 0), (3.8, 0), (5, 7), (4.5, 7), (4.2, 6), (0, 6)]), "terracotta")
    blades = [moved(leaf(4, 1.1), by=(1.2, 10, 0), turn=(0, 0, 65)) for _ in range(1)]
    around = [moved(merge(*blades), turn=(0, 36.0 * k, 0)) for k in range(10)]
    a.add("succulent", merge(*around, ellipsoid((0, 7, 0), (2.5, 1.5, 2.5), 8)), "leaf_green")


@asset("umbrella_black")
def umbrella(a: Asset) -> None:
    """Closed umbrella standing on its tip: 12 wide, 88 high."""
    a.add("canopy", lathe([(0, 0), (0.5, 1), (0.6, 8), (3.4, 60), (2, 64), (0, 64)], 8), "fabric_navy")
    a.add("shaft", cylinder((0, 64, 0), 0.6, 12, segments=8), "steel_dark")
    hook = [(0.0, 76.0, 0.0), (0.0, 83.0, 0.0), (2.0, 87.0, 0.0), (6.0, 87.0, 0.0), (8.0, 82.0, 0.0)]
    a.add("crook", tube(hook, 1.0, 8), "oak_dark")
