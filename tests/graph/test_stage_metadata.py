"""Names, assets, materials, colours, labels and texts of an object in the graph."""

from collections import Counter
from typing import Any

import pyoxigraph as ox
import pytest

from tests.graph.records import ask, box_at, build_graph, reread, said_of, select
from tests.grounding.records import make_object
from usd2kg.errors import GraphError
from usd2kg.graph import GraphOptions
from usd2kg.ontology import TBox
from usd2kg.scene import Instances, Label, MaterialDetails, ObjectLabels

PROFILES = ["soma", "plain"]
BOX = box_at((0, 0, 0), (1, 1, 1))


def graph_of(home_tbox: TBox, profile: str = "plain", options: GraphOptions | None = None, **known: Any) -> ox.Store:
    """Return the graph of one cup with the authored metadata `known`."""
    placed = [(make_object("/Cup", **known), "Cup")]
    return reread(build_graph(home_tbox, placed, profile=profile, options=options))


def values(store: ox.Store, name: str, node: str = "k:Cup") -> list[str | None]:
    return [value for (value,) in select(store, f"SELECT ?v {{ {node} {name} ?v }}")]


class TestNames:
    def test_display_name_is_the_label_and_prim_name_a_synonym(self, home_tbox: TBox):
        store = graph_of(home_tbox, display_name="Omas Tasse")
        assert (values(store, "rdfs:label"), values(store, "skos:altLabel")) == (["Omas Tasse"], ["Cup"])

    @pytest.mark.parametrize("display_name", ["", "Cup"])
    def test_equal_names_are_written_once(self, home_tbox: TBox, display_name: str):
        store = graph_of(home_tbox, display_name=display_name)
        assert (values(store, "rdfs:label"), values(store, "skos:altLabel")) == (["Cup"], [])

    def test_documentation_is_the_comment(self, home_tbox: TBox):
        assert values(graph_of(home_tbox, documentation="Made in Meissen."), "rdfs:comment") == ["Made in Meissen."]


class TestOrigin:
    @pytest.mark.parametrize("profile", PROFILES)
    def test_writes_assets_variants_and_copies(self, home_tbox: TBox, profile: str):
        store = graph_of(
            home_tbox,
            profile,
            asset=("cup_01", "ikea"),
            variants=(("color", "red"), ("lod", "high")),
            instances=Instances(12, ("CupA",)),
        )
        assert values(store, "u2k:asset") == ["cup_01", "ikea"]
        assert values(store, "u2k:variant") == ["color=red", "lod=high"]
        assert ask(store, "k:Cup u2k:copies 12")

    def test_mesh_file_is_a_second_region_of_the_shape(self, home_tbox: TBox):
        store = graph_of(home_tbox, "soma", box=BOX, geometry_file="props/cup.usda")
        assert ask(
            store,
            "k:Cup soma:hasShape k:Cup-shape . k:Cup-shape dul:hasRegion k:Cup-box, k:Cup-mesh ."
            ' k:Cup-mesh a soma:MeshShape ; soma:hasFilePath "props/cup.usda"',
        )
        assert values(store, "soma:hasShape") == ["https://my.lab/k/Cup-shape"]

    def test_mesh_file_without_a_box_has_a_shape(self, home_tbox: TBox):
        store = graph_of(home_tbox, "soma", geometry_file="cup.obj")
        assert select(store, "SELECT ?r { k:Cup soma:hasShape/dul:hasRegion ?r }") == [("https://my.lab/k/Cup-mesh",)]

    def test_mesh_file_in_the_plain_profile(self, home_tbox: TBox):
        assert values(graph_of(home_tbox, geometry_file="cup.obj"), "u2k:meshFile") == ["cup.obj"]


