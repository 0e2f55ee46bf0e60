"""Trucks, trolleys, ladders and traffic equipment; centimetres, y up, front towards +z."""

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, rod, turned
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import bend, prism, tube


@asset("Forklift_C01", looks="Materials")
def forklift(a: Asset) -> None:
    """Counterbalance truck, mast and forks towards +z."""
    side = [(-120, 28), (70, 28), (70, 62), (30, 62), (-20, 98), (-120, 98)]
    a.add("chassis/body_geo", moved(prism(side, -55, 55), turn=(0, -90, 0)), "steel_orange")
    a.add("chassis/counterweight", block((104, 52, 26), (0, 34, -118), 4), "cast_iron")
    wheels = [disc((x, 26, 46), 26, 22) for x in (-52.0, 52.0)] + [disc((x, 22, -78), 22, 18) for x in (-50.0, 50.0)]
    a.add("wheels", merge(*wheels), "rubber_black")
    posts = [rod((x, 62, 56), (x, 208, 36), 3) for x in (-48.0, 48.0)]
    posts += [rod((x, 96, -84), (x, 208, -64), 3) for x in (-48.0, 48.0)]
    a.add(
        "overhead_guard",
        merge(*posts, *(block((104, 3, 5), (0, 207, -64.0 + 20 * k)) for k in range(6))),
        "plastic_black",
    )
    a.add("seat", merge(block((48, 12, 46), (0, 98, -50), 3), block((46, 52, 10), (0, 108, -70), 3)), "fabric_grey")
    a.add("steering_wheel", disc((0, 112, 10), 17, 3, "y"), "plastic_black")
    mast = [block((8, 230, 12), (x, 8, 82)) for x in (-34.0, 34.0)] + [
        block((60, 8, 8), (0, y, 82)) for y in (60.0, 228.0)
    ]
    a.add("mast", merge(*mast), "steel_grey")
    a.add("carriage", merge(*(block((96, 8, 5), (0, y, 91)) for y in (20.0, 56.0))), "cast_iron")
    forks = [block((12, 56, 4), (x, 8, 95)) for x in (-28.0, 28.0)] + [
        block((12, 4, 110), (x, 6, 150)) for x in (-28.0, 28.0)
    ]
    a.add("forks", merge(*forks), "cast_iron")


@asset("hpt_2500")
def pallet_jack(a: Asset) -> None:
    """Hand pallet truck, forks towards +z."""
    a.documentation = "Hydraulic hand pallet truck, 2500 kg."
    a.add("forks", merge(*(block((16, 5, 116), (x, 5, 58), 1) for x in (-19.0, 19.0))), "MI_SafetyYellow")
    a.add("pump", merge(block((54, 12, 12), (0, 5, -4), 1), rod((0, 17, -8), (0, 40, -8), 6, 10)), "MI_SafetyYellow")
    tiller = [(0.0, 34.0, -8.0), (0.0, 108.0, -40.0)]
    loop = [(0.0, 106.0, -39.0), (-12.0, 116.0, -43.0), (-8.0, 127.0, -48.0), (8.0, 127.0, -48.0), (12.0, 116.0, -43.0)]
    a.add("tiller", merge(tube(tiller, 2), tube([*loop, loop[0]], 1.6)), "plastic_black")
    rollers = [disc((x, 4, 106), 4, 10) for x in (-19.0, 19.0)] + [disc((x, 9, -12), 9, 5) for x in (-7.0, 7.0)]
    a.add("rollers", merge(*rollers), "rubber_black")


@asset("HandTruck_Red")
def hand_truck(a: Asset) -> None:
    """Two-wheeled sack truck, toe plate towards +z."""
    rails = [tube([(x, 6, 0), (x, 108, -6), (x, 120, -16)], 1.6) for x in (-18.0, 18.0)]
    rungs = [rod((-18, y, -0.059 * y), (18, y, -0.059 * y), 1.2) for y in (30.0, 60.0, 90.0)]
    a.add("frame", merge(*rails, *rungs), "lacquer_red")
    a.add("toe_plate", block((44, 1, 24), (0, 1, 12)), "steel_grey")
    a.add("wheels", merge(*(disc((x, 13, -12), 13, 7) for x in (-26.0, 26.0))), "rubber_black")
    a.add("grips", merge(*(rod((x, 120, -16), (x, 126, -28), 2.2) for x in (-18.0, 18.0))), "plastic_black")


