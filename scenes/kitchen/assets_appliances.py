"""Appliances; centimetres, front towards +z; fitted ones have their back at z = 0."""

from scenes.writer.assets import Asset, Hinge, asset
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import arc, bend, box, circle, cylinder, ellipsoid, lathe, panel, sweep, tube


@asset()
def fridge_freezer(a: Asset) -> None:
    a.looks = "mtl"
    x, deep = 29.9, 58.0
    walls = [
        box((-x, 3, 0), (-x + 4, 185, deep), 0.4),
        box((x - 4, 3, 0), (x, 185, deep), 0.4),
        box((-x + 4, 181, 0), (x - 4, 185, deep)),
        box((-x + 4, 3, 0), (x - 4, 10, deep)),
        box((-x + 4, 62, 0), (x - 4, 68, deep)),
        box((-x + 4, 10, 0), (x - 4, 62, 4)),
        box((-x + 4, 68, 0), (x - 4, 181, 4)),
    ]
    a.add("cabinet/body_geo", merge(*walls), "lacquer_white")
    a.add(
        "cabinet/feet",
        copies(cylinder((0, 0, 0), 2, 3, 0, 12), [(p, 0, q) for p in (-25, 25) for q in (5, 52)]),
        "plastic_black",
    )
    levels = [92.0, 116.0, 142.0]
    a.add("shelves/shelf_glass", merge(*(box((-25.6, y, 4.2), (25.6, y + 0.8, 50)) for y in levels)), "glass_clear")
    a.add("shelves/edge_trim", merge(*(box((-25.6, y - 0.2, 50), (25.6, y + 1, 51)) for y in levels)), "plastic_white")
    for name, low, high in (("door_upper", 66.0, 185.0), ("door_freezer", 3.2, 65.4)):
        a.add(f"{name}/panel_geo", box((-x, low, deep + 0.2), (x, high, deep + 6.2), 0.8), "lacquer_white")
        grip_low, grip_high = (low + 4, low + 44) if name == "door_upper" else (high - 28, high - 3)
        front = deep + 6.2
        bar = [
            (24.0, grip_low, front),
            (24.0, grip_low, front + 4),
            (24.0, grip_high, front + 4),
            (24.0, grip_high, front),
        ]
        a.add(f"{name}/handle", tube(bar, 0.8, 10), "brushed_steel")
        a.subcomponents.append(name)
        a.hinges.append(Hinge(name, (-x, 0.0, deep + 3), -100.0))
    racks = [box((-24, y, deep - 6), (24, y + 5, deep - 0.2)) for y in (84.0, 122.0)]
    a.add("door_upper/bottle_shelf", merge(*racks), "plastic_white")
    a.add_proxy("cabinet/body_COL", box((-x, 0, 0), (x, 185, deep + 6.2)))
    a.surfaces.update(floor=68.0, s1=92.8, s2=116.8, s3=142.8)


@asset()
def oven_builtin(a: Asset) -> None:
    x, deep = 29.8, 56.0
    walls = [
        box((-x, 10, 0), (-23, 86, deep)),
        box((23, 10, 0), (x, 86, deep)),
        box((-23, 64, 0), (23, 86, deep)),
        box((-23, 10, 0), (23, 26, deep)),
        box((-23, 26, 0), (23, 64, 8)),
    ]
    a.add("housing_geo", merge(*walls), "plastic_grey")
    a.add("plinth", box((-x, 0, 4), (x, 10, 50)), "plastic_black")
    a.add("fascia", box((-x, 72.5, deep), (x, 85.6, deep + 2), 0.3), "brushed_steel")
    a.add("display", box((-6, 76, deep + 2), (6, 82, deep + 2.2)), "screen_dark")
    wires = [tube([(p, 40, 9), (p, 40, 52)], 0.25, 6) for p in (-18.0, -12.0, -6.0, 0.0, 6.0, 12.0, 18.0)]
    wires += [tube([(-22.8, 40, q), (22.8, 40, q)], 0.25, 6) for q in (9.0, 30.0, 52.0)]
    a.add("grid_rack", merge(*wires), "chrome")
    frame = moved(panel((59.2, 57, 3.4), [(9, 10, 50, 42)]), by=(-29.6, 14.5, deep + 3.6))
    a.add("door/frame_geo", frame, "brushed_steel")
    a.add("door/pane", box((-20.6, 24.5, deep + 0.6), (20.4, 56.5, deep + 3.2)), "glass_clear")
    front = deep + 3.6
    bar = [(-22.0, 66.0, front), (-22.0, 66.0, front + 4), (22.0, 66.0, front + 4), (22.0, 66.0, front)]
    a.add("door/handle", tube(bar, 0.8, 10), "chrome")
    a.subcomponents.append("door")
    a.surfaces["inside"] = 40.25