class TestMass:
    @pytest.mark.parametrize("profile", PROFILES)
    def test_centre_of_mass_and_oriented_size(self, home_tbox: TBox, profile: str):
        store = graph_of(home_tbox, profile, center_of_mass=(1.0, 0.5, -0.25), oriented_size=(0.1, 0.2, 0.3))
        assert values(store, "u2k:centerOfMass") == ["1 0.5 -0.25"]
        assert values(store, "u2k:orientedSize") == ["0.1 0.2 0.3"]


COLORED = "usd:hasColor|soma:hasColor"
RED = MaterialDetails("Enamel", "/Looks/Enamel", base_color=(0.8, 0.1, 0.05))
BLUE = MaterialDetails("Paint", "/Looks/Paint", base_color=(0.0, 0.0, 1.0))
TEXTURED = MaterialDetails("Wood", "/Looks/Wood")


class TestColour:
    @pytest.mark.parametrize("profile", PROFILES)
    def test_writes_materials_by_name(self, home_tbox: TBox, profile: str):
        assert values(graph_of(home_tbox, profile, materials=("Wood", "Enamel")), "u2k:material") == ["Enamel", "Wood"]

    @pytest.mark.parametrize(
        ("known", "color", "source"),
        [
            ({"material_details": (RED, BLUE)}, "0.8 0.1 0.05", "Enamel"),
            # The wood has a texture; the next material has a constant colour.
            ({"material_details": (TEXTURED, BLUE)}, "0 0 1", "Paint"),
            ({"material_details": (RED,), "display_color": (0.5, 0.5, 0.5)}, "0.8 0.1 0.05", "Enamel"),
            ({"display_color": (0.5, 0.5, 0.5)}, "0.5 0.5 0.5", "displayColor"),
        ],
    )
    def test_base_colour_precedes_display_colour(self, home_tbox: TBox, known: dict[str, Any], color: str, source: str):
        store = graph_of(home_tbox, **known)
        assert (values(store, "u2k:color"), values(store, "u2k:colorSource")) == ([color], [source])

    def test_textures_have_no_colour(self, home_tbox: TBox):
        for profile in PROFILES:
            store = graph_of(home_tbox, profile, material_details=(TEXTURED,))
            assert not ask(store, "k:Cup usd:hasColor|u2k:color|soma:hasColor ?c")

    def test_default_colours_are_consistent_with_soma(self, home_tbox: TBox):
        store = graph_of(home_tbox, "soma", material_details=(RED,))
        assert ask(
            store,
            "k:Cup usd:hasColor k:Cup-color . k:Cup-color a usd:Color ;"
            ' usd:primvars_displayColor "[[0.8, 0.1, 0.05]]" ; u2k:colorSource "Enamel"',
        )
        assert not ask(store, "?c a soma:Color")

    def test_knowrob_colours(self, home_tbox: TBox):
        store = graph_of(home_tbox, "soma", GraphOptions(colors="knowrob"), material_details=(RED,))
        assert ask(
            store,
            "k:Cup soma:hasColor ?q . ?q a soma:Color ; dul:hasRegion ?r ."
            ' ?r a soma:ColorRegion ; soma:hasRGBValue "0.8 0.1 0.05"',
        )
        assert not ask(store, "?c a usd:Color")

    def test_qualities_are_not_shared(self, home_tbox: TBox):
        known: dict[str, Any] = {
            "box": BOX,
            "own_box": BOX,
            "position": (0.0, 0.0, 0.0),
            "orientation": (0.0, 0.0, 0.0, 1.0),
            "mass_kg": 1.0,
            "material_details": (RED, BLUE),
            "display_color": (0.5, 0.5, 0.5),
            "geometry_file": "cup.obj",
        }
        placed = [(make_object(f"/Cup_{i}", **known), "Cup") for i in range(3)]
        for options in (GraphOptions(), GraphOptions(colors="knowrob")):
            store = reread(build_graph(home_tbox, placed, options=options))
            for name in (
                "soma:hasShape",
                "soma:hasLocalization",
                "soma:hasMassAttribute",
                "usd:hasColor|soma:hasColor",
            ):
                pairs = select(store, f"SELECT ?o ?q {{ ?o {name} ?q }}")
                assert Counter(owner for owner, _ in pairs) == {f"https://my.lab/k/Cup_{i}": 1 for i in range(3)}
                assert len({quality for _, quality in pairs}) == 3

    def test_rejects_an_unknown_colour_form(self):
        with pytest.raises(GraphError, match="colors 'rgb' is unknown; expected one of usd, knowrob"):
            GraphOptions(colors="rgb")


