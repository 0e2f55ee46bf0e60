"""Small ontologies that grounding tests refer to by name."""

import re
from dataclasses import replace
from functools import cache

from tests.grounding.records import DUL, LAB, SOMA, make_class, make_tbox
from usd2kg.ontology import OntologyClass, TBox, load_home_tbox

__all__ = ["load_ontology", "parse_outline"]

_BASES = {"dul": DUL, "soma": SOMA, "": LAB}
_LINE = re.compile(
    r"(?P<indent>(?:  )*)(?:(?P<prefix>\w+):)?(?P<name>[\w.]+)"
    r'(?: "(?P<label>[^"]+)")?(?: = (?P<synonyms>[^;]+))?(?:; (?P<comment>.+))?'
)

OUTLINES = {
    "appliances and furniture": "Thing\n  Appliances\n  Furniture",
    "army": "Thing\n  Post; A military installation.",
    "bedside tables": "soma:DesignedFurniture\n  soma:BedsideTable",
    "birds": "Thing\n  Bird\n    Crane",
    "chairs, tables and other furniture": "chair\ntable\notherfurniture",
    "computers": "Asset\n  Equipment\n    Computer",
    "containers": "Thing\n  Container",
    "containers and post boxes": 'Thing\n  Container\n  PostBox "post box"',
    "cookware": 'Artifact\n  Utensil "kitchen utensil"\n  Cookware',
    "cups and mugs": "Thing\n  Cup = mug\n  Mug",
    "designed things": "DesignedTool\nDesignedBox\nDesignedRack",
    "exhibits": "Object\n  Exhibit = artefact",
    "freezers": "Thing\n  Refrigerator\n  Freezer",
    "groups": "Thing\n  Model\n  Mug",
    "handles and knobs": "Thing\n  Handle\n  Knob",
    "harbour": """
Asset
  Vessel "ship" = vessel
    Tugboat "tugboat"
  LiftingDevice "lifting device"
    Crane "crane"
  Container "container"
  Vehicle "vehicle"
""",
    "hoods": "Thing\n  Covering\n  Device\n    Appliance\n      KitchenAppliance",
    "hospital": 'CTScanner "CT scanner"\nDevice',
    "hotplates": 'Thing\n  HotPlate "hotplate"\nFurniture',
    "kitchen equipment": 'Asset\n  KitchenEquipment "kitchen equipment"',
    "kitchen equipment and appliances": 'Asset\n  KitchenEquipment "kitchen equipment"\n  Appliance',
    "laboratory": """
Equipment
  GlassVessel "glass vessel"
    Beaker = beaker glass, Becherglas
  BunsenBurner "Bunsen burner (gas)" = burners
""",
    "labels": "\n".join(
        "wall floor cabinet bed chair sofa table door window bookshelf counter desk shelves curtain television towel "
        "box lamp otherstructure otherfurniture otherprop".split()
    ),
    "lifting devices": "Thing\n  LiftingDevice\n    Crane",
    "luminaires": "Asset\n  Luminaire",
    "music": "dul:DesignedArtifact\n  StringedInstrument",
    "no general class": "Chair\nTable\nMug\nPlate\nKnife\nRefrigerator\nDoor",
    "no general class, home room": "soma:Room\nChair",
    "numbered classes": 'OBI_0000968 "device"\nOBI_0400082 "photodetector"',
    "office": """
Asset
  Stationery
  Seating
  LightFitting "light fitting"
  Furniture
    StorageFurniture "storage furniture"
  BuiltStructure "built structure"
""",
    "office equipment": 'Asset\n  OfficeEquipment "office equipment"',
    "office without seating": 'Asset\n  Stationery\n  Furniture\n    StorageFurniture "storage furniture"',
    "one class": "Thing",
    "other activities": "Object\n  Table\nActivity\n  Other",
    "panels": "Thing\n  Art\n  Panel",
    "nested containers": "Equipment\n  Zvessel = container\n    Ajar = container",
    "park": "Entity\n  Telescope\n  Rock\n  Seating",
    "people": "Thing\n  Person\n  Tool",
    "posts": "Thing\n  Post; An upright that carries a beam.",
    "portions": """
Artifact
  BreadPortion "portion of bread"
  Press "newspaper or magazine"
  Cleaning "cleaning and waste equipment"
""",
    "printers": 'Asset\n  PrintingMachine "printing machine"',
    "railway": """
Asset
  Crane
  Container
Railway
""",
    "refrigerators": "Thing\n  Refrigerator",
    "rocks": "Thing\n  Rock\n  Rocket",
    "shop": "ShopThing\n  Furniture\n    Table\n  MiscItem\nProcess",
    "tableware": "Thing\n  Tableware\n    Plate",
    "test tubes": "Thing\n  TestTube\n  Tube\n  HighTable\n  Table\n  Cup",
    "timber": "Thing\n  Furniture\n    Lamp",
    "town": """
Vehicle
  Cycle
    Bicycle
  JanitorialUnit "janitorial unit"
  Scooter
""",
    "toys": "dul:DesignedArtifact\n  Toy",
    "two scooters": "Equipment\n  Vehicle\n    KickScooter\n    MobilityScooter",
    "vehicles": "Equipment\n  Vehicle\n    KickScooter\n  Device\n    AnaesthesiaMachine",
    "zones": "dul:DesignedArtifact\n  Room\n  Place\n    Zone\n      Area",
}
"""Name of the ontology → one class a line below its superclass: `prefix:Name "label" = synonym, synonym; comment`."""


@cache
def load_ontology(name: str) -> TBox:
    """Return the ontology of that name; `home` is the one that ships with the package."""
    return load_home_tbox() if name == "home" else parse_outline(OUTLINES[name])


def parse_outline(outline: str) -> TBox:
    """Return the TBox that an indented outline describes.

    Raises:
        ValueError: a line is not `prefix:Name "label" = synonym, synonym; comment`, indented by two spaces a level.
    """
    above: list[str] = []
    classes: list[OntologyClass] = []
    for line in outline.strip("\n").splitlines():
        if (found := _LINE.fullmatch(line)) is None:
            raise ValueError(f'{line!r}: expected `prefix:Name "label" = synonym, synonym; comment`')
        level, base = len(found["indent"]) // 2, _BASES[found["prefix"] or ""]
        synonyms = found["synonyms"].split(", ") if found["synonyms"] else ()
        label, comment = found["label"] or "", found["comment"] or ""
        cls = make_class(found["name"], label=label, synonyms=synonyms, comment=comment, base=base)
        above[level:] = [cls.iri]
        classes.append(replace(cls, parents=tuple(above[level - 1 : level])) if level else cls)
    return make_tbox(*classes)