@asset()
def oven_knob(a: Asset) -> None:
    skirt = [(0.0, 0.0), (2.2, 0.0), (2.2, 0.4), (1.8, 0.6), (1.7, 2.4), (0.0, 2.4)]
    a.add("knob_geo", moved(lathe(skirt), turn=(90, 0, 0)), "plastic_black")
    a.add("mark", box((-0.15, 0.2, 2.4), (0.15, 1.6, 2.5)), "plastic_white")


@asset()
def hob_ceramic(a: Asset) -> None:
    a.add("glass_geo", box((-29, 0, -25.5), (29, 0.6, 25.5), 0.2), "glass_black")
    zones = []
    for x, z, radius in ((-14, -11, 10.5), (14, -11, 8.0), (-14, 12, 8.0), (14, 12, 10.5)):
        ring = lathe([(radius, 0.64), (radius - 0.4, 0.64)])
        zones.append(moved(ring, by=(x, 0, z)))
    a.add("zones", merge(*zones), "plastic_grey")
    a.surfaces["top"] = 0.64


@asset()
def dishwasher_60(a: Asset) -> None:
    a.add("body_geo", box((-29.8, 10, 0), (29.8, 85.9, 55.8)), "plastic_grey")
    a.add("plinth", box((-29.8, 0, 4), (29.8, 10, 50)), "plastic_black")
    a.add("door/front_geo", box((-29.7, 10.2, 56), (29.7, 74, 58), 0.3), "brushed_steel")
    a.add("door/controls", box((-29.7, 74.4, 56), (29.7, 85.8, 58), 0.3), "plastic_black")
    buttons = copies(box((-1, 79, 58), (1, 81, 58.4), 0.2), [(8 + 4 * k, 0, 0) for k in range(5)])
    a.add("door/buttons", buttons, "plastic_white")
    bar = [(-18.0, 68.0, 58.0), (-18.0, 68.0, 61.0), (18.0, 68.0, 61.0), (18.0, 68.0, 58.0)]
    a.add("door/handle", tube(bar, 0.7), "brushed_steel")
    a.subcomponents.append("door")


@asset()
def microwave(a: Asset) -> None:
    a.add("body_geo", box((-24, 1.5, -18), (24, 28, 16), 0.8), "plastic_black")
    a.add("door/frame_geo", box((-23.5, 2.5, 16), (11, 27, 17.6), 0.3), "brushed_steel")
    a.add("door/window", box((-19, 6.5, 17.6), (5, 23, 17.8)), "screen_dark")
    bar = [(8.5, 6.0, 17.6), (8.5, 6.0, 20.2), (8.5, 23.5, 20.2), (8.5, 23.5, 17.6)]
    a.add("door/handle", tube(bar, 0.6), "chrome")
    a.add("panel/fascia", box((11.4, 2.5, 16), (23.5, 27, 17.6), 0.3), "plastic_grey")
    a.add("panel/display", box((13, 22, 17.6), (22, 25, 17.8)), "screen_dark")
    for k, y in enumerate((16.0, 9.0)):
        dial = moved(lathe([(0, 0), (2.4, 0), (2.0, 1.8), (0, 1.8)]), by=(17.5, y, 17.6), turn=(90, 0, 0))
        a.add(f"panel/dial_{k + 1}", dial, "chrome")
    feet = [(x, 0, z) for x in (-20, 20) for z in (-14, 12)]
    a.add("feet", copies(cylinder((0, 0, 0), 1.4, 1.5, 0, 10), feet), "plastic_black")
    a.subcomponents.append("door")


