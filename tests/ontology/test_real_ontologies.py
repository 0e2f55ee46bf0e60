"""Published ontologies."""

import pytest

from tests.conftest import SHARED, shared_file
from usd2kg.errors import OntologyError
from usd2kg.ontology import linearize_flat, linearize_tree, load_tbox

FOLDER = SHARED / "ontologies"
FILES = sorted(
    str(path.relative_to(FOLDER))
    for folder in ("other", "iai")
    for path in (FOLDER / folder).rglob("*")
    if path.is_file() and path.suffix != ".usda"
)


@pytest.mark.parametrize("name", FILES)
def test_published_ontology_loads(name):
    tbox = load_tbox(FOLDER / name)
    assert tbox.classes
    assert [cls.iri for cls in tbox.classes] == sorted(tbox.by_iri)
    assert ":" in tbox.ontology_iri
    for cls in tbox.classes:
        assert cls.label
        assert set(cls.parents) <= set(tbox.by_iri) - {cls.iri}
    assert len(linearize_flat(tbox).splitlines()) == len(tbox.classes)
    assert len(linearize_tree(tbox).splitlines()) >= len(tbox.classes)


def test_all_published_ontologies_are_tested():
    shared_file("ontologies/other")
    assert len(FILES) == 18


def test_rejects_a_scene():
    path = shared_file("ontologies/other/multiverse_soma_dfl/SOMA_DFL_module.usda")
    with pytest.raises(OntologyError, match="not an ontology"):
        load_tbox(path)


@pytest.mark.parametrize(
    ("name", "iri", "parents"),
    [
        ("other/bot/bot.ttl", "https://w3id.org/bot#Storey", ["Zone"]),
        ("other/saref/saref4bldg.ttl", "https://w3id.org/def/saref4bldg#Boiler", ["EnergyConversionDevice"]),
        ("other/dogont/dogont.owl", "http://elite.polito.it/ontologies/dogont.owl#Oven", ["WhiteGoods"]),
    ],
)
def test_published_classes_have_their_parents(name, iri, parents):
    tbox = load_tbox(shared_file(f"ontologies/{name}"))
    assert [tbox.by_iri[up].local_name for up in tbox.by_iri[iri].parents] == parents


def test_reports_missing_imports_of_the_apartment():
    tbox = load_tbox(shared_file("ontologies/iai/iai-apartment.owl"))
    assert {note.code for note in tbox.notes} == {"missing-import"}


def test_equivalence_with_soma_includes_handles():
    # part ≡ soma:DesignedComponent, which is below dul:PhysicalObject; which is its only place in the hierarchy.
    tbox = load_tbox(shared_file("ontologies/other/multiverse_soma_dfl/SOMA_DFL_module.owl"))
    dfl = "http://www.ease-crc.org/ont/SOMA_DFL.owl#"
    assert tbox.is_subclass(f"{dfl}knob.n.wn.artifact..handle", f"{dfl}handle.n.wn.artifact")
    assert tbox.resolve("soma:DesignedHandle") == f"{dfl}handle.n.wn.artifact"
    assert tbox.by_iri[f"{dfl}container.n.wn.artifact"].equivalents == (
        "http://www.ease-crc.org/ont/SOMA.owl#DesignedContainer",
    )
    assert tbox.notes == ()