@asset("PlatformTrolley")
def trolley(a: Asset) -> None:
    """Flat trolley with push bar at the back."""
    a.add("deck", block((60, 4, 90), (0, 18, 0), 1), "wood_ply")
    bow = [(-28, 20, -43), (-28, 92, -48), *bend((-28, 92, -48), (-28, 98, -48.5), (-22, 98, -48.5), 3)]
    a.add("push_bar", tube([*bow, (22, 98, -48.5), (28, 92, -48), (28, 20, -43)], 1.5), "galvanised")
    a.add("casters", merge(*(disc((x, 8, z), 8, 4) for x in (-23.0, 23.0) for z in (-36.0, 36.0))), "rubber_black")
    a.surfaces["top"] = 22.0


@asset("stp_ldr_5")
def stepladder(a: Asset) -> None:
    """Five-step ladder, opened."""
    front = [rod((x, 0, 46), (x * 0.8, 140, 2), 2) for x in (-26.0, 26.0)]
    back = [rod((x, 0, -44), (x * 0.8, 138, -4), 1.6) for x in (-26.0, 26.0)]
    a.add("stiles", merge(*front, *back), "galvanised")
    a.add(
        "steps", merge(*(block((44, 2.5, 10), (0, y, 44 - 0.314 * y)) for y in (26.0, 54.0, 82.0, 110.0))), "galvanised"
    )
    a.add("platform", block((40, 3, 22), (0, 138, -2)), "plastic_orange")


@asset("Ladder_Extension_4m")
def ladder(a: Asset) -> None:
    """Straight ladder, upright along y."""
    stiles = [block((2.5, 380, 7), (x, 0, 0)) for x in (-20.0, 20.0)]
    rungs = [rod((-20, 20.0 + 28 * k, 0), (20, 20.0 + 28 * k, 0), 1.5, 5) for k in range(13)]
    a.add("ladder_geo", merge(*stiles, *rungs), "galvanised")


@asset("SM_TrafficCone_01")
def cone(a: Asset) -> None:
    """Traffic cone, 50 high."""
    a.add("SM_Cone_base", block((30, 2.5, 30), bevel=0.6), "plastic_black")
    a.add("SM_Cone_body", turned([(11, 0), (2, 47)], (0, 2.5, 0)), "plastic_orange")
    a.add("SM_Cone_band", turned([(8.2, 0), (6, 11)], (0, 18, 0)), "reflex_silver")


@asset("br_120", "br", looks="")
def barrier(a: Asset) -> None:
    """Folding barrier with two boards."""
    a.add("boards", merge(*(block((120, 18, 3), (0, y, 0), 0.5) for y in (40.0, 76.0))), "MI_SafetyYellow")
    a.add(
        "stripes",
        merge(*(block((12, 18.4, 3.4), (x, y, 0)) for x in (-40.0, 0.0, 40.0) for y in (39.8, 75.8))),
        "plastic_black",
    )
    feet = [rod((x, 0, z), (x, 94, 0), 1.6) for x in (-52.0, 52.0) for z in (-24.0, 24.0)]
    a.add("feet", merge(*feet), "galvanised")


@asset("WetFloorSign")
def wet_floor_sign(a: Asset) -> None:
    """Folding caution sign."""
    leaf = block((28, 62, 1.2), bevel=0.3)
    sides = [moved(leaf, by=(0, 0, z), turn=(t, 0, 0)) for z, t in ((13.0, -12.0), (-13.0, 12.0))]
    a.add("sign", merge(*sides), "MI_SafetyYellow")


@asset("ConveyorRoller_300")
def conveyor(a: Asset) -> None:
    """Roller conveyor, 300 long along x, 75 high."""
    a.add("rails", merge(*(block((300, 12, 4), (0, 66, z)) for z in (-30.0, 30.0))), "steel_blue")
    a.add(
        "rollers",
        copies(rod((0, 73, -28), (0, 73, 28), 2.5), [(-143.0 + 19 * k, 0, 0) for k in range(16)]),
        "galvanised",
    )
    feet = [block((6, 66, 6), (x, 0, z)) for x in (-130.0, 0.0, 130.0) for z in (-30.0, 30.0)]
    a.add("supports", merge(*feet, *(block((4, 4, 56), (x, 20, 0)) for x in (-130.0, 0.0, 130.0))), "steel_grey")
    a.add("motor", block((30, 16, 18), (90, 46, 0), 2), "plastic_black")
    a.surfaces["top"] = 75.5