@asset()
def toaster(a: Asset) -> None:
    a.add("shell_geo", box((-14, 1.2, -8.5), (14, 18.5, 8.5), 3.2), "enamel_red")
    a.add("base", box((-13, 0, -7.5), (13, 1.4, 7.5), 0.3), "plastic_black")
    a.add(
        "slots",
        merge(box((-10, 18.5, -4.6), (10, 18.7, -1.6)), box((-10, 18.5, 1.6), (10, 18.7, 4.6))),
        "plastic_black",
    )
    a.add(
        "lever", merge(box((14, 4, -0.5), (14.3, 14, 0.5)), box((14, 11.4, -2), (16.6, 12.8, 2), 0.4)), "plastic_black"
    )
    a.add("dial", moved(cylinder((0, 0, 0), 1.4, 1.2, 0.2, 14), by=(14, 7, 4.6), turn=(0, 0, -90)), "chrome")
    a.add("bread_slice_LOW", box((-6, 15, -4.1), (6, 21, -2.1), 0.6), "crust")


@asset()
def kettle_electric(a: Asset) -> None:
    a.add("base_geo", cylinder((0, 0, 0), 8.2, 2, 0.4, 28), "plastic_black")
    body = [(0.0, 2.1), (7.6, 2.1), (7.9, 3), (7.4, 10), (6.2, 18), (5.6, 20.2), (0, 20.2)]
    a.add("body_geo", lathe(body), "brushed_steel")
    a.add("lid", lathe([(0, 20.2), (5.2, 20.2), (4.6, 21.4), (1.2, 21.8), (1.2, 23), (0, 23.2)]), "plastic_black")
    spout = sweep([(0, 14.5, 5.4), (0, 17.5, 7.6), (0, 19.6, 9.4)], circle(2.2, 8, 0.8), widths=[1.0, 0.8, 0.55])
    a.add("spout", spout, "brushed_steel")
    grip = [(0.0, 19.0, -5.0), *bend((0, 19.5, -8), (0, 19.5, -12), (0, 15, -12)), (0.0, 10.0, -11.2)]
    a.add("handle", sweep([*grip, (0, 6.5, -7.0)], circle(1.0, 8)), "plastic_black")


@asset()
def coffee_maker(a: Asset) -> None:
    a.add("base_geo", box((-11, 0, -13), (11, 4, 14), 0.8), "plastic_black")
    a.add("tank/column_geo", box((-11, 4, -13), (11, 24, -2), 0.6), "plastic_black")
    a.add("head_geo", box((-11, 24, -13), (11, 35, 12), 1.2), "brushed_steel")
    a.add("filter_cone", moved(lathe([(0, 0), (2.5, 0), (6.5, 4), (0, 4)]), by=(0, 20, 5.5)), "plastic_black")
    a.add("warm_plate", cylinder((0, 4, 5.5), 7.2, 0.4, 0.1, 24), "chrome")
    a.add("switch", box((7, 1.2, 14), (9, 2.8, 14.6), 0.2), "enamel_red")
    a.surfaces["plate"] = 4.4


@asset()
def coffee_jug(a: Asset) -> None:
    outer = [(0.0, 0.0), (5.4, 0.0), (6.2, 1.0), (6.4, 5), (5.4, 9.4), (4.2, 11.4), (4.5, 13)]
    inner = [(4.2, 13.0), (3.9, 11.4), (5.1, 9.3), (6.1, 5), (5.9, 1.2), (0, 0.5)]
    a.add("glass_geo", lathe([*outer, *inner]), "glass_clear")
    a.add("coffee", lathe([(0, 0.6), (5.7, 0.6), (5.95, 1.4), (6.0, 5.0), (5.9, 5.6), (0, 5.6)]), "cocoa")
    a.add("lid", lathe([(0, 13.02), (4.7, 13.02), (4.5, 14), (0, 14.4)]), "plastic_black")
    grip = [(0.0, 12.4, 4.3), *bend((0, 12.8, 7), (0, 12.8, 10), (0, 9, 10)), (0.0, 5.0, 9.2), (0.0, 3.6, 6.3)]
    a.add("handle", sweep(grip, circle(0.9, 6)), "plastic_black")


