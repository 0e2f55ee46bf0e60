"""The shell: floor, ceiling, walls, doors, the shop window and the lamps of the rooms behind."""

from benchmarks.scenes.bakery.forms import bar, block, column, orb, panels
from benchmarks.scenes.bakery.layout import Area

__all__ = ["build_shell"]

H = 290.0


def build_shell(world: Area) -> None:
    """Add what was built: the shop is at z > 450, the bakehouse at z < 440, the small rooms are at x > 760."""
    shell = world.area("Building")
    shell.fix("floor", panels((-25, 1175, -20, 0, -25, 925)))
    shell.fix("ceiling", panels((-25, 1175, H, H + 20, -25, 925)))
    shell.fix(
        "walls_outer",
        panels(
            (-25, 0, 0, H, -25, 925),
            (1150, 1175, 0, H, -25, 925),
            (0, 1150, 0, H, -25, 0),
            (0, 100, 0, H, 900, 925),
            (100, 420, 0, 80, 900, 925),
            (100, 420, 230, H, 900, 925),
            (420, 560, 0, H, 900, 925),
            (560, 660, 215, H, 900, 925),
            (660, 1150, 0, H, 900, 925),
        ),
    )
    shell.fix(
        "wall_bakehouse", panels((0, 400, 0, H, 440, 450), (400, 490, 205, H, 440, 450), (490, 750, 0, H, 440, 450))
    )
    openings = [(120, 210), (480, 570), (610, 690)]
    walls = [(750.0, 760.0, 205.0, H, float(a), float(b)) for a, b in openings]
    edges = [0, *[edge for opening in openings for edge in opening], 900]
    walls += [(750.0, 760.0, 0.0, H, float(a), float(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    shell.fix("wall_side", panels(*walls))
    shell.fix("wall_store", panels((760, 1150, 0, H, 290, 300)))
    shell.fix("wall_toilet", panels((760, 1150, 0, H, 590, 600)))
    window = [(100.3, 419.7, 80.3, 86, 908, 916), (100.3, 419.7, 224, 229.7, 908, 916), (100.3, 106, 86, 224, 908, 916)]
    window += [(414, 419.7, 86, 224, 908, 916), (256, 264, 86, 224, 908, 916), (105, 415, 85, 225, 911, 912)]
    shell.fix("shop_window", panels(*window))
    shell.fix("window_sill", panels((100.2, 419.8, 80.1, 82.5, 884, 907.8)))
    _door(shell.area("ShopDoor", (560.4, 0, 912), 0), 99.2, 214.6)
    _door(shell.area("BakehouseDoor", (402.2, 0, 445), 70), 87.4, 204.6)
    _door(shell.area("StoreDoor", (755, 0, 209.6), 90), 89.2, 204.6)
    _door(shell.area("OfficeDoor", (755, 0, 569.6), 90), 89.2, 204.6)
    _door(shell.area("ToiletDoor", (755, 0, 689.6), 90), 79.2, 204.6)
    tube_light = [block(120, 5, 14, (0, 0, 0)), column(1.3, 116, (-58, -1.1, 0), (0, 0, -90))]
    for number, (x, z, turn) in enumerate([(250, 220, 0), (580, 220, 0), (955, 145, 90)], start=1):
        shell.fix(f"tube_light_{number:02}", tube_light, (x, H - 5.2, z), (0, turn, 0), "tube_light")
    for number, (x, z) in enumerate([(955, 445), (955, 750)], start=1):
        shell.fix(f"dome_light_{number:02}", [column(17, 3, (0, -3, 0)), orb(15, (0, -10, 0), 0.3)], (x, H - 0.1, z))


def _door(door: Area, w: float, h: float) -> None:
    """Add a leaf along x from its hinges, and its handle."""
    door.fix("leaf", panels((0, w, 0.4, h, -2, 2)))
    x, y = w - 7, 104
    handle = [bar((x, y, -6), (x, y, 6), 0.9), *(bar((x, y, s * 5.6), (x - 12, y, s * 5.6), 0.8) for s in (-1, 1))]
    handle += [block(4, 16, 0.8, (x, y - 10, s * 2.3)) for s in (-1, 1)]
    door.fix("handle", handle)
