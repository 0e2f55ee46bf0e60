"""IRIs of individuals: unique, reversible, legal."""

import pyoxigraph as ox
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.errors import GraphError
from usd2kg.graph import individual_iri, prim_path_of
from usd2kg.graph.iris import check_base, default_base

BASE = "https://my.lab/k/"

_STARTS = st.characters(categories=["Lu", "Ll", "Lt", "Lm", "Lo", "Nl"], include_characters="_")
_REST = st.text(
    st.characters(categories=["Lu", "Ll", "Lt", "Lm", "Lo", "Nl", "Mn", "Mc", "Nd", "Pc"], include_characters="_")
)
NAMES = st.builds(lambda start, rest: start + rest, _STARTS, _REST)
"""Prim names: XID_Start or underscore, then XID_Continue."""
PATHS = st.lists(NAMES, min_size=1, max_size=5).map(lambda names: "/" + "/".join(names))
PARTS = st.sampled_from(["box", "mass", "place", "pose", "shape", "joint", "joint-limit", "color"])
COPIES = st.builds(lambda path, number: f"{path}[{number}]", PATHS, st.integers())
"""Paths of point instances."""
ANY_PATHS = st.one_of(PATHS, COPIES, st.text(min_size=1).map(lambda text: "/" + text))
"""Other paths: properties (`/Cup.box`), variants (`/Cup{lod=high}`), arbitrary text."""


@pytest.mark.parametrize(
    ("path", "iri"),
    [
        ("/World/Table_1/Cup_3", "https://my.lab/k/World.Table_1.Cup_3"),
        ("/Cup", "https://my.lab/k/Cup"),
        # UTF-8 of ü is C3 BC.
        ("/Küche/Cup", "https://my.lab/k/K%C3%BCche.Cup"),
        # A copy of a point instancer, a property, a variant, a name that no stage should have.
        ("/World/Books[7]", "https://my.lab/k/World.Books%5B7%5D"),
        ("/Cup.box", "https://my.lab/k/Cup%2Ebox"),
        ("/Cup{lod=high}Geo", "https://my.lab/k/Cup%7Blod%3Dhigh%7DGeo"),
        ("/Cup-box", "https://my.lab/k/Cup%2Dbox"),
        ("/", "https://my.lab/k/"),
    ],
)
def test_iri_of_a_prim(path: str, iri: str):
    assert individual_iri(BASE, path) == iri
    assert prim_path_of(BASE, iri) == path


def test_iri_of_an_aspect_maps_to_its_prim():
    iri = individual_iri(BASE, "/World/Cup", "shape")
    assert iri == "https://my.lab/k/World.Cup-shape"
    assert prim_path_of(BASE, iri) == "/World/Cup"


def test_child_named_like_an_aspect_is_distinct():
    assert individual_iri(BASE, "/Cup/box") != individual_iri(BASE, "/Cup", "box")
    assert individual_iri(BASE, "/Cup_box") != individual_iri(BASE, "/Cup", "box")


def test_accepts_hash_and_urn_bases():
    assert individual_iri("https://my.lab/k#", "/World/Cup") == "https://my.lab/k#World.Cup"
    assert prim_path_of("urn:lab:", individual_iri("urn:lab:", "/World/Cup")) == "/World/Cup"


@settings(deadline=None, max_examples=200)
@given(ANY_PATHS, PARTS)
def test_iris_are_reversible(path: str, part: str):
    assert prim_path_of(BASE, individual_iri(BASE, path)) == path
    assert prim_path_of(BASE, individual_iri(BASE, path, part)) == path


def test_lone_surrogates_have_distinct_iris():
    # Strategies of text leave surrogates out; a record read from JSON can hold one.
    path = "/a\ud800b"
    assert prim_path_of(BASE, individual_iri(BASE, path)) == path


def test_stage_nodes_do_not_clash_with_objects():
    reserved = {individual_iri(BASE, "/", part) for part in ("stage", "run", "ontology", "software")}
    assert individual_iri(BASE, "/-stage") not in reserved
    assert individual_iri(BASE, "/", "stage") == "https://my.lab/k/-stage"


@settings(deadline=None, max_examples=200)
@given(ANY_PATHS, ANY_PATHS, PARTS, PARTS)
def test_iris_are_injective(first: str, second: str, part: str, other: str):
    iris = [
        individual_iri(BASE, path, of_part)
        for path in dict.fromkeys([first, second])
        for of_part in dict.fromkeys(["", part, other])
    ]
    assert len(iris) == len(set(iris))


@settings(deadline=None, max_examples=150)
@given(ANY_PATHS, PARTS)
def test_iris_are_valid_and_round_trip(path: str, part: str):
    for iri in (individual_iri(BASE, path), individual_iri(BASE, path, part)):
        triple = ox.Triple(ox.NamedNode(iri), ox.NamedNode("urn:p"), ox.Literal("x"))
        data = ox.serialize([triple], format=ox.RdfFormat.TURTLE, prefixes={"": BASE})
        (quad,) = ox.parse(data, format=ox.RdfFormat.TURTLE)
        assert quad.subject.value == iri


def test_unicode_normal_forms_have_distinct_iris():
    composed, decomposed = "/K\u00fcche", "/Ku\u0308che"
    assert individual_iri(BASE, composed) != individual_iri(BASE, decomposed)
    assert prim_path_of(BASE, individual_iri(BASE, decomposed)) == decomposed


@pytest.mark.parametrize(
    ("source", "base"),
    [
        ("scenes/kitchen.usda", "https://example.org/kitchen/"),
        ("my kitchen.usd", "https://example.org/my%20kitchen/"),
        ("Küche#1.usdz", "https://example.org/K%C3%BCche%231/"),
        ("a<b>.usda", "https://example.org/a%3Cb%3E/"),
    ],
)
def test_default_base_is_derived_from_the_file_name(source: str, base: str):
    assert default_base(source) == base
    assert check_base(base) == base
    ox.NamedNode(base)


@pytest.mark.parametrize("base", ["https://my.lab/k/", "https://my.lab/k#", "urn:lab:", "http://müller.example/küche/"])
def test_accepts_a_valid_base(base: str):
    assert check_base(base) == base
    ox.NamedNode(individual_iri(base, "/World/Cup"))


@pytest.mark.parametrize(
    "base",
    [
        # Not absolute.
        "kitchen/",
        "",
        "/",
        "//my.lab/",
        ":/",
        "/a:b/",
        "1:/",
        # Nothing to join names to.
        "https://my.lab/k",
        "https://my.lab/k?x=1",
        # Not an IRI.
        "https://my lab/",
        "https://my.lab/<k>/",
        'https://my.lab/"/',
        "https://my.lab/{k}/",
        "https://my.lab/\n/",
        "https://my.lab/\x00/",
        "https://my.lab/%zz/",
        "https://[my.lab/",
    ],
)
def test_rejects_an_invalid_base(base: str):
    with pytest.raises(GraphError) as error:
        check_base(base)
    assert repr(base) in str(error.value)
    assert "ends in / or #" in str(error.value)
