"""Packing station and office corner; centimetres, y up, front towards +z."""

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, legs, pail, rod, tray, turned
from scenes.writer.mesh import merge, moved
from scenes.writer.shapes import bend, prism, tube


@asset("PackingTable_180")
def packing_table(a: Asset) -> None:
    """Packing table with upper shelf, 180 x 80 x 90."""
    a.add("top", block((180, 4, 80), (0, 86, 0), 0.6), "wood_ply")
    a.add("frame", merge(*legs(172, 72, 86, 6)), "steel_blue")
    posts = [block((4, 70, 4), (x, 90, -36)) for x in (-84.0, 84.0)]
    a.add("upper_shelf", merge(block((176, 3, 30), (0, 150, -24)), *posts), "steel_blue")
    a.surfaces.update(top=90.0, shelf=153.0)


@asset("pk_0008", looks="mtl")
def bench_scale(a: Asset) -> None:
    """Parcel scale with display on a stalk."""
    a.add("platform", block((38, 3, 34), (0, 5, 2), 0.4), "galvanised")
    a.add("base", block((32, 4, 28), (0, 1, 2)), "plastic_black")
    a.add(
        "feet", merge(*(disc((x, 0.5, z), 1.6, 1, "y", 8) for x in (-14.0, 14.0) for z in (-9.0, 13.0))), "rubber_black"
    )
    a.add("display", merge(rod((0, 4, -16), (0, 34, -18), 1), block((20, 11, 3), (0, 34, -18), 0.6)), "plastic_grey")
    a.add("lcd", block((14, 5, 0.3), (0, 37, -16.4)), "screen")


@asset("TapeDispenser_Gun")
def tape_dispenser(a: Asset) -> None:
    """Hand-held packing tape dispenser, lying."""
    a.add("roll", disc((0, 3, 0), 6, 5, "y", 16), "MI_PackTape")
    a.add("frame", merge(block((16, 0.8, 5), (3, 0, 0)), block((4, 6, 5.4), (11, 0, 0), 0.6)), "plastic_red")
    a.add("grip", moved(block((4, 4, 12), bevel=1), by=(2, 1, 11)), "plastic_black")


@asset("LabelPrinter_ZT")
def label_printer(a: Asset) -> None:
    """Label printer with a label half out."""
    a.add("body", block((24, 28, 34), bevel=1.4), "plastic_grey")
    a.add("door", block((0.6, 22, 26), (12.2, 4, -2)), "plastic_black")
    a.add("label", moved(block((10, 0.1, 8), (0, 0, 4)), by=(0, 9, 17), turn=(14, 0, 0)), "paper")


@asset("brc_scn")
def barcode_scanner(a: Asset) -> None:
    """Hand scanner in its stand."""
    a.add("stand", merge(block((10, 1.4, 12), bevel=0.4), rod((0, 1, -2), (0, 14, -2), 1.2)), "plastic_black")
    a.add("head", block((7, 5, 11), (0, 14, 2), 1.2), "MI_SafetyYellow")
    a.add("handle", moved(block((3.4, 11, 4), bevel=0.8), by=(0, 4, 1), turn=(-10, 0, 0)), "plastic_black")


@asset("cutter_18", looks="")
def cutter(a: Asset) -> None:
    """Box cutter, lying along x."""
    a.add("cutter_body", block((13, 1.2, 2.4), bevel=0.4), "plastic_orange")
    a.add(
        "cutter_blade",
        moved(prism([(0, 0), (3.4, 0), (2, 1.6), (0, 1.6)], 0, 0.1), by=(6.4, 0.6, 0.8), turn=(-90, 0, 0)),
        "chrome",
    )


@asset("it_0024", "monitor")
def monitor(a: Asset) -> None:
    """Flat monitor on a foot."""
    a.add("panel", block((54, 32, 3), (0, 12, 0), 0.5), "plastic_black")
    a.add("screen", block((52, 29.5, 0.2), (0, 13.6, 1.5)), "screen")
    a.add("stand", merge(block((5, 16, 3), (0, 0.8, -2.6)), block((24, 1.2, 18), (0, 0, -2))), "plastic_black")


@asset("kb_de")
def keyboard(a: Asset) -> None:
    a.add("case", block((44, 1.4, 14), bevel=0.4), "plastic_black")
    keys = [block((5.4, 0.6, 2.2), (-18.0 + 6 * i, 1.4, z)) for i in range(7) for z in (-4.4, -1.6, 1.2, 4.0)]
    a.add("keys", merge(*keys), "plastic_grey")


