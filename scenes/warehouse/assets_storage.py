"""Racks, load carriers and packages; centimetres, y up, front towards +z."""

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, legs, rod, tray, turned
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import box, prism


@asset("SM_RackLong_A1")
def pallet_rack(a: Asset) -> None:
    """Pallet rack bay, 280 wide, three levels."""
    frames = [block((9, 420, 8), (x, 0, z)) for x in (-140.0, 140.0) for z in (-48.0, 48.0)]
    braces = [rod((x, y, -46), (x, y + 70, 46), 1.6, 5) for x in (-140.0, 140.0) for y in (20.0, 110.0, 200.0, 290.0)]
    a.add("SM_RackFrame_01", merge(*frames, *braces), "steel_blue")
    beams = [block((271, 12, 5), (0, y, z)) for y in (138.0, 278.0) for z in (-48.0, 48.0)]
    a.add("SM_RackBeam_01", merge(*beams), "steel_orange")
    a.add("SM_RackDeck_01", merge(*(block((268, 1.5, 90), (0, y + 10.5, 0)) for y in (138.0, 278.0))), "galvanised")
    a.surfaces.update(low=150.0, high=290.0)


@asset("aws_robomaker_warehouse_ShelfE_01")
def shelf_unit(a: Asset) -> None:
    """Boltless shelving, 120 wide, four boards."""
    a.add("frame", merge(*legs(120, 50, 200, 4)), "galvanised")
    a.add("boards", merge(*(block((118, 3, 48), (0, y, 0)) for y in (10.0, 70.0, 130.0, 190.0))), "wood_ply")
    a.surfaces.update(a=13.0, b=73.0, c=133.0)


@asset("EUR_Pallet")
def pallet(a: Asset) -> None:
    """Wooden four-way pallet, 120 x 80."""
    boards = [block((120, 2.2, 12), (0, 12.2, -34.0 + 17 * k)) for k in range(5)]
    cross = [block((14, 2.2, 80), (x, 10, 0)) for x in (-53.0, 0.0, 53.0)]
    feet = [block((14, 8, 12), (x, 2, z)) for x in (-53.0, 0.0, 53.0) for z in (-34.0, 0.0, 34.0)]
    skids = [block((120, 2, 12), (0, 0, z)) for z in (-34.0, 0.0, 34.0)]
    a.add("EUR_Pallet_geo", merge(*boards, *cross, *feet, *skids), "wood_pallet")


def _carton(a: Asset, prefix: str, width: float, height: float, depth: float) -> None:
    a.add(f"{prefix}_body", block((width, height, depth), bevel=0.4), "MI_CardBox")
    a.add(f"{prefix}_tape", block((width * 0.99, 0.3, 5), (0, height - 0.2, 0)), "MI_PackTape")


@asset("SM_CardBoxA_02")
def carton_large(a: Asset) -> None:
    """60 x 40 x 40."""
    _carton(a, "SM_CardBoxA_02", 60, 40, 40)
    a.add("label", block((14, 10, 0.2), (12, 22, 20)), "paper")


@asset("SM_CardBoxB_01")
def carton_medium(a: Asset) -> None:
    """40 x 30 x 30."""
    _carton(a, "SM_CardBoxB_01", 40, 30, 30)


@asset("bx_c03", looks="", has_kind=False)
def carton_small(a: Asset) -> None:
    """30 x 20 x 20."""
    _carton(a, "geom", 30, 20, 20)


@asset("CardboardBox_open")
def carton_open(a: Asset) -> None:
    """Carton with its flaps folded out."""
    a.add("walls", merge(*tray((50, 32, 36), 0.5)), "MI_CardBox")
    flaps = [moved(block((50, 0.4, 16), (0, 0, 8)), by=(0, 31.6, 18), turn=(35, 0, 0))]
    flaps.append(moved(block((50, 0.4, 16), (0, 0, -8)), by=(0, 31.6, -18), turn=(-35, 0, 0)))
    a.add("flaps", merge(*flaps), "MI_CardBox")