def label(value: str, taxonomy: str = "class", path: str = "/Cup", **changes: Any) -> Label:
    return Label(path, changes.pop("encoding", "UsdSemantics"), taxonomy, value, **changes)


class TestLabels:
    def test_label_with_encoding_and_taxonomy(self, home_tbox: TBox):
        store = graph_of(home_tbox, labels=ObjectLabels((label("mug"),), (), ()))
        assert values(store, "u2k:sceneLabel") == ["mug"]
        assert said_of(store, 'k:Cup u2k:sceneLabel "mug"') == {
            "https://w3id.org/usd2kg#labelEncoding": "UsdSemantics",
            "https://w3id.org/usd2kg#labelTaxonomy": "class",
        }

    def test_inherited_and_part_labels_name_their_prim(self, home_tbox: TBox):
        labels = ObjectLabels(
            (), (label("crockery", path="/Room", is_inherited=True),), (label("handle", path="/Cup/h"),)
        )
        store = graph_of(home_tbox, labels=labels)
        assert (values(store, "u2k:sceneLabel"), values(store, "u2k:partLabel")) == (["crockery"], ["handle"])
        above = said_of(store, 'k:Cup u2k:sceneLabel "crockery"')
        assert above["https://w3id.org/usd2kg#labelledPrim"] == "/Room"
        assert said_of(store, 'k:Cup u2k:partLabel "handle"')["https://w3id.org/usd2kg#labelledPrim"] == "/Cup/h"

    @pytest.mark.parametrize(
        ("found", "iri"),
        [
            (label("Q81727", "wikidata_qcode"), "http://www.wikidata.org/entity/Q81727"),
            (label("Q81727", "qcode", encoding="Isaac"), "http://www.wikidata.org/entity/Q81727"),
            (label("https://lab.example/onto#Cup", "iri"), "https://lab.example/onto#Cup"),
            (label("Cup", "https://lab.example/onto#", encoding="Multiverse"), "https://lab.example/onto#Cup"),
        ],
    )
    def test_label_with_an_iri(self, home_tbox: TBox, found: Label, iri: str):
        store = graph_of(home_tbox, labels=ObjectLabels((found,), (), ()))
        assert (values(store, "u2k:sceneLabel"), values(store, "u2k:sceneLabelIri")) == ([found.value], [iri])

    @pytest.mark.parametrize("value", ["not an iri", "<script>", "Q12x", ""])
    def test_an_invalid_iri_stays_a_literal(self, home_tbox: TBox, value: str):
        labels = ObjectLabels((label(value, "iri"), label(value, "wikidata_qcode")), (), ())
        store = graph_of(home_tbox, labels=labels)
        assert (values(store, "u2k:sceneLabel"), values(store, "u2k:sceneLabelIri")) == ([value], [])

    def test_omits_labels_reported_by_tools(self, home_tbox: TBox):
        report = label("Bowl", "lab", encoding="Multiverse", strength="report")
        assert values(graph_of(home_tbox, labels=ObjectLabels((report,), (), ())), "u2k:sceneLabel") == []


def test_texts_name_their_property(home_tbox: TBox):
    store = graph_of(home_tbox, texts=(("userProperties:note", "from grandmother"), ("customData:room", "kitchen")))
    assert values(store, "u2k:text") == ["from grandmother", "kitchen"]
    assert said_of(store, 'k:Cup u2k:text "kitchen"') == {"https://w3id.org/usd2kg#property": "customData:room"}
