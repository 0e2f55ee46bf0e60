"""Floor, walls, ceiling, doors and windows, and what is mounted on walls and ceiling of the corridor."""

from benchmarks.scenes.hotel.shapes import box, crate, cup, cyl, lathe, moved, slabs, tube
from benchmarks.scenes.hotel.stage import Hotel

__all__ = ["build_corridor", "build_shell"]

HEIGHT = 260.0
HANDLE = (
    cyl(2.6, 1.0, (0, -0.5, 0.5), (90, 0, 0)),
    tube([(0, 0, 0.5), (0, 0, 5), (1.5, 0, 6), (12, 0, 6)], 0.9),
)
SPRINKLER = lathe([(0.001, 0), (1.8, 0), (1.8, 0.3), (0.5, 0.8), (0.7, 3), (3, 3.2), (3, 4), (0.001, 4)], 12)
DETECTOR = lathe([(0.001, 0), (3, 0), (5, 1.5), (5, 4), (0.001, 4)])


def build_shell(hotel: Hotel) -> None:
    """Add floor, walls, ceiling, doors and windows."""
    shell = hotel.group("building")
    shell.put("floor_slab", slabs((0, 1200, -20, 0, 0, 590), (0, 390, -20, 0, 590, 800)), fixed=True)
    shell.put(
        "outer_walls",
        slabs(
            (0, 10, 0, HEIGHT, 0, 800),
            (10, 120, 0, HEIGHT, 0, 10),
            (120, 360, 0, 90, 0, 10),
            (120, 360, 220, HEIGHT, 0, 10),
            (360, 860, 0, HEIGHT, 0, 10),
            (860, 1060, 0, 110, 0, 10),
            (860, 1060, 210, HEIGHT, 0, 10),
            (1060, 1200, 0, HEIGHT, 0, 10),
            (1190, 1200, 0, HEIGHT, 10, 590),
            (390, 1190, 0, HEIGHT, 580, 590),
            (380, 390, 0, HEIGHT, 590, 790),
            (10, 390, 0, HEIGHT, 790, 800),
        ),
        fixed=True,
    )
    shell.put(
        "partition_walls",
        slabs(
            (480, 490, 0, HEIGHT, 10, 210),
            (480, 490, 205, HEIGHT, 210, 290),
            (480, 490, 0, HEIGHT, 290, 420),
            (490, 710, 0, HEIGHT, 300, 310),
            (710, 720, 0, HEIGHT, 10, 420),
            (10, 385, 0, HEIGHT, 420, 430),
            (385, 475, 205, HEIGHT, 420, 430),
            (475, 760, 0, HEIGHT, 420, 430),
            (760, 860, 205, HEIGHT, 420, 430),
            (860, 1190, 0, HEIGHT, 420, 430),
            (10, 150, 0, HEIGHT, 580, 590),
            (150, 240, 205, HEIGHT, 580, 590),
            (240, 390, 0, HEIGHT, 580, 590),
        ),
        fixed=True,
    )
    ceiling = ((0, 1200, HEIGHT, HEIGHT + 15, 0, 590), (0, 390, HEIGHT, HEIGHT + 15, 590, 800))
    shell.put("ceiling_slab", slabs(*ceiling), fixed=True)
    doors = hotel.group("building/doors")
    for name, width, at, yaw in (
        ("room_door", 89, (430, 0.5, 424), 0),
        ("bath_door", 79, (441.5, 0.5, 287.5), 180),
        ("linen_door", 89, (245.7, 0.5, 635.5), 100),
        ("kitchen_door", 99, (810, 0.5, 425), 0),
    ):
        group = doors.group(name, at, yaw)
        group.put("leaf", box(width, 204, 4), fixed=True)
        if name == "kitchen_door":
            group.put("porthole", cyl(16, 4.6, (0, 145, 0), (90, 0, 0)), fixed=True)
            continue
        group.put("handle_out", HANDLE, (-width / 2 + 6, 104, 2), fixed=True, asset="door_handle")
        group.put("handle_in", HANDLE, (-width / 2 + 6, 104, -2), (180, 0, 0), fixed=True)
    _fit_room_door(hotel)
    _build_windows(hotel)