@asset("DesktopPC_Tower")
def computer(a: Asset) -> None:
    """Computer tower."""
    a.add("case", block((18, 40, 42), bevel=0.6), "plastic_black")
    a.add("bezel", block((17, 38, 0.8), (0, 1, 21)), "plastic_grey")
    a.add("power_button", disc((0, 35, 21.6), 1, 0.6, "z", 8), "chrome")


@asset("DeskLamp_Arm")
def desk_lamp(a: Asset) -> None:
    a.add("foot", turned([(9, 0), (9, 1.6), (7, 2)]), "plastic_black")
    a.add("arm", merge(rod((0, 2, 0), (-10, 30, 0), 0.8), rod((-10, 30, 0), (14, 46, 0), 0.8)), "chrome")
    a.add("shade", moved(turned([(8, 0), (7, 4), (2.6, 9)]), by=(18, 39, 0), turn=(0, 0, 14)), "plastic_black")


@asset("Desk_160x80")
def desk(a: Asset) -> None:
    """Office desk."""
    a.add("top", block((160, 2.5, 80), (0, 71.5, 0), 0.4), "wood_beech")
    a.add("legs", merge(*(block((4, 71.5, 70), (x, 0, 0)) for x in (-74.0, 74.0))), "steel_grey")
    a.add("modesty_panel", block((144, 34, 1.4), (0, 36, -30)), "steel_grey")


@asset("fu_0110", "Chair")
def office_chair(a: Asset) -> None:
    """Swivel chair with armrests."""
    a.add("seat", block((50, 8, 48), (0, 44, 0), 3), "fabric_grey")
    a.add("backrest", moved(block((46, 52, 6), bevel=2.6), by=(0, 58, -24), turn=(-8, 0, 0)), "fabric_grey")
    a.add(
        "arms",
        merge(*(tube([(x, 46, 6), (x * 1.12, 64, 6), (x * 1.12, 65, -14)], 1.8) for x in (-25.0, 25.0))),
        "plastic_black",
    )
    a.add("column", rod((0, 8, 0), (0, 45, 0), 2.8, 8), "chrome")
    star = [moved(rod((0, 10, 0), (30, 7, 0), 2), turn=(0, 72.0 * k, 0)) for k in range(5)]
    wheels = [moved(disc((30, 3, 0), 3, 4, "z", 8), turn=(0, 72.0 * k, 0)) for k in range(5)]
    a.add("base", merge(*star, *wheels), "plastic_black")


@asset("fc_body", "cabinet_body")
def cabinet_body(a: Asset) -> None:
    """Filing cabinet carcass, open to the front."""
    shell = [moved(m, turn=(90, 0, 0), by=(0, 52, -29)) for m in tray((46, 58, 104), 1.4)]
    a.add("carcass", merge(*shell), "lacquer_cream")


@asset("fc_drawer", "cabinet_drawer")
def cabinet_drawer(a: Asset) -> None:
    """Filing cabinet drawer with label holder."""
    a.add("tray", merge(*tray((41, 22, 52), 1)), "steel_grey")
    a.add("front", block((42, 32, 1.6), (0, 0, 27), 0.4), "lacquer_cream")
    a.add("pull", merge(block((12, 1.4, 2), (0, 20, 28.6)), block((8, 4, 0.4), (0, 24, 28))), "chrome")


@asset("kt_0003", "mug")
def mug(a: Asset) -> None:
    a.add("mug_geo", pail(4, 4.2, 9.6, 0.4, 14), "plastic_white")
    a.add("ear", tube(bend((3.9, 7.6, 0), (9, 5, 0), (3.9, 2, 0), 6), 0.6), "plastic_white")


@asset("Binder_A4_80", looks="mats")
def binder(a: Asset) -> None:
    """Lever-arch file, upright, spine to the front."""
    a.add(
        "cover",
        merge(block((7.8, 31.8, 0.3), (0, 0, 14)), *(block((0.3, 31.8, 28), (x, 0, 0)) for x in (-3.8, 3.8))),
        "plastic_black",
    )
    a.add("sheets", block((5.4, 29.8, 22), (0, 1, 0)), "paper")
    a.add("spine_label", block((5, 18, 0.2), (0, 9, 14.2)), "paper")


@asset("PetBottle_1L5")
def water_bottle(a: Asset) -> None:
    """Plastic water bottle."""
    a.add("pet", turned([(4, 0), (4.4, 1), (4.4, 20), (3.6, 24), (1.4, 29), (1.4, 30.5)]), "film_clear")
    a.add("cap", turned([(1.7, 0), (1.7, 1.8)], (0, 30, 0), 10), "plastic_blue")
    a.add("label", turned([(4.5, 0), (4.5, 7)], (0, 10, 0)), "plastic_blue")
