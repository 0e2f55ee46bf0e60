"""Bench, machines and hand tools, without kind and with colliders; centimetres, y up, front towards +z.

Hand tools lie along x on y = 0.
"""

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, legs, pail, rod, tray, turned
from scenes.writer.mesh import merge, moved
from scenes.writer.shapes import arc, bend, box, prism, tube


@asset("Workbench_200", has_kind=False)
def workbench(a: Asset) -> None:
    """Bench 200 x 70 x 88."""
    a.add("top", block((200, 5, 70), (0, 83, 0), 0.6), "wood_beech")
    a.add("frame", merge(*legs(190, 62, 83, 8), block((180, 6, 4), (0, 14, -26))), "lacquer_green")
    a.add("shelf", block((176, 2, 52), (0, 20, 0)), "galvanised")


@asset("vise_125", "vise", has_kind=False)
def vise(a: Asset) -> None:
    """Bench vise, jaws towards +z."""
    a.add("base", merge(disc((0, 1.5, 0), 9, 3, "y"), block((10, 10, 12), (0, 3, 0), 1)), "steel_blue")
    a.add("jaws", merge(block((13, 8, 4), (0, 11, 5), 0.5), block((13, 8, 4), (0, 11, 12), 0.5)), "cast_iron")
    a.add("slide", block((6, 6, 18), (0, 5, 12)), "steel_blue")
    a.add("spindle", merge(rod((0, 8, 20), (0, 8, 28), 1.4), rod((-9, 8, 27), (9, 8, 27), 0.7)), "chrome")


@asset("tlb_45", "tlb", looks="", has_kind=False)
def toolbox(a: Asset) -> None:
    """Metal toolbox with bow handle."""
    a.add("g0", block((45, 20, 22), bevel=1), "lacquer_red")
    a.add(
        "g1",
        merge(block((45.6, 1.5, 22.6), (0, 13, 0)), *(block((3, 5, 1), (x, 11, 11.4)) for x in (-14.0, 14.0))),
        "steel_grey",
    )
    a.add("g2", tube([(-10, 20, 0), (-8, 26, 0), (8, 26, 0), (10, 20, 0)], 1), "plastic_black")


@asset("ClawHammer", has_kind=False)
def hammer(a: Asset) -> None:
    """Claw hammer, 32 long."""
    a.add("handle", rod((-15, 1.6, 0), (12, 1.6, 0), 1.4, 8), "wood_beech")
    claw = prism([(-1.5, 0), (1.5, 0), (1.2, 5), (0.2, 7)], 0.3, 2.9)
    head = merge(block((3, 3.2, 4), (13.5, 0, 0)), moved(claw, by=(13.5, 0, -2), turn=(-90, 0, 0)))
    a.add("head", merge(head, disc((13.5, 1.6, 4), 1.5, 4.5, "z", 10)), "cast_iron")


@asset("tl_0031", "Screwdriver", has_kind=False)
def screwdriver(a: Asset) -> None:
    handle = moved(
        turned([(1.2, 0), (1.7, 2), (1.3, 5), (1.6, 9), (0.9, 11)], segments=10), by=(-12, 1.7, 0), turn=(0, 0, -90)
    )
    a.add("handle", handle, "plastic_red")
    a.add("blade", rod((-1, 1.7, 0), (12, 1.7, 0), 0.35), "chrome")


@asset("tl_0044", "Wrench", has_kind=False)
def wrench(a: Asset) -> None:
    """Combination wrench, 22 long: open end and ring."""
    a.add("shaft", box((-8, 0, -0.9), (8, 0.7, 0.9), 0.2), "chrome")
    jaws = [box((8, 0, z), (12, 0.7, z + 1.3), 0.2) for z in (-2.3, 1.0)]
    ring = tube([(-9.6 + x, 0.35, z) for x, z in arc((0, 0), 1.9, 0, 330, 11)], 0.6, closed=True)
    a.add("ends", merge(box((6.8, 0, -2.3), (8.4, 0.7, 2.3), 0.2), *jaws, ring), "chrome")


@asset("Pliers_Combi", has_kind=False)
def pliers(a: Asset) -> None:
    """Combination pliers, 18 long."""
    grips = [tube(bend((0, 0.8, 0), (-4, 0.8, 4.4 * s), (-11, 0.8, 2.2 * s), 5), 0.75) for s in (-1, 1)]
    a.add("grips", merge(*grips), "plastic_blue")
    a.add("jaws", merge(block((6, 1.4, 2.6), (3.6, 0.1, 0), 0.4), disc((0, 0.8, 0), 1.5, 1.6, "y", 10)), "cast_iron")


@asset("CordlessDrill_18V", has_kind=False)
def drill(a: Asset) -> None:
    """Cordless drill standing on its battery, bit towards +x."""
    a.add("body", disc((0, 18, 0), 3.4, 17, "x"), "plastic_green")
    a.add("grip", moved(block((4, 13, 3.6), bevel=1), by=(-3.4, 5, 0), turn=(0, 0, -8)), "plastic_black")
    a.add("battery", block((12, 6, 8), (-2, 0, 0), 0.8), "plastic_black")
    a.add("chuck", merge(disc((10.4, 18, 0), 2.2, 4, "x"), rod((12, 18, 0), (20, 18, 0), 0.4)), "cast_iron")


