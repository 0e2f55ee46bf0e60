"""Objects of the synthetic scenes: kinds with sizes, and assets with names as artists write them."""

import math
import random
from typing import NamedTuple

Size = tuple[float, float, float]


class Kind(NamedTuple):
    """A kind of object."""

    nouns: tuple[str, ...]
    size: Size
    """Metres: width, depth, height."""
    boards: int = 0
    """Number of boards that carry objects, evenly spaced over the height."""


class Asset(NamedTuple):
    """One model of a kind."""

    name: str
    kind: str
    size: Size
    """Metres: width, depth, height."""
    boards: int


KINDS = {
    "table": Kind(("dining table", "table", "kitchen table", "Esstisch", "work table"), (1.6, 0.9, 0.75)),
    "desk": Kind(("desk", "writing desk", "office desk", "workbench"), (1.4, 0.7, 0.74)),
    "sofa": Kind(("sofa", "couch", "settee"), (2.0, 0.9, 0.8)),
    "chair": Kind(("chair", "armchair", "stool", "Stuhl", "office chair"), (0.45, 0.45, 0.85)),
    "cupboard": Kind(("cupboard", "kitchen cabinet", "wardrobe", "sideboard", "locker"), (1.0, 0.45, 1.8)),
    "shelf": Kind(("shelf", "bookcase", "Regal", "rack"), (1.2, 0.35, 1.9), 5),
    "fridge": Kind(("fridge", "refrigerator", "freezer"), (0.6, 0.6, 1.7)),
    "tray": Kind(("tray", "serving tray", "tablett"), (0.45, 0.3, 0.02)),
    "plate": Kind(("plate", "dinner plate", "saucer", "Teller"), (0.22, 0.22, 0.02)),
    "cup": Kind(("cup", "coffee mug", "mug", "teacup", "Tasse"), (0.08, 0.08, 0.1)),
    "glass": Kind(("glass", "wine glass", "water glass", "tumbler"), (0.07, 0.07, 0.14)),
    "bowl": Kind(("bowl", "salad bowl", "fruit bowl", "pasta bowl"), (0.24, 0.24, 0.1)),
    "cutlery": Kind(("spoon", "fork", "tea spoon", "bread knife", "table fork"), (0.02, 0.18, 0.01)),
    "bottle": Kind(("bottle", "milk bottle", "wine bottle", "water bottle", "Flasche"), (0.07, 0.07, 0.28)),
    "jar": Kind(("jar", "jam jar", "salt shaker", "pepper mill", "sugar dispenser"), (0.06, 0.06, 0.1)),
    "pot": Kind(("pot", "soup pot", "pan", "kettle", "saucepan"), (0.26, 0.24, 0.16)),
    "book": Kind(("book", "novel", "cookbook", "folder", "Buch"), (0.04, 0.18, 0.24)),
    "lamp": Kind(("lamp", "table lamp", "reading light"), (0.2, 0.2, 0.4)),
    "toy": Kind(("toy car", "teddy bear", "building block", "doll"), (0.1, 0.08, 0.08)),
    "box": Kind(("box", "storage box", "carton", "cardboard box", "crate", "Karton"), (0.4, 0.3, 0.3)),
    "bin": Kind(("bin", "trash can", "waste basket", "recycling bin"), (0.3, 0.3, 0.5)),
    "rack": Kind(("pallet rack", "storage rack", "heavy duty rack"), (2.8, 1.1, 6.0), 4),
    "pallet": Kind(("pallet", "euro pallet", "wooden pallet", "Palette"), (0.8, 1.0, 0.14)),
    "vehicle": Kind(("forklift", "pallet jack", "hand truck", "cart"), (1.1, 2.2, 2.0)),
    "tool": Kind(("hammer", "drill", "wrench", "screwdriver", "pliers", "barcode scanner"), (0.08, 0.2, 0.06)),
    "drum": Kind(("drum", "barrel", "canister", "bucket"), (0.4, 0.4, 0.6)),
}
_QUALITIES = """
    red blue green white black grey oak walnut steel plastic wooden glass ceramic metal small large big tall old new
    round square folding heavy light striped Ikea Bosch classic modern rustic industrial kids office garden travel
""".split()
_STYLES = 5
_VARIANTS = 20.0
"""A scene of n objects has about this times √n distinct assets."""


class Catalogue:
    """The assets of one scene; their number grows with the square root of the number of objects."""

    def __init__(self, objects: int, chance: random.Random) -> None:
        self._chance = chance
        each = max(1, round(_VARIANTS * math.sqrt(objects) / len(KINDS)))
        names: set[str] = set()
        self.by_kind = {kind: self._make(kind, each, names) for kind in KINDS}

    def choose(self, kind: str) -> Asset:
        """Return an asset of a kind."""
        return self._chance.choice(self.by_kind[kind])

    def _make(self, kind: str, count: int, names: set[str]) -> list[Asset]:
        about = KINDS[kind]
        made = []
        for number in range(count):
            scale = self._chance.uniform(0.9, 1.1)
            width, depth, height = (side * scale for side in about.size)
            name = self._name(self._chance.choice(about.nouns), number)
            while name in names:
                name += "_v2"
            names.add(name)
            made.append(Asset(name, kind, (width, depth, height), about.boards))
        return made

    def _name(self, noun: str, number: int) -> str:
        """Return a name in one of the usual naming styles."""
        quality = self._chance.choice(_QUALITIES)
        words = noun.split()
        style = self._chance.randrange(_STYLES)
        if style == 0:
            return "SM_" + "".join(word.capitalize() for word in (*words, quality)) + f"_{number % 100:02}"
        if style == 1:
            return "_".join((quality, *words)).lower()
        if style == 2:
            return words[0].lower() + "".join(word.capitalize() for word in words[1:]) + f"_{chr(65 + number % 26)}"
        if style == 3:
            return "".join(word.capitalize() for word in (quality, *words))
        return "_".join((*words, quality, str(number))).lower()
