"""The walls, doors, window and lamps of the practice."""

from benchmarks.scenes.vet.shapes import box, cyl, rod, slabs
from benchmarks.scenes.vet.stage import Practice

__all__ = ["build_shell"]

TOP = 2700.0


def build_shell(practice: Practice) -> None:
    """Add floor, ceiling, walls and what is set in them."""
    shell = practice.group("Shell")
    shell.put("FloorSlab", slabs((-250, 9850, -250, 7250, -200, 0)), fixed=True)
    shell.put("CeilingSlab", slabs((-250, 9850, -250, 7250, TOP, TOP + 180)), fixed=True)
    shell.put(
        "OuterWalls",
        slabs(
            (-250, 0, -250, 7250, 0, TOP),
            (9600, 9850, -250, 7250, 0, TOP),
            (0, 9600, 7000, 7250, 0, TOP),
            (0, 700, -250, 0, 0, TOP),
            (700, 1700, -250, 0, 2100, TOP),
            (1700, 6200, -250, 0, 0, TOP),
            (6200, 7600, -250, 0, 0, 900),
            (6200, 7600, -250, 0, 2100, TOP),
            (7600, 9600, -250, 0, 0, TOP),
        ),
        fixed=True,
    )
    partition = [
        (
            "Partition_A",
            [(0, 5000, 3350, 3450, 0, TOP), (5000, 5900, 3350, 3450, 2050, TOP), (5900, 9600, 3350, 3450, 0, TOP)],
        ),
        (
            "Partition_B",
            [(4650, 4750, 0, 300, 0, TOP), (4650, 4750, 300, 1200, 2050, TOP), (4650, 4750, 1200, 3350, 0, TOP)],
        ),
        (
            "Partition_C",
            [(3950, 4050, 3450, 3700, 0, TOP), (3950, 4050, 3700, 4600, 2050, TOP), (3950, 4050, 4600, 7000, 0, TOP)],
        ),
        (
            "Partition_D",
            [(7550, 7650, 3450, 3700, 0, TOP), (7550, 7650, 3700, 4700, 2150, TOP), (7550, 7650, 4700, 7000, 0, TOP)],
        ),
    ]
    for name, slab in partition:
        shell.put(name, slabs(*slab), fixed=True)
    _doors(practice)
    window = practice.group("Shell/Window", (6900, 0, 900))
    frame = [(-698, -640, -120, -50, 2, 1198), (640, 698, -120, -50, 2, 1198), (-640, 640, -120, -50, 2, 60)]
    window.put("Frame", slabs(*frame, (-640, 640, -120, -50, 1140, 1198), (-642, 642, -90, -82, 58, 1142)), fixed=True)
    window.put("Sill", box(1394, 210, 30, (0, 55, 1)), fixed=True)
    window.put(
        "Blind",
        [cyl(26, 1360, (-680, 30, 1240), (0, 90, 0)), box(1340, 2, 420, (0, 55, 822)), box(1340, 12, 24, (0, 55, 800))],
        fixed=True,
    )
    lamp = [box(600, 600, 40), box(560, 560, 4, (0, 0, -4))]
    for index, (x, y) in enumerate([(1500, 1700), (7200, 1900), (2000, 5200)]):
        shell.put(f"CeilingPanel_{index + 1}", lamp, (x, y, TOP - 41), fixed=True, block="LightPanel")


def _doors(practice: Practice) -> None:
    doors = [
        ("Door_Entrance", 1000, 2100, (700, -120, 0), 0),
        ("Door_Consult", 900, 2050, (4762, 1192, 0), 7),
        ("Door_Theatre", 900, 2050, (5000, 3400, 0), 0),
        ("Door_Kennel", 900, 2050, (4000, 3704, 0), 65),
    ]
    for name, w, h, at, yaw in doors:
        # The origin is the hinge, the leaf extends along x.
        group = practice.group(f"Shell/{name}", at, yaw)
        group.put("Leaf", box(w - 8, 40, h - 12, (w / 2, 0, 6)), fixed=True)
        lever = [rod((w - 70, -60, 1040), (w - 70, 60, 1040), 9)]
        lever += [rod((w - 70, s * 58, 1040), (w - 190, s * 58, 1040), 8) for s in (-1, 1)]
        group.put("Lever", lever, fixed=True)
