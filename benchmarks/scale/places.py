"""Two synthetic places of any size: furnished flats, room by room, and a warehouse with racks, pallets and cartons."""

import random
from collections.abc import Callable, Iterator
from typing import NamedTuple

from benchmarks.scale.catalogue import Asset, Catalogue

Point = tuple[float, float, float]
ROOM = 6.0
"""Side length of a room in metres."""
ROOMS_PER_FLAT = 4
FLATS_PER_ROW = 12
RACKS_PER_AISLE = 24
AISLE = 4.5
"""Distance between aisles in metres."""
ROOM_NAMES = ("Kitchen", "Living_Room", "Bedroom", "Office")
TABLE_TOP = ("plate", "cup", "glass", "bowl", "cutlery", "bottle", "jar", "lamp", "book")
CUPBOARD = ("plate", "bowl", "pot", "box", "jar", "bottle")
FURNITURE = ("sofa", "desk", "cupboard", "fridge", "bin", "chair", "lamp")
GOODS = ("tool", "jar", "book", "toy", "bottle", "cup")


class Thing(NamedTuple):
    """An object and its place."""

    path: str
    asset: Asset
    place: Point
    """Lower corner of the box in metres."""


def flats(catalogue: Catalogue, chance: random.Random) -> Iterator[Thing]:
    """Yield the objects of rooms endlessly: laid tables, filled shelves and cupboards, nested boxes with toys."""
    room = 0
    while True:
        flat, number = divmod(room, ROOMS_PER_FLAT)
        x = (flat % FLATS_PER_ROW * ROOMS_PER_FLAT + number) * (ROOM + 0.2)
        maker = _Maker(f"/World/Flat_{flat}/{ROOM_NAMES[number]}", catalogue, chance)
        yield from _furnish(maker, x, flat // FLATS_PER_ROW * (ROOM + 0.2))
        room += 1


def warehouse(catalogue: Catalogue, chance: random.Random) -> Iterator[Thing]:
    """Yield the objects of aisles endlessly: racks of four levels, pallets, cartons in two layers, goods inside."""
    aisle = 0
    while True:
        maker = _Maker(f"/World/Hall_{aisle // 20}/Aisle_{aisle:02}", catalogue, chance)
        y = aisle * AISLE
        for bay in range(RACKS_PER_AISLE):
            yield from _fill_rack(maker, bay * 3.2, y)
        yield maker.put("vehicle", (chance.uniform(0, 70), y + 1.6, 0))
        for _ in range(3):
            yield maker.put("drum", (chance.uniform(0, 70), y + 3.8, 0))
        aisle += 1


PLACES: dict[str, Callable[[Catalogue, random.Random], Iterator[Thing]]] = {"flats": flats, "warehouse": warehouse}


class _Maker:
    """Makes objects in one group with unique names."""

    def __init__(self, group: str, catalogue: Catalogue, chance: random.Random) -> None:
        self.chance = chance
        self._group = group
        self._catalogue = catalogue
        self._made = 0

    def put(self, kind: str, place: Point) -> Thing:
        asset = self._catalogue.choose(kind)
        self._made += 1
        return Thing(f"{self._group}/{asset.name}_{self._made}", asset, place)

    def top(self, thing: Thing) -> float:
        return thing.place[2] + thing.asset.size[2]


def _furnish(maker: _Maker, x: float, y: float) -> Iterator[Thing]:
    for row in range(2):
        yield from _lay_table(maker, x + 0.8, y + 1.0 + 2.2 * row)
    for place in range(3):
        yield from _fill_shelf(maker, x + 0.2 + 1.5 * place, y + 5.6)
    for place in range(4):
        yield maker.put(maker.chance.choice(FURNITURE), (x + 4.0, y + 0.1 + 1.3 * place, 0))
    yield from _fill_cupboard(maker, x + 2.9, y + 0.1)
    yield from _fill_box(maker, (x + 5.3, y + 0.3, 0), depth=2)


def _lay_table(maker: _Maker, x: float, y: float) -> Iterator[Thing]:
    table = maker.put("table", (x, y, 0))
    yield table
    top = maker.top(table)
    for seat in range(4):
        yield maker.put("chair", (x + 0.1 + seat % 2 * 0.8, y - 0.55 + seat // 2 * 1.6, 0))
    for column in range(4):
        for row in range(2):
            kind = maker.chance.choice(TABLE_TOP)
            yield maker.put(kind, (x + 0.05 + 0.32 * column, y + 0.03 + 0.55 * row, top))
    tray = maker.put("tray", (x + 0.3, y + 0.28, top))
    yield tray
    for column in range(2):
        yield maker.put(
            maker.chance.choice(("cup", "jar", "glass")), (x + 0.35 + 0.2 * column, y + 0.35, maker.top(tray))
        )


def _fill_shelf(maker: _Maker, x: float, y: float) -> Iterator[Thing]:
    shelf = maker.put("shelf", (x, y, 0))
    yield shelf
    for height in board_tops(shelf.asset):
        for column in range(maker.chance.randint(3, 8)):
            kind = maker.chance.choice(("book", "book", "toy", "jar"))
            yield maker.put(kind, (x + 0.03 + 0.12 * column, y + 0.05, height))


def _fill_cupboard(maker: _Maker, x: float, y: float) -> Iterator[Thing]:
    yield maker.put("cupboard", (x, y, 0))
    for level in range(3):
        for column in range(2):
            kind = maker.chance.choice(CUPBOARD)
            yield maker.put(kind, (x + 0.03 + 0.45 * column, y + 0.03, 0.05 + 0.5 * level))


def _fill_box(maker: _Maker, place: Point, depth: int) -> Iterator[Thing]:
    x, y, z = place
    yield maker.put("box", place)
    for column in range(2):
        yield maker.put(maker.chance.choice(GOODS), (x + 0.03 + 0.15 * column, y + 0.03, z + 0.01))
    if depth > 1:
        yield from _fill_box(maker, (x, y + 0.5, z), depth - 1)


def _fill_rack(maker: _Maker, x: float, y: float) -> Iterator[Thing]:
    rack = maker.put("rack", (x, y, 0))
    yield rack
    for height in board_tops(rack.asset):
        for slot in range(3):
            pallet = maker.put("pallet", (x + 0.05 + 0.88 * slot, y + 0.03, height))
            yield pallet
            for stack in range(maker.chance.randint(1, 4)):
                yield from _stack(
                    maker, x + 0.05 + 0.88 * slot + stack % 2 * 0.42, y + 0.03 + stack // 2 * 0.4, maker.top(pallet)
                )


def _stack(maker: _Maker, x: float, y: float, z: float) -> Iterator[Thing]:
    """Yield one or two cartons; every fifth one holds goods."""
    for _ in range(maker.chance.randint(1, 2)):
        carton = maker.put("box", (x, y, z))
        yield carton
        if maker.chance.random() < 0.2:
            yield from (
                maker.put(maker.chance.choice(GOODS), (x + 0.02 + 0.1 * i, y + 0.03, z + 0.01)) for i in range(3)
            )
        z = maker.top(carton)


def board_tops(asset: Asset) -> list[float]:
    """Return the heights in metres of the tops of an asset's boards."""
    return [asset.size[2] * (board + 0.1) / asset.boards for board in range(asset.boards)]