@asset("Stack_Cartons_9")
def carton_stack(a: Asset) -> None:
    """Nine cartons wrapped as one load."""
    spots = [(40.0 * i, 31.0 * k, 0.0) for i in (-1, 0, 1) for k in range(3)]
    a.add("cartons_geo", copies(block((39, 30.5, 70), bevel=0.5), spots), "MI_CardBox")
    a.add("strap", merge(*(block((121, 1.5, 71), (0, y, 0)) for y in (14.0, 76.0))), "plastic_black")


@asset("WoodenCrate_80")
def crate(a: Asset) -> None:
    """Slatted crate with lid, 80 x 60 x 60."""
    slats = []
    for y in (4.0, 17.0, 30.0, 43.0):
        slats += [block((80, 11, 2), (0, y, z)) for z in (-29.0, 29.0)]
        slats += [block((2, 11, 56), (x, y, 0)) for x in (-39.0, 39.0)]
    a.add("slats", merge(*slats, *legs(76, 56, 56, 6)), "wood_pallet")
    a.add("lid", block((82, 2.5, 62), (0, 56, 0)), "wood_ply")
    a.add("bottom", block((76, 2, 56), (0, 2, 0)), "wood_ply")


@asset("KLT_6428", has_kind=False)
def tote(a: Asset) -> None:
    """Small load carrier, 60 x 40 x 28."""
    a.add("body", merge(*tray((57, 28, 37), 1.2)), "plastic_blue")
    a.add(
        "rim",
        merge(*tray((60, 2.5, 40), 1.6, (0, 25.5, 0))[1:], *tray((58, 1.5, 38), 1, (0, 10, 0))[1:]),
        "plastic_blue",
    )
    a.surfaces["inside"] = 1.2


@asset("st_bin_y")
def stacking_bin(a: Asset) -> None:
    """Open-fronted picking bin."""
    sides = [prism([(-15, 0), (13, 0), (15, 6), (9, 15), (-15, 15)], z, z + 1) for z in (-10.0, 9.0)]
    shell = merge(*(moved(side, turn=(0, -90, 0)) for side in sides))
    rest = [box((-10, 0, -15), (10, 1, 13)), box((-10, 1, -15), (10, 15, -14)), box((-10, 1, 12), (10, 6, 13))]
    a.add("bin", merge(shell, *rest), "MI_SafetyYellow")


@asset("Drum_200L")
def drum(a: Asset) -> None:
    """Steel drum with hoops."""
    hoops = [(28.5, 0.0), (28.5, 29.0), (29.6, 30.0), (28.5, 31.0), (28.5, 58.0), (29.6, 59.0), (28.5, 60.0)]
    a.add("shell", turned([*hoops, (28.5, 87)], segments=18), "steel_blue")
    a.add("bungs", merge(disc((14, 87.5, 0), 3, 1, "y"), disc((-16, 87.5, 0), 2, 1, "y")), "galvanised")


@asset("ctr_0220", "Fass")
def barrel(a: Asset) -> None:
    """Plastic barrel with clamp ring."""
    a.add("body", turned([(25, 0), (29, 6), (29, 78), (25, 88)], segments=16), "plastic_blue")
    a.add("lid", turned([(26, 0), (26, 5), (24, 6)], (0, 87, 0), 16), "plastic_black")


@asset("GasCylinder_50L")
def gas_bottle(a: Asset) -> None:
    """Steel gas cylinder with cap."""
    a.add("shell", turned([(11.5, 0), (11.5, 125), (9, 136), (4, 141)]), "steel_grey")
    a.add("shoulder", turned([(11.6, 0), (9.1, 11.2)], (0, 125, 0)), "plastic_orange")
    a.add("cap", turned([(4.5, 0), (4.5, 12), (3, 15)], (0, 141, 0)), "galvanised")


@asset("ParcelBag_Grey", looks="mats")
def parcel_bag(a: Asset) -> None:
    """Filled mailing bag, lying."""
    a.add("bag", block((38, 8, 28), bevel=3.6), "plastic_grey")
    a.add("label", block((12, 0.2, 9), (4, 8, 0)), "paper")
