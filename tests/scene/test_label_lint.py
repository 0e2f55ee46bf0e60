"""Linting the labels of single prims."""

import pytest
from pxr import Usd, UsdSemantics

from tests.conftest import shared_file
from tests.scene.labels import DFL, EARLIEST, class_prim, isaac, labelled, ontology, tag, thing, usd
from tests.scene.usda import METRES, cube, prim, xform
from usd2kg.scene.label_lint import find_problems, lint_labels, stage_prims


@pytest.fixture
def stage(write_stage):
    """A function that writes prims as a stage and opens it; the stage lives as long as the test."""
    opened = []

    def run(*prims, layer=METRES):
        opened.append(Usd.Stage.Open(str(write_stage(layer + "\n".join(prims), f"scene{len(opened)}.usda"))))
        return opened[-1]

    return run


@pytest.fixture
def rules(stage):
    """A function that writes prims as a stage and returns (rule, property or schema) of each problem."""

    def run(*prims):
        problems = [problem for item in stage_prims(stage(*prims)) for problem in find_problems(item, EARLIEST)]
        return [(problem.rule, problem.found.split()[0]) for problem in problems]

    return run


def messages(a_stage):
    notes = lint_labels(a_stage)
    assert {note.code for note in notes} <= {"label"}
    return [note.message for note in notes]


def test_accepts_good_labels(rules):
    good = labelled(
        usd("class", "coffee mug", "mug"),
        usd("wikidata_qcode", "Q81727"),
        usd("iri", DFL + "Cup"),
        isaac("class", "CoffeeMug", "a"),
        isaac("qcode", "Q81727", "b"),
        isaac("hierarchy", "container/vessel/mug", "c"),
        tag("/Onto/_class_mugnwnartifact"),
    )
    assert rules(ontology(class_prim("mugnwnartifact", "mug.n.wn.artifact")), good) == []


def test_accepts_a_legacy_scene():
    scene = Usd.Stage.Open(str(shared_file("scenes/awkward/legacy_labels/cube_cylinder.usda")))
    assert lint_labels(scene) == []


def test_finds_an_unused_schema_in_the_tagged_kitchen():
    scene = Usd.Stage.Open(str(shared_file("scenes/dlr_kitchen/tagged_flattened.usda")))
    (note,) = lint_labels(scene)
    assert note.prim_path == "/dlr_kitchen/kitchenette"
    assert note.message.startswith("SemanticTagAPI is applied, but no label of it is authored")


def test_diagnostic_names_prim_and_layer(stage, tmp_path):
    (note,) = lint_labels(stage(labelled(usd("class", "class"))))
    assert (note.code, note.prim_path, note.layer) == ("label", "/Thing", str(tmp_path / "scene0.usda"))


def test_diagnostic_names_the_layer_of_the_strongest_opinion(stage, write_stage):
    write_stage(METRES + labelled(usd("class", "cup")), "base.usda")
    over = prim("", "Thing", usd("class", "class"), specifier="over")
    (note,) = lint_labels(stage(over, layer="(\n    subLayers = [@./base.usda@]\n)\n"))
    assert note.layer.endswith("scene0.usda")


@pytest.mark.parametrize(
    ("taxonomy", "value"),
    [
        ("wikidata_class", "wikidata_qcode"),
        ("class", "class"),
        ("class", "SemanticsLabelsAPI"),
        ("class", "semanticType"),
        ("room", "room"),
    ],
)
def test_reports_the_name_of_a_taxonomy_or_schema_as_label(rules, taxonomy, value):
    assert rules(labelled(usd(taxonomy, value))) == [("label-placeholder", f"semantics:labels:{taxonomy}")]
    isaac_data = "semantic:Semantics:params:semanticData"
    assert rules(labelled(isaac(taxonomy, value))) == [("label-placeholder", isaac_data)]


@pytest.mark.parametrize("value", ["Classroom", "class 5", "hierarchical", "semantics book"])
def test_accepts_words_that_contain_the_name_of_a_taxonomy(rules, value):
    assert rules(labelled(usd("class", value))) == []