@asset()
def blender_jug(a: Asset) -> None:
    foot = [(0.0, 0.0), (8.5, 0.0), (8.5, 1.2), (7.6, 8), (5.8, 13), (0, 13)]
    a.add("motor_geo", lathe(foot), "enamel_cream")
    outer = [(0.0, 13.1), (5.0, 13.1), (5.2, 14), (7.4, 33)]
    a.add("jar_glass", lathe([*outer, (7.0, 33), (4.8, 14.4), (0, 14.4)]), "glass_clear")
    a.add("blades", merge(*(moved(box((-3, 15, -0.4), (3, 15.2, 0.4)), turn=(0, d, 0)) for d in (0, 90))), "chrome")
    a.add("lid_LOW", lathe([(0, 33.05), (7.6, 33.05), (7.4, 35), (2.4, 35.4), (2.2, 37.4), (0, 37.6)]), "plastic_black")
    grip = [(0.0, 31.0, 7.0), *bend((0, 31, 10), (0, 31, 12.5), (0, 27, 12.2)), (0.0, 20.0, 10.6), (0.0, 17.5, 5.6)]
    a.add("handle", sweep(grip, circle(1.0, 6)), "plastic_black")
    dial = moved(lathe([(0, 0), (2.2, 0), (1.9, 1.4), (0, 1.4)]), by=(0, 5.5, 7.6), turn=(80, 0, 0))
    a.add("dial", dial, "chrome")


@asset()
def kitchen_scale(a: Asset) -> None:
    a.add("base_geo", box((-9, 0.4, -11), (9, 2.2, 11), 0.5), "plastic_white")
    a.add("plate_geo", cylinder((0, 2.2, -2), 8.2, 0.6, 0.2, 28), "brushed_steel")
    a.add("display", box((-3.5, 2.2, 7), (3.5, 2.35, 9.6)), "screen_dark")
    a.add(
        "feet",
        copies(cylinder((0, 0, 0), 0.8, 0.5, 0, 8), [(x, 0, z) for x in (-7, 7) for z in (-9, 9)]),
        "plastic_black",
    )


@asset()
def tablet_10(a: Asset) -> None:
    a.add("case_geo", box((-12.5, 0, -8.7), (12.5, 0.7, 8.7), 0.25), "plastic_grey")
    a.add("screen", box((-11.7, 0.7, -7.9), (11.7, 0.74, 7.9)), "screen_dark")


@asset()
def radio_retro(a: Asset) -> None:
    a.add("cabinet_geo", box((-14, 0.6, -5), (14, 17, 5), 1.2), "oak_light")
    a.add("speaker", moved(cylinder((0, 0, 0), 5.6, 0.4, 0.1, 24), by=(-6, 9, 5), turn=(90, 0, 0)), "fabric_linen")
    a.add("scale", box((2, 10, 5), (12, 14.5, 5.3)), "paper_white")
    knobs = [
        moved(lathe([(0, 0), (1.6, 0), (1.4, 1.4), (0, 1.4)]), by=(x, 5.4, 5), turn=(90, 0, 0)) for x in (4.2, 9.8)
    ]
    a.add("knobs", merge(*knobs), "brass")
    a.add("antenna", tube([(12, 16.8, -3), (17, 38, -3)], 0.2, 6), "chrome")
    a.add(
        "feet",
        copies(cylinder((0, 0, 0), 0.8, 0.8, 0, 8), [(x, 0, z) for x in (-11, 11) for z in (-3, 3)]),
        "plastic_black",
    )


@asset()
def smoke_alarm(a: Asset) -> None:
    profile = [(0.0, -4.0), *arc((3.6, -2.6), 1.4, -90, 0, 4), (5.6, -1.4), (5.6, -0.05), (0, -0.05)]
    a.add("housing_geo", lathe(profile), "plastic_white")
    a.add("led", ellipsoid((2, -4, 0), (0.3, 0.15, 0.3), 8), "enamel_red")
