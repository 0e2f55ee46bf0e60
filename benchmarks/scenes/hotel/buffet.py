"""The buffet in the middle of the breakfast kitchen."""

from benchmarks.scenes.hotel.kitchen import FORK, KNIFE, PLATE
from benchmarks.scenes.hotel.shapes import ball, box, crate, cup, cyl, drape, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["build_buffet"]

GLASS = (cup(2.8, 3.4, 11, 0.25),)
APPLE = (
    lathe([(0.001, 0.8), (2, 0), (3.8, 3), (3.6, 5.4), (1.6, 6.6), (0.001, 5.6)], 16),
    tube([(0, 5.6, 0), (0.3, 7.6, 0)], 0.15, 5),
)


def build_buffet(hotel: Hotel) -> None:
    """Add the table and what is on it; its frame is turned by 4 degrees."""
    buffet = hotel.group("breakfast_kitchen/buffet", (255, 0, 222), 4)
    legs = [(x, x + 6, 0, 84, z, z + 6) for x in (-118, 112) for z in (-38, 32)]
    buffet.put("buffet_table", slabs((-124, 124, 84, 88, -42, 42), *legs))
    cloth = [(-125, 56), (-125, 86), (-123, 88.2), (0, 88.1), (123, 88.2), (125, 86), (125, 56)]
    buffet.put("tablecloth", drape(cloth, 85, 0.4), (0, 0.1, 0), fixed=True)
    top = buffet.group("on_table", (0, 88.5, 0))
    _chafing(top.group("chafing_dish", (-78, 0, -12)))
    _bread(top.group("bread", (-30, 0, -14), 12))
    _plates(top.group("plates", (-96, 0, 28)))
    _fruit(top.group("fruit", (14, 0, -16), 30))
    _drinks(top.group("drinks", (92, 0, -6), -8))
    _cutlery(top.group("cutlery", (-28, 0, 27), 3))
    stand = top.group("cake", (44, 0, 18))
    stand.put("cake_stand", lathe([(0.001, 0), (8, 0), (1.6, 1), (1.6, 11), (15, 12), (15, 13), (0.001, 13)], 28))
    stand.put("marble_cake", lathe([(3, 0), (10, 0), (10.6, 4), (8, 8), (5, 8), (3, 5), (3, 0)], 24), (0.5, 13, 0))
    dome = lathe(
        [(13, 0), (13, 9), (9, 14), (0.001, 15.6), (0.001, 15.2), (8.8, 13.6), (12.6, 8.8), (12.6, 0), (13, 0)], 28
    )
    stand.put("cake_dome", [dome, ball(3, 3, 3, (0, 15.2, 0))], (0, 13, 0))


def _chafing(place: Group) -> None:
    posts = [tube([(x, 0.5, z), (x, 15, z), (x * 0.97, 15, z)], 0.5, 6) for x in (-27, 27) for z in (-17, 17)]
    rings = [tube([(-27, y, -17), (27, y, -17), (27, y, 17), (-27, y, 17), (-27, y, -17)], 0.5, 6) for y in (1.2, 15)]
    place.put("chafing_stand", [*posts, *rings])
    # Its rim lies on the stand's upper ring.
    pan = slabs(
        (-25.5, 25.5, 4, 4.5, -15.5, 15.5),
        (-26, -25.5, 4, 15.6, -16, 16),
        (25.5, 26, 4, 15.6, -16, 16),
        (-25.5, 25.5, 4, 15.6, -16, -15.5),
        (-25.5, 25.5, 4, 15.6, 15.5, 16),
    )
    rim = slabs(
        (-28, -25.6, 15.6, 16.2, -18, 18),
        (25.6, 28, 15.6, 16.2, -18, 18),
        (-25.6, 25.6, 15.6, 16.2, -18, -15.6),
        (-25.6, 25.6, 15.6, 16.2, 15.6, 18),
    )
    place.put("water_pan", [pan, rim], (0, -0.1, 0), fixed=True)
    food = slabs(
        (-24, 24, 8, 8.5, -14, 14),
        (-24.5, -24, 8, 16.4, -14.5, 14.5),
        (24, 24.5, 8, 16.4, -14.5, 14.5),
        (-24, 24, 8, 16.4, -14.5, -14),
        (-24, 24, 8, 16.4, 14, 14.5),
    )
    lip = slabs(
        (-26.6, -24, 16.4, 16.9, -16.6, 16.6),
        (24, 26.6, 16.4, 16.9, -16.6, 16.6),
        (-24, 24, 16.4, 16.9, -16.6, -14),
        (-24, 24, 16.4, 16.9, 14, 16.6),
    )
    place.put("food_pan", [food, lip], (0, -0.1, 0), fixed=True)
    # The lid is tilted up about its back edge.
    lid = slabs(
        (-27, 27, 8, 8.5, -34, 0),
        (-27, 27, 0, 8, -34.5, -34),
        (-27, 27, 0, 8, -0.5, 0),
        (-27.5, -27, 0, 8, -34.5, 0),
        (27, 27.5, 0, 8, -34.5, 0),
    )
    place.put(
        "chafing_lid",
        [moved(lid, (0, 0, 34.5)), tube([(-6, 8.4, 30), (-6, 11, 30), (6, 11, 30), (6, 8.4, 30)], 0.6, 6)],
        (0, 16.5, -17.2),
        (-72, 0, 0),
        fixed=True,
    )
    for index, x in enumerate((-12, 12), 1):
        place.put(f"fuel_tin_{index:02}", cyl(3.6, 3), (x, 0, 0))
    for index, (x, z) in enumerate(((-12, -4), (-10, 3)), 1):
        sausage = moved(puff(12, 3, 3, 0.7), (0, 0, 0))
        place.put(f"sausage_{index:02}", sausage, (x, 8.5, z), (0, 12 * index, 0), asset="sausage")
    place.put(
        "serving_tongs",
        [tube([(-12, 0.6, 1.6), (0, 0.6, 1.4), (13, 0.6, 0), (0, 0.6, -1.4), (-12, 0.6, -1.6)], 0.4, 6)],
        (14, 9.2, 4),
        (0, 40, 16),
        fixed=True,
    )


