"""The laid dining table with its chairs, and the breakfast bar."""

from __future__ import annotations

from .layout import INSTANCE, Extras, Frame, Layout, kg

TABLE = Frame(90, 80)
"""Centre of the dining table."""
_EDGES = (
    (-40.0, 45.0, 0.0),
    (40.0, 45.0, 0.0),
    (90.0, 0.0, 90.0),
    (40.0, -45.0, 180.0),
    (-40.0, -45.0, 180.0),
    (-90.0, 0.0, -90.0),
)
"""Middle of the table's edge in front of each seat, and the heading away from the table."""
_CHAIR_NAMES = ("chair_01", "chair_02", "silla_3", "chair_04", "chair_05", "chair_06")


def place_dining(scene: Layout, floor: str) -> None:
    """Rug, table, six chairs and six settings."""
    group = scene.group("diningArea")
    rug = scene.put(f"{group}/rug", "area_rug", (90, 80), on=floor)
    table = scene.put(f"{group}/diningTable", "dining_table", (0, 0), on=rug, frame=TABLE, extras=kg(38))
    for k, (x, z, yaw) in enumerate(_EDGES):
        seat = TABLE.within(x, z, yaw)
        push = (12.0, 14.5, 11.5, 12.5, 12.0, 13.0)[k]
        name = f"{group}/{_CHAIR_NAMES[k]}"
        extras = kg(5.2) if k == 0 else None
        chair = scene.put(name, "dining_chair", (0, push), on=rug, frame=seat, turn=(0, 180, 0), extras=extras)
        if k in (1, 2):
            cushion = f"{group}/seatCushion_{k}"
            spot = (0, push - 1.6)
            scene.put(cushion, "seat_cushion", spot, on=chair, surface="seat", frame=seat)
        _setting(scene, group, table, seat, k)
    _table_centre(scene, group, table)
    scene.put(f"{group}/toyCar", "toy_car", (205, -2), on=rug, turn=(0, 35, 0))


def _setting(scene: Layout, group: str, table: str, seat: Frame, k: int) -> None:
    number = k + 1
    plate_name = f"dinnerPlate_{number}"
    plate = scene.put(f"{group}/{plate_name}", "dinner_plate", (0, -17), on=table, frame=seat, extras=INSTANCE)
    if k in (0, 1):
        scene.put(f"{group}/pastaBowl_{number}", "pasta_bowl", (0, -17), on=plate, frame=seat)
    napkin = scene.put(f"{group}/napkin_{number}", "napkin_folded", (-20, -16), on=table, frame=seat, extras=INSTANCE)
    fork = f"{group}/fork_{number}" if k != 4 else f"{group}/tableFork_LOW"
    scene.put(fork, "table_fork", (-20, -20), on=napkin, frame=seat, extras=INSTANCE)
    scene.put(f"{group}/knife_{number}", "table_knife", (16.5, -17), on=table, frame=seat, extras=INSTANCE)
    if k in (0, 1, 3):
        spoon = f"{group}/spoon_{number}" if k else f"{group}/cuchara_1"
        scene.put(spoon, "table_spoon", (20.5, -20), on=table, frame=seat)
    if k < 4:
        glass = f"{group}/wineGlass_{number:02d}"
        scene.put(glass, "wine_glass", (6.5, -35.5), on=table, frame=seat, extras=kg(0.16) if not k else None)
    tumbler = f"{group}/glass_{number}" if k != 2 else f"{group}/Wasserglas"
    scene.put(tumbler, "tumbler", (14.5, -33.5), on=table, frame=seat, extras=INSTANCE)


def _table_centre(scene: Layout, group: str, table: str) -> None:
    salad = Extras(mass=1.4)
    scene.put(f"{group}/saladBowl", "salad_bowl", (0, 0), on=table, frame=TABLE, extras=salad)
    scene.put(f"{group}/waterCarafe", "water_carafe", (-22.5, 0), on=table, frame=TABLE)
    scene.put(f"{group}/saltShaker", "salt_shaker", (20, -3), on=table, frame=TABLE)
    scene.put(f"{group}/pepper_mill_02", "pepper_shaker", (25, -2), on=table, frame=TABLE)
    scene.put(f"{group}/candleHolder", "candle_stick", (22.5, 7), on=table, frame=TABLE)
    scene.put(f"{group}/WineBottle_open", "wine_bottle", (-4, -26), on=table, frame=TABLE)
    basket = scene.put(f"{group}/breadBasket", "bread_basket", (-3.5, 27), on=table, frame=TABLE)
    for k, x in enumerate((-8.3, 1.3)):
        scene.put(f"{group}/roll_{k + 1}", "bread_roll", (x, 27), inside=basket, frame=TABLE)


def place_bar(scene: Layout, floor: str) -> None:
    """The breakfast bar, its stools and what lies on it."""
    group = scene.group("breakfastBar")
    bar = scene.put(f"{group}/barTable", "bar_table", (-120, -40), on=floor, extras=kg(31))
    for k, (x, yaw) in enumerate(((-161.0, 10.0), (-119.0, 45.0), (-77.0, -15.0))):
        scene.put(f"{group}/barStool_{k + 1}", "bar_stool", (x, 9), on=floor, turn=(0, yaw, 0))
    _fruit(scene, group, bar)
    about = Extras(mass=0.48, display_name="Tablet")
    scene.put(f"{group}/tablet10", "tablet_10", (-113, -41), on=bar, turn=(0, 14, 0), extras=about)
    book = scene.put(f"{group}/cookBook", "cook_book", (-79, -51.5), on=bar, turn=(0, 80, 0))
    scene.put(f"{group}/prop_book_2", "novel", (-79, -51.5), on=book, turn=(0, 108, 0))
    saucer = scene.put(f"{group}/saucer_1", "saucer", (-100, -26), on=bar)
    scene.put(f"{group}/espressoCup_1", "espresso_cup", (-100, -26), on=saucer, turn=(0, -25, 0))
    scene.put(f"{group}/teaSpoon_03", "tea_spoon", (-91, -25), on=bar, turn=(0, 12, 0))
    scene.put(f"{group}/mug_large_04", "mug_large", (-126, -24), on=bar, turn=(0, 200, 0), extras=kg(0.34))
    plate = scene.put(f"{group}/cakePlate_sm", "side_plate", (-72, -27.5), on=bar)
    scene.put(f"{group}/croissant", "croissant", (-72, -27), on=plate, turn=(0, 30, 0))


def _fruit(scene: Layout, group: str, bar: str) -> None:
    bowl = scene.put(f"{group}/fruitBowl", "fruit_bowl", (-150, -40), on=bar)
    at = Frame(-150, -40)
    names = ("apple_1", "orange_1", "apple_2", "appleGreen", "orange_2", "apple_3")
    kinds = ("apple_red", "orange", "apple_red", "apple_green", "orange", "apple_red")
    for k, (name, asset) in enumerate(zip(names, kinds, strict=True)):
        spot = at.within(0, 0, 60.0 * k).world(7.9, 0)
        scene.put(f"{group}/{name}", asset, spot, inside=bowl, turn=(0, 75.0 * k, 0))
    scene.put(f"{group}/Zitrone", "lemon", (0, 0), inside=bowl, frame=at, turn=(0, 15, 0))
    scene.put(f"{group}/bananas", "bananas", (-123, -56.5), on=bar, turn=(0, 8, 0))