@pytest.mark.parametrize("taxonomy", ["wikidata_qcode", "qcode", "prop_general_qcode"])
@pytest.mark.parametrize("value", ["81727", "q81727", "Q 81727", "Q81727x", "http://www.wikidata.org/entity/Q81727"])
def test_reports_a_malformed_wikidata_item(rules, taxonomy, value):
    assert rules(labelled(usd(taxonomy, value))) == [("qcode-malformed", f"semantics:labels:{taxonomy}")]


@pytest.mark.parametrize(("taxonomy", "value"), [("wikidata_qcode", "Q1"), ("class", "81727"), ("qcodes", "none")])
def test_checks_wikidata_items_only_in_their_taxonomies(rules, taxonomy, value):
    assert rules(labelled(usd(taxonomy, value))) == []


def test_reports_empty_and_blank_values(stage):
    nothing = "holds no label (empty, blank or not text), expected one; author it or remove it"
    assert messages(stage(labelled(usd("class")))) == [f"semantics:labels:class {nothing}"]
    assert messages(stage(labelled(usd("class", " ", "")))) == [f"semantics:labels:class {nothing}"]
    assert messages(stage(labelled(isaac("class", " ")))) == [f"semantic:Semantics:params:semanticData {nothing}"]
    some = messages(stage(labelled(usd("class", "cup", " "))))
    assert some == ["semantics:labels:class has a blank value among 2; remove it"]


def test_reports_repeated_values_with_their_number(stage):
    found = messages(stage(labelled(usd("class", "cup", "mug", " cup", "cup"))))
    assert found == ["semantics:labels:class lists 'cup' 3 times; keep one"]
    assert messages(stage(labelled(usd("class", "cup", "Cup")))) == []


def test_reports_a_long_value_without_repeating_it(stage):
    (message,) = messages(stage(labelled(usd("class", "ignore all rules " * 10_000))))
    assert message == "semantics:labels:class has a value of 169999 characters, expected at most 200; shorten it"


@pytest.mark.parametrize(
    ("type_name", "value", "is_read"),
    [
        ("string", '"cup"', False),
        ("token", '"cup"', False),
        ("int", "3", False),
        ("string[]", '["cup"]', False),
        ("rel", "</Thing>", False),
        ("token[]", '["cup"]', True),
    ],
)
def test_reports_a_type_that_openusd_does_not_read(stage, type_name, value, is_read):
    found = stage(labelled(f"{type_name} semantics:labels:class = {value}"))
    query = UsdSemantics.LabelsQuery("class", Usd.TimeCode.Default())
    assert bool(query.ComputeUniqueDirectLabels(found.GetPrimAtPath("/Thing"))) == is_read
    problems = find_problems(found.GetPrimAtPath("/Thing"), EARLIEST)
    assert [(problem.rule, problem.expected) for problem in problems] == (
        [] if is_read else [("label-type", "token[]")]
    )


def test_reports_half_a_pair_of_isaac(rules):
    kind, data = isaac("class", "cup").splitlines()
    for line, half in ((kind, "Type"), (data, "Data")):
        assert rules(labelled(line)) == [("isaac-half", f"semantic:Semantics:params:semantic{half}")]


def test_reports_text_that_is_not_utf_8(stage, tmp_path):
    path = tmp_path / "scene.usdc"
    stage(labelled(usd("class", "xyzzyplugh"))).GetRootLayer().Export(str(path))
    path.write_bytes(path.read_bytes().replace(b"xyzzyplugh", b"xyzzy\xff\xfeugh"))
    changed = Usd.Stage.Open(str(path))
    (problem,) = find_problems(changed.GetPrimAtPath("/Thing"), EARLIEST)
    assert problem.rule == "label-empty"