def _bread(place: Group) -> None:
    basket = lathe([(0.001, 0), (14, 0), (18, 9), (17.4, 9), (13.4, 0.6), (0.001, 0.6)], 24)
    place.put("bread_basket", basket)
    place.put(
        "basket_napkin", lathe([(0.001, 0.7), (13, 0.7), (15.4, 6), (15.1, 6), (12.8, 1), (0.001, 1)], 24), fixed=True
    )
    for index, (x, y, z) in enumerate(((-6, 1, -4), (5, 1, -6), (-1, 1, 6), (-0.5, 5.8, -1.5)), 1):
        place.put(f"roll_{index:02}", puff(10, 6, 9, 0.8), (x, y, z), (0, 40 * index, 0), asset="bread_roll")


def _plates(place: Group) -> None:
    for index in range(3):
        place.put(f"plate_{index + 1:02}", PLATE, (0, 0.65 * index, 0.2 * (index % 2)), fixed=True, asset="plate")
    bowl = lathe([(0.001, 0), (4, 0), (8, 6), (7.6, 6), (3.8, 0.5), (0.001, 0.5)], 24)
    for index in range(2):
        place.put(f"muesli_bowl_{index + 1:02}", bowl, (26, 1.4 * index, -2), fixed=True, asset="muesli_bowl")


def _fruit(place: Group) -> None:
    place.put("fruit_bowl", lathe([(0.001, 0), (7, 0), (7, 1), (16, 9), (15.4, 9), (6.4, 1.6), (0.001, 1.6)], 28))
    for index, (x, y, z) in enumerate(((-4.2, 2.1, -2), (4, 2.1, -2.6), (0, 1.95, 4.8)), 1):
        place.put(f"apple_{index:02}", APPLE, (x, y, z), (0, 50 * index, 0), fixed=True, asset="apple")
    banana = [
        tube([(-9, 3, z), (-5, 0.9, z * 1.4), (0, 0, z * 1.6), (5, 0.9, z * 1.4), (9, 3.4, 0)], 1.5)
        for z in (-1.4, 1.4)
    ]
    place.put("banana_bunch", banana, (-0.4, 9.8, 0), (0, 20, 0), fixed=True)


def _drinks(place: Group) -> None:
    jug = [
        lathe(
            [(0.001, 0), (6, 0), (7, 10), (5, 20), (5.6, 24), (5.2, 24), (4.6, 20), (6.6, 10), (5.6, 0.5), (0.001, 0.5)]
        ),
        tube([(5, 20, 0), (10, 19, 0), (10, 9, 0), (6.6, 7, 0)], 0.8),
    ]
    place.put("juice_jug", jug, (-14, 0, -12), (0, -60, 0))
    place.put(
        "glass_tray",
        slabs(
            (-15, 15, 0, 0.6, -11, 11),
            (-15, -14.5, 0.6, 2, -11, 11),
            (14.5, 15, 0.6, 2, -11, 11),
            (-14.5, 14.5, 0.6, 2, -11, -10.5),
            (-14.5, 14.5, 0.6, 2, 10.5, 11),
        ),
        (8, 0, 14),
    )
    for index, (x, z) in enumerate(((0, 10), (8.4, 9.6)), 1):
        place.put(f"juice_glass_{index:02}", GLASS, (x, 11.6, z), (180, 0, 0), asset="juice_glass")
    rack = [crate(14, 4, 10, 0.4), tube([(-7, 3.6, 0), (-7, 12, 0), (7, 12, 0), (7, 3.6, 0)], 0.4, 6)]
    place.put("jam_caddy", rack, (14, 0, -13), (0, 10, 0))
    jar = [lathe([(0.001, 0), (2.4, 0), (2.4, 4), (0.001, 4)], 14), cyl(2.5, 1, (0, 4, 0))]
    place.put("jam_jar_01", jar, (12, 0.4, -12.7))


def _cutlery(place: Group) -> None:
    walls = [(x, x + 0.6, 0.6, 10, -11, 11) for x in (-12, -4.3, 3.7, 11.4)]
    ends = [(-11.4, 11.4, 0.6, 10, z, z + 0.6) for z in (-11, 10.4)]
    place.put("cutlery_box", slabs((-12, 12, 0, 0.6, -11, 11), *walls, *ends))
    for index, (x, part, asset) in enumerate(((-8.6, FORK, "fork"), (-0.4, KNIFE, "table_knife")), 1):
        # They stand in their compartment, heads up, leaning on its back.
        y = 10.2
        place.put(f"{asset}_{index:02}", part, (x, y, -6), (-98, 0, 0), fixed=True, asset=asset)
    place.put(
        "napkin_pile",
        [box(16.5, 0.4, 16.5, (0.1 * i, 0.4 * i, 0), (0, 2 * i, 0)) for i in range(6)],
        (26, 0, 2),
        (0, 8, 0),
    )