@asset("hnd_saw", "saw_geo_grp", has_kind=False)
def saw(a: Asset) -> None:
    """Hand saw, 52 long, lying."""
    a.add(
        "blade",
        moved(prism([(-14, -5), (26, 1), (26, 4), (-14, 6)], 0, 0.2), by=(0, 1.2, 0), turn=(-90, 0, 0)),
        "chrome",
    )
    rim = [(-14.0, 1.3, -6.0), (-24.0, 1.3, -7.0), (-27.0, 1.3, 0.0), (-24.0, 1.3, 5.0), (-14.0, 1.3, 6.0)]
    a.add("handle", tube(rim, 1.3, closed=True), "wood_beech")


@asset("tl_0058", "TapeMeasure", has_kind=False)
def tape_measure(a: Asset) -> None:
    """Tape measure, slightly extended."""
    a.add("case", block((7.5, 7, 3.6), bevel=1), "MI_SafetyYellow")
    a.add("tape", block((9, 0.15, 2.2), (7.5, 0.4, 0)), "paper")
    a.add("hook", block((0.2, 1.4, 2.2), (12, 0, 0)), "galvanised")


@asset("ct_0410", "can", looks="", has_kind=False)
def paint_can(a: Asset) -> None:
    """Paint can with lid and wire bail."""
    a.add("can", turned([(8.4, 0), (8.4, 18)]), "galvanised")
    a.add("lid", turned([(8.7, 0), (8.7, 1), (7.6, 1)], (0, 18, 0)), "galvanised")
    a.add("label", turned([(8.5, 0), (8.5, 12)], (0, 3, 0)), "plastic_blue")


@asset("sp_btl", looks="", has_kind=False)
def spray_bottle(a: Asset) -> None:
    """Trigger spray bottle."""
    a.add("flask", turned([(4, 0), (4.3, 1), (4.3, 13), (1.6, 18), (1.6, 20)]), "film_clear")
    a.add(
        "trigger",
        merge(block((3, 3, 7), (0, 20, 1.5), 0.5), moved(block((1, 5, 1.4)), by=(0, 15.4, 4), turn=(-15, 0, 0))),
        "plastic_red",
    )


@asset("BenchGrinder_DS200", has_kind=False)
def bench_grinder(a: Asset) -> None:
    """Double-ended bench grinder."""
    a.add("base", block((20, 6, 16), bevel=1), "cast_iron")
    a.add("motor", disc((0, 14, 0), 8, 20, "x"), "lacquer_green")
    a.add("wheels", merge(*(disc((x, 14, 0), 10, 3, "x", 18) for x in (-17.0, 17.0))), "plastic_grey")
    a.add("guards", merge(*(block((5, 14, 20), (x, 14, -3), 1) for x in (-17.0, 17.0))), "lacquer_green")


@asset("ShovelD", has_kind=False)
def shovel(a: Asset) -> None:
    """D-handled shovel, upright, blade down."""
    blade = moved(prism([(-3, 0), (3, 0), (12, 8), (12, 30), (-12, 30), (-12, 8)], -0.4, 0.4), turn=(-8, 0, 0))
    a.add("blade", blade, "steel_grey")
    a.add("shaft", rod((0, 28, -4), (0, 96, -4), 1.7), "wood_beech")
    a.add(
        "grip",
        tube([(0, 95, -4), (-6, 102, -4), (-6, 108, -4), (6, 108, -4), (6, 102, -4)], 1.2, closed=True),
        "plastic_black",
    )


@asset("SM_ToolChest_Body", has_kind=False)
def chest_body(a: Asset) -> None:
    """Carcass of a wheeled tool chest, open to the front."""
    shell = [moved(m, turn=(90, 0, 0), by=(0, 48, 0)) for m in tray((70, 46, 76), 2)]
    a.add("body", merge(*(moved(m, by=(0, 4, -23)) for m in shell)), "lacquer_red")
    a.add("top_mat", block((70, 1, 46), (0, 90, 0)), "rubber_black")
    a.add("casters", merge(*(disc((x, 6, z), 6, 4) for x in (-28.0, 28.0) for z in (-18.0, 18.0))), "rubber_black")


@asset("SM_ToolChest_Drawer", has_kind=False)
def chest_drawer(a: Asset) -> None:
    """One drawer with its front rail."""
    a.add("tray", merge(*tray((65, 14, 40), 1)), "steel_grey")
    a.add("front", block((65, 16, 1.4), (0, 0, 20.7)), "lacquer_red")
    a.add("rail", block((60, 1.6, 1.4), (0, 12.5, 22)), "chrome")


@asset("Stool_Workshop", has_kind=False)
def stool(a: Asset) -> None:
    """Round stool on five feet."""
    a.add("seat", turned([(16, 0), (17, 2), (17, 5), (14, 6)], (0, 52, 0), 16), "rubber_black")
    a.add("column", rod((0, 8, 0), (0, 53, 0), 2.6, 8), "chrome")
    spokes = [moved(rod((0, 9, 0), (24, 4, 0), 1.6), turn=(0, 72.0 * k, 0)) for k in range(5)]
    a.add(
        "feet",
        merge(*spokes, *(moved(turned([(2.4, 0), (2.4, 4)], (24, 0, 0), 8), turn=(0, 72.0 * k, 0)) for k in range(5))),
        "plastic_black",
    )


@asset("Bucket_12L", has_kind=False)
def bucket(a: Asset) -> None:
    """Builder's bucket with wire handle, down on one side."""
    a.add("pail", pail(10.5, 14, 27, 0.7, 16), "plastic_black")
    a.add("bail", tube([(-14, 25, 0), (-11, 17, 12), (0, 13, 15.5), (11, 17, 12), (14, 25, 0)], 0.35), "galvanised")
