"""What tools and artists add to a name does not change what a thing is (metamorphic relations, Chen et al., 1998)."""

import pytest

from benchmarks.bare import bare_object, bare_scene
from usd2kg.grounding import ground
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.ontology import ClassIRI, load_home_tbox

SIZES = {
    "chair": (0.9, 0.5, 0.5),
    "table": (1.6, 0.8, 0.75),
    "desk": (1.6, 0.8, 0.75),
    "sofa": (2.0, 0.9, 0.8),
    "plate": (0.25, 0.25, 0.02),
    "mug": (0.12, 0.1, 0.1),
    "fork": (0.2, 0.03, 0.02),
    "bottle": (0.3, 0.08, 0.08),
    "bowl": (0.2, 0.2, 0.08),
    "fridge": (1.8, 0.7, 0.6),
    "drawer": (0.5, 0.5, 0.2),
    "door": (2.0, 0.9, 0.05),
    "bucket": (0.3, 0.3, 0.3),
    "dishwasher": (0.85, 0.6, 0.6),
    "kettle": (0.25, 0.2, 0.2),
    "sink": (0.6, 0.5, 0.2),
    "stool": (0.6, 0.35, 0.35),
    "wardrobe": (2.0, 1.2, 0.6),
    "trash_can": (0.6, 0.3, 0.3),
    "coffee_table": (1.1, 0.6, 0.45),
    "office_chair": (1.1, 0.6, 0.6),
    "frying_pan": (0.45, 0.28, 0.06),
    "cutting_board": (0.4, 0.25, 0.02),
    "fire_extinguisher": (0.5, 0.18, 0.18),
    "screwdriver": (0.22, 0.03, 0.03),
    "cereal_box": (0.3, 0.2, 0.06),
}
"""What a thing is called → its extents in metres."""
OF_ITS_OWN = (
    *("{n}_01/{n}", "{n}/{n}_01", "{N}/SM_{N}", "{N}_Grp/{N}_Geo", "{n}/geom_{n}", "{N}/{N}_Mesh", "{N}/{N}_LOD0"),
    *("{n}s/{n}_2", "{n}_A/{n}_A_white", "{N}/Red{N}", "{N}/{N}_Red", "{n}_xform/{n}_body"),
)
"""Below a group of the thing's own name: parent/name, {n} as `frying_pan` and {N} as `FryingPan`."""
ADDED = (
    *("SM_{N}_01a", "my_{n}", "{n}_new_v2", "{n}_final", "obj_{n}_3", "{n}_model", "{n}_inst_4", "{N}_Instance_12"),
    *(
        "old_{n}",
        "{n}_lowpoly",
        "{n}_copy",
        "{n}_rigid_body",
        "prop_{n}",
        "{U}",
        "{n}_60x80",
        "{n}_120cm",
        "{n}_a8f3c2",
    ),
    *("{n}_wood_dark", "wooden_{n}", "vintage_{n}", "{n}_modern", "{n}_by_window", "{n}_4k_pbr", "Kitchen_{N}"),
)
MATERIALS = (
    *(
        "Wood",
        "Oak",
        "Walnut",
        "Pine",
        "Bamboo",
        "Rattan",
        "Steel",
        "Brass",
        "Copper",
        "Aluminium",
        "Marble",
        "Granite",
    ),
    *("Stone", "Ceramic", "Tile", "Leather", "Velvet", "Denim", "Plastic", "Rubber", "Foam", "Veneer"),
)


def class_of(parent: str, name: str, size: tuple[float, float, float]) -> ClassIRI | None:
    """Return what a thing is grounded to, alone below its parent."""
    scene = bare_scene("one thing", [bare_object(f"/World/{parent}/{name}", size)])
    return ground(scene, load_home_tbox()).predictions[0].class_iri


@pytest.fixture(scope="module")
def plain() -> dict[str, ClassIRI | None]:
    """Return the class of each thing by its name alone."""
    return {name: class_of("Props", name, size) for name, size in SIZES.items()}


def changed(pattern: str, plain: dict[str, ClassIRI | None]) -> dict[str, str]:
    """Return the things that are no more what they are if they are called after a pattern, and what they become."""
    tbox = load_home_tbox()
    found = {}
    for name, size in SIZES.items():
        camel = "".join(word.capitalize() for word in name.split("_"))
        parent, written = pattern.format(n=name, N=camel, U=name.upper()).split("/")
        iri = class_of(parent, written, size)
        if iri is None or not tbox.is_subclass(iri, str(plain[name])):
            found[name] = tbox.by_iri[iri].label if iri else "nothing"
    return found


def test_each_thing_is_understood_without(plain: dict[str, ClassIRI | None]):
    roots = load_home_tbox().roots
    assert all(iri is not None and iri not in roots for iri in plain.values())


@pytest.mark.parametrize("pattern", OF_ITS_OWN)
def test_below_a_group_of_its_own_name(pattern: str, plain: dict[str, ClassIRI | None]):
    assert changed(pattern, plain) == {}


@pytest.mark.parametrize("added", ADDED)
def test_with_what_tools_and_artists_add(added: str, plain: dict[str, ClassIRI | None]):
    assert changed(f"Props/{added}", plain) == {}


@pytest.mark.parametrize("material", MATERIALS)
def test_below_a_group_of_its_own_name_with_what_it_is_made_of(material: str, plain: dict[str, ClassIRI | None]):
    assert changed("{N}_01/SM_{N}_" + material, plain) == {}


@pytest.mark.parametrize(
    ("parent", "part", "local_name"),
    [
        ("Vase", "vase_tulip", "DesignedArtifact"),
        ("Toaster", "toaster_bread", "Bread"),
        ("Pot", "pot_lid", "Lid"),
        ("Bathtub", "bathtub_towel", "DesignedArtifact"),
        ("Dispenser", "dispenser_soap", "DesignedSubstance"),
        ("Cabinet10", "cabinet10_drawer", "Drawer"),
        ("Printer", "printer_paper", "DesignedArtifact"),
    ],
)
def test_another_thing_below_it_is_one(parent: str, part: str, local_name: str):
    iri = class_of(parent, part, (0.2, 0.1, 0.05))
    assert load_home_tbox().by_iri[str(iri)].local_name == local_name


@pytest.mark.parametrize("name", ["windows", "taps", "boards", "clocks", "shakers"])
def test_a_plural_is_no_noun_of_its_own(name: str):
    assert load_taxonomy().singular(name) == name[:-1]


@pytest.mark.parametrize(
    ("name", "local_name"),
    [("windows", "DesignedComponent"), ("taps", "Tap"), ("cutting_boards", "DesignedTool"), ("stool", "DesignedChair")],
)
def test_a_word_is_what_a_stage_means_by_it(name: str, local_name: str):
    iri = class_of("Props", name, (0.5, 0.4, 0.1))
    assert load_home_tbox().by_iri[str(iri)].local_name == local_name