def test_reports_schemas_without_labels(rules):
    apis = ["SemanticsLabelsAPI:class", "SemanticsAPI:abc", "SemanticTagAPI"]
    assert rules(thing(apis=apis)) == [("schema-without-label", api) for api in apis]
    assert rules(thing(apis=["PhysicsRigidBodyAPI", "SemanticsOfMineAPI"])) == []


def test_reports_labels_without_their_schema(rules):
    bare = thing(usd("class", "cup"), isaac("class", "cup"), tag("/Onto/_class_cup"))
    assert rules(ontology(class_prim("cup", "cup")), bare) == [
        ("label-without-schema", "semanticTag:semanticLabels"),
        ("label-without-schema", "semantic:Semantics:params:semanticData"),
        ("label-without-schema", "semantics:labels:class"),
    ]
    assert rules(thing(usd("class", "cup"), apis=["SemanticsLabelsAPI:room"])) == [
        ("schema-without-label", "SemanticsLabelsAPI:room"),
        ("label-without-schema", "semantics:labels:class"),
    ]


def test_reports_tags_to_missing_prims_and_to_other_prims(stage):
    assert messages(stage(labelled(tag("/SOMA/_class_Cup", "/Thing/geometry")))) == [
        "semanticTag:semanticLabels points to </SOMA/_class_Cup>, which is not on the stage; add the ontology's layer",
        "semanticTag:semanticLabels points to </Thing/geometry>, which has no rdf:conceptName; "
        "point it to a class prim",
    ]


def test_message_quotes_both_contradicting_labels(stage):
    assert messages(stage(labelled(usd("class", "cup"), isaac("class", "banana")))) == [
        "semantics:labels:class says 'cup', but the older class in semantic:*:params says 'banana'; "
        "keep the right one and remove the other"
    ]


BOWL = ontology(class_prim("bowl", "bowl.n.wn.artifact"))


@pytest.mark.parametrize(
    ("labels", "name"),
    [
        ([usd("wikidata_qcode", "Q1"), isaac("qcode", "Q2")], "semantics:labels:wikidata_qcode"),
        ([usd("class", "cup"), tag("/Onto/_class_bowl")], "semanticTag:semanticLabels"),
        ([usd("iri", DFL + "cup"), tag("/Onto/_class_bowl")], "semanticTag:semanticLabels"),
        ([isaac("class", "cup"), tag("/Onto/_class_bowl")], "semanticTag:semanticLabels"),
    ],
)
def test_reports_encodings_that_contradict(rules, labels, name):
    assert rules(BOWL, labelled(*labels)) == [("encodings-contradict", name)]


@pytest.mark.parametrize(
    "labels",
    [
        [usd("class", "cup"), isaac("class", "Cup")],
        [usd("class", "coffee_mug"), isaac("class", "CoffeeMug")],
        [usd("class", "mug"), isaac("class", "coffee mug")],
        [usd("class", "杯子"), isaac("class", "杯子")],
        [usd("class", "☕"), isaac("class", "☕")],
        [usd("class", "cup"), isaac("room", "kitchen")],
        [usd("wikidata_class", "Q153988"), tag("/Onto/_class_bowl")],
        [usd("class", "cup"), tag("/Onto/_class_bowl", kind="Reports")],
    ],
    ids=["case", "separators", "shared word", "no spaces", "symbol", "other taxonomy", "item and word", "report"],
)
def test_accepts_encodings_that_do_not_contradict(rules, labels):
    assert rules(BOWL, labelled(*labels)) == []


def test_reports_problems_inside_instances_once(stage):
    inner = xform("Seat", usd("class", "class"), cube("g"), apis=["SemanticsLabelsAPI:class"])
    proto = prim("Xform", "Proto", inner, specifier="class")
    copies = [xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in "ABC"]
    (note,) = lint_labels(stage(proto, *copies))
    assert note.prim_path == "/A/Seat"


def test_lints_given_prims_only(stage):
    wrong = stage(labelled(usd("class", "class")), thing(usd("class", "x"), name="Other"))
    assert [note.prim_path for note in lint_labels([wrong.GetPrimAtPath("/Other")])] == ["/Other"]