def _fit_room_door(hotel: Hotel) -> None:
    door = hotel.group("building/doors/room_door/fittings")
    door.put("room_number_sign", box(10, 10, 0.4, (0, 150, 2.25)), fixed=True)
    door.put("peephole", cyl(0.9, 4.8, (0, 146.6, 0), (90, 0, 0)), fixed=True)
    door.put("escape_plan", box(21, 29.7, 0.3, (0, 112, -2.2)), fixed=True)
    ring = [(0, 12, 0), (-3.5, 10, 0), (-4, 6, 0), (0, 2.4, 0), (4, 6, 0), (3.5, 10, 0), (0, 12, 0)]
    # The loop of the sign goes around the neck of the inner handle.
    door.put(
        "do_not_disturb_sign",
        [tube(ring, 0.35), box(9, 20, 0.5, (0, -17.8, 0))],
        (-38.5, 93.3, -5),
        (0, 0, 4),
        fixed=True,
    )


def _build_windows(hotel: Hotel) -> None:
    windows = hotel.group("building/windows")
    for name, width, height, at in (
        ("guest_window", 240, 130, (240, 90, 4)),
        ("kitchen_window", 200, 100, (960, 110, 4)),
    ):
        x = width / 2
        group = windows.group(name, at)
        frame = slabs(
            (-x, -x + 5, 0, height, -3, 3),
            (x - 5, x, 0, height, -3, 3),
            (-x + 5, x - 5, 0, 5, -3, 3),
            (-x + 5, x - 5, height - 5, height, -3, 3),
            (-2.5, 2.5, 5, height - 5, -3, 3),
        )
        group.put("frame", frame, fixed=True)
        for side, offset in (("L", -x / 2 + 1.25), ("R", x / 2 - 1.25)):
            group.put(f"pane_{side}", box(x - 7.6, height - 10.2, 1.2, (offset, 5.1, 0)), fixed=True)


def build_corridor(hotel: Hotel) -> None:
    """Add the corridor's runner, lights, signs, extinguisher, console and plant; the trolley is apart."""
    corridor = hotel.group("corridor", (600, 0, 505))
    corridor.put("carpet_runner", box(1140, 0.8, 80))
    for index, x in enumerate((-300, 300), 1):
        lamp = (cyl(16, 2, (0, 5.8, 0)), lathe([(0.001, 0), (12, 1.5), (15, 6), (0.001, 6)]))
        corridor.put(f"ceiling_light_{index:02}", lamp, (x, HEIGHT - 7.7, 0), fixed=True, asset="ceiling_light")
    corridor.put("smoke_detector", DETECTOR, (-210, HEIGHT - 4.2, 10), fixed=True, asset="smoke_detector")
    corridor.put(
        "exit_sign", [box(34, 16, 3), box(4, 8, 2, (0, 16, 0))], (360, HEIGHT - 24, -20), (0, 90, 0), fixed=True
    )
    corridor.put(
        "handrail", tube([(60, 90, 70), (60, 90, 66), (480, 90, 66), (480, 90, 70)], 1.8), (0, 0, 4.9), fixed=True
    )
    for index, x in enumerate((180, 340), 1):
        corridor.put(
            f"framed_print_{index:02}", box(60, 45, 2.5), (x, 130, 73.5), (0, 0, (0, 0.8)[index - 1]), fixed=True
        )
    corridor.put(
        "extinguisher_bracket",
        (
            slabs((-4, 4, 0, 40, 0, 1.2), (-6, 6, 6, 7, 1.2, 16)),
            moved(lathe([(8.2, 0), (8.6, 0), (8.6, 3), (8.2, 3), (8.2, 0)]), (0, 30, 9.6)),
        ),
        (-100, 70, -74.8),
        fixed=True,
    )
    corridor.put(
        "fire_extinguisher",
        [
            lathe([(0.001, 0), (7.5, 0), (8, 2), (8, 38), (5, 44), (2, 46), (2, 49), (0.001, 49)]),
            tube([(0, 47, 0), (5, 47, 3), (10, 35, 4), (10, 12, 3)], 0.9),
            box(3, 3, 9, (0, 49, 3)),
        ],
        (-100, 77.1, -65.2),
        (0, 0, 0),
        fixed=True,
    )
    console = corridor.group("console", (-120, 0, 58), 180)
    legs = [(x, x + 4, 0, 76, z, z + 4) for x in (-50, 46) for z in (-14, 10)]
    console.put("console_table", slabs(*legs, (-52, 52, 76, 79, -15, 15), (-46, 46, 20, 22, -12, 12)))
    console.put("key_dish", cup(6, 9, 3, 0.4), (34, 79, 2))
    console.put("lost_key_card", box(8.5, 0.2, 5.4), (34.5, 79.5, 2.3), (0, 35, 2))
    console.put("shoe_polish_basket", crate(40, 16, 20, 0.8), (0, 22, 0))
    console.put("shoe_brush", [box(16, 2, 5), box(15, 2, 4.4, (0, 2, 0))], (-8, 22.8, 1), (0, 20, 0))
