"""Semantic labels that a stage carries: reading the three encodings, and finding what is wrong with them."""

import pytest
from pxr import Usd, UsdSemantics

from tests.conftest import shared_file
from tests.scene.usda import METRES, cube, prim, xform
from usd2kg.scene import evidence
from usd2kg.scene.label_lint import lint_labels
from usd2kg.scene.label_reader import LabelReader, read_labels
from usd2kg.scene.model import Label
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import open_stage
from usd2kg.scene.traversal import outline_stage

EARLIEST = Usd.TimeCode.EarliestTime()
DFL = "http://www.ease-crc.org/ont/SOMA_DFL.owl#"


@pytest.fixture
def stage(write_stage):
    """A function that writes prims as a stage and opens it; the stage lives as long as the test."""
    opened = []

    def run(*prims, layer=METRES):
        opened.append(Usd.Stage.Open(str(write_stage(layer + "\n".join(prims), f"scene{len(opened)}.usda"))))
        return opened[-1]

    return run


def usd(taxonomy, *values):
    listed = ", ".join(f'"{value}"' for value in values)
    return f"token[] semantics:labels:{taxonomy} = [{listed}]"


def isaac(taxonomy, value, instance="Semantics"):
    stem = f"string semantic:{instance}:params:semantic"
    return "\n".join([f'{stem}Type = "{taxonomy}"', f'{stem}Data = "{value}"'])


def tag(*paths, kind="Labels"):
    return f"rel semanticTag:semantic{kind} = [{', '.join(f'<{path}>' for path in paths)}]"


def class_prim(name, concept=None, namespace=DFL):
    lines = [f'string rdf:conceptName = "{concept}"'] if concept else []
    lines += [f'string rdf:namespace = "{namespace}"'] if namespace else []
    return prim("", f"_class_{name}", *lines, specifier="class")


def ontology(*classes):
    return prim("", "Onto", *classes)


def thing(*body, apis=(), name="Thing"):
    return xform(name, *body, cube("geometry"), apis=apis)


def told(labels):
    return [(label.encoding, label.taxonomy, label.value) for label in labels]


def read(a_stage, path="/Thing", time=EARLIEST):
    return read_labels(a_stage.GetPrimAtPath(path), time)


# --- OpenUSD's own ------------------------------------------------------------------------------------


def test_labels_of_openusd(stage):
    labelled = thing(usd("class", "cup", "mug"), apis=["SemanticsLabelsAPI:class"])
    assert read(stage(labelled)) == (
        Label("/Thing", "UsdSemantics", "class", "cup"),
        Label("/Thing", "UsdSemantics", "class", "mug"),
    )


def test_labels_without_applied_schema(stage):
    assert told(read(stage(thing(usd("class", "cup"))))) == [("UsdSemantics", "class", "cup")]


def test_schema_without_labels(stage):
    assert read(stage(thing(apis=["SemanticsLabelsAPI:class"]))) == ()


def test_labels_of_several_taxonomies_come_by_name(stage):
    labelled = thing(usd("wikidata_qcode", "Q81727"), usd("class", "cup"), usd("a:b", "c"))
    assert told(read(stage(labelled))) == [
        ("UsdSemantics", "a:b", "c"),
        ("UsdSemantics", "class", "cup"),
        ("UsdSemantics", "wikidata_qcode", "Q81727"),
    ]


def test_labels_over_time(stage):
    samples = 'token[] semantics:labels:class.timeSamples = {\n1: ["pupa"],\n5: ["butterfly"]\n}'
    changing = stage(thing(samples))
    assert told(read(changing)) == [("UsdSemantics", "class", "pupa")]
    assert told(read(changing, time=Usd.TimeCode(5))) == [("UsdSemantics", "class", "butterfly")]


@pytest.mark.parametrize("type_name", ["token", "string"])
def test_a_single_text_is_taken(stage, type_name):
    assert told(read(stage(thing(f'{type_name} semantics:labels:class = "cup"')))) == [("UsdSemantics", "class", "cup")]


@pytest.mark.parametrize("line", ["int semantics:labels:class = 3", "rel semantics:labels:class = </Thing>"])
def test_what_is_no_text_is_no_label(stage, line):
    odd = stage(thing(line))
    assert read(odd) == ()
    kind = "of type int" if line.startswith("int") else "a relationship"
    assert messages(odd)[0] == (
        f"semantics:labels:class is {kind}, in which OpenUSD finds no labels, expected token[]; "
        "author it anew with that type"
    )


@pytest.mark.parametrize("name", ["semantics:label:class", "semanticsLabels:class", "Semantics:labels:class"])
def test_names_that_only_look_like_labels(stage, name):
    assert read(stage(thing(f'token[] {name} = ["cup"]'))) == ()


def test_values_are_cleaned_and_kept_once(stage):
    assert told(read(stage(thing(usd("class", " coffee  mug\\n", "", "coffee mug", "\\t"))))) == [
        ("UsdSemantics", "class", "coffee mug")
    ]


def test_iri_taxonomy_gives_the_iri(stage):
    (label,) = read(stage(thing(usd("iri", DFL + "cup.n.wn"))))
    assert label.iri == DFL + "cup.n.wn"
    (label,) = read(stage(thing(usd("class", "cup"))))
    assert label.iri is None


# --- Isaac and Replicator -----------------------------------------------------------------------------


@pytest.mark.parametrize("apis", [[], ["SemanticsAPI:Semantics"]])
def test_labels_of_isaac(stage, apis):
    assert read(stage(thing(isaac("class", "cup"), apis=apis))) == (Label("/Thing", "Isaac", "class", "cup"),)


def test_each_instance_is_a_label(stage):
    two = thing(isaac("class", "cup", "a"), isaac("qcode", "Q81727", "b"))
    assert told(read(stage(two))) == [("Isaac", "class", "cup"), ("Isaac", "qcode", "Q81727")]


@pytest.mark.parametrize("half", ["Type", "Data"])
def test_half_a_label_is_none(stage, half):
    assert read(stage(thing(f'string semantic:a:params:semantic{half} = "class"'))) == ()


def test_legacy_scene():
    """12 pairs of old-style attributes: six on each of two objects."""
    scene = Usd.Stage.Open(str(shared_file("scenes/awkward/legacy_labels/cube_cylinder.usda")))
    labels = [label for item in scene.Traverse() for label in read_labels(item, EARLIEST)]
    assert len(labels) == 12
    assert {label.encoding for label in labels} == {"Isaac"}
    assert [label.value for label in labels if label.taxonomy == "hierarchy"] == [
        "container/vessel/bottle",
        "container/crate",
    ]
    assert lint_labels(scene) == []


# --- Multiverse ---------------------------------------------------------------------------------------


def test_labels_of_multiverse(stage):
    tagged = thing(tag("/Onto/_class_cupnwn"))
    (label,) = read(stage(ontology(class_prim("cupnwn", "cup.n.wn")), tagged))
    assert label == Label("/Thing", "Multiverse", DFL, "cup.n.wn")
    assert label.iri == DFL + "cup.n.wn"


def test_namespace_is_inherited_from_the_ontologys_class(stage):
    above = class_prim("DFL_namespace")
    inherits = 'string rdf:conceptName = "cup"'
    cup = prim("", "_class_cup", inherits, meta=["inherits = </_class_DFL_namespace>"], specifier="class")
    (label,) = read(stage(above, ontology(cup), thing(tag("/Onto/_class_cup"))))
    assert (label.taxonomy, label.value) == (DFL, "cup")


def test_reports_are_weaker_and_labels_are_not_repeated(stage):
    classes = ontology(class_prim("cup", "cup"), class_prim("mug", "mug"))
    tagged = thing(tag("/Onto/_class_cup", "/Onto/_class_mug", kind="Reports"), tag("/Onto/_class_cup"))
    labels = read(stage(classes, tagged))
    assert [(label.value, label.strength) for label in labels] == [("cup", "label"), ("mug", "report")]


def test_class_that_is_missing_gives_the_name_in_its_path(stage):
    (label,) = read(stage(thing(tag("/SOMA/_class_Cup"))))
    assert (label.taxonomy, label.value, label.iri) == ("SOMA", "Cup", None)


def test_tag_without_targets(stage):
    assert read(stage(thing("rel semanticTag:semanticLabels"))) == ()


def test_tagged_kitchen():
    """Multiverse's dictionary tagged 21 prims; the milk box is a box and milk."""
    scene = Usd.Stage.Open(str(shared_file("scenes/dlr_kitchen/tagged_flattened.usda")))
    labels = [label for item in scene.Traverse() for label in read_labels(item, EARLIEST)]
    strong = [label for label in labels if label.strength == "label"]
    assert len({label.prim_path for label in strong}) == 21
    assert [label.value for label in strong if label.prim_path == "/dlr_kitchen/milk_box"] == [
        "box.n.wn.artifact..container",
        "milk.n.wn.food..beverage",
    ]
    assert {label.taxonomy for label in labels} == {DFL}
    by_path = {label.prim_path: label.value for label in strong}
    assert by_path["/dlr_kitchen/drawer_02"] == "drawer.n.wn.artifact"
    (note,) = lint_labels(scene)
    assert note.prim_path == "/dlr_kitchen/kitchenette"
    assert note.message.startswith("SemanticTagAPI is applied, but no label of it is authored")


# --- whose label --------------------------------------------------------------------------------------


@pytest.fixture
def objects(write_stage):
    """A function that writes prims and returns the labels of the objects at the given paths."""

    def run(text, *paths):
        opened = open_stage(write_stage(METRES + text), ReadOptions())
        chosen = dict.fromkeys(paths, "asked for")
        nodes = {node.path: node for node in outline_stage(opened, EARLIEST).root.walk()}
        reader = LabelReader(EARLIEST)
        return [reader.read(list(evidence.own_nodes(nodes[path], chosen))) for path in paths]

    return run


def test_own_inherited_and_parts_are_kept_apart(objects):
    part = xform("Handle", usd("class", "handle"), cube("g"))
    drawer = xform("Drawer", usd("class", "drawer"), part)
    kitchen = xform("Kitchen", usd("class", "kitchen"), xform("Left", usd("side", "left"), drawer))
    (labels,) = objects(kitchen, "/Kitchen/Left/Drawer")
    assert [label.value for label in labels.own] == ["drawer"]
    assert [(label.value, label.prim_path, label.is_inherited) for label in labels.inherited] == [
        ("left", "/Kitchen/Left", True),
        ("kitchen", "/Kitchen", True),
    ]
    assert [(label.value, label.prim_path, label.is_inherited) for label in labels.of_parts] == [
        ("handle", "/Kitchen/Left/Drawer/Handle", False)
    ]


def test_labels_of_nested_objects_are_theirs(objects):
    drawer = xform("Drawer", usd("class", "drawer"), cube("front"))
    cabinet = xform("Cabinet", usd("class", "cabinet"), cube("case"), drawer)
    outer, inner = objects(cabinet, "/Cabinet", "/Cabinet/Drawer")
    assert (told(outer.own), outer.of_parts) == ([("UsdSemantics", "class", "cabinet")], ())
    assert told(inner.inherited) == [("UsdSemantics", "class", "cabinet")]


def test_inherited_labels_that_the_object_has_itself_are_not_repeated(objects):
    (labels,) = objects(xform("A", usd("class", "x", "y"), xform("B", usd("class", "x"), cube("g"))), "/A/B")
    assert [label.value for label in labels.own] == ["x"]
    assert [label.value for label in labels.inherited] == ["y"]


def test_parts_tell_each_label_once(objects):
    boards = [xform(f"b{i}", usd("class", "board"), cube("g")) for i in range(3)]
    (labels,) = objects(xform("Shelf", *boards), "/Shelf")
    assert [(label.value, label.prim_path) for label in labels.of_parts] == [("board", "/Shelf/b0")]


def test_number_of_part_labels_is_bounded(objects):
    boards = [xform(f"b{i}", usd("class", f"board {i}"), cube("g")) for i in range(100)]
    (labels,) = objects(xform("Shelf", *boards), "/Shelf")
    assert len(labels.of_parts) == 64


def test_geometry_subsets_are_parts(objects):
    subset = prim("GeomSubset", "screen", usd("class", "screen"), "int[] indices = [0]")
    points = "point3f[] points = [(0,0,0),(1,0,0),(0,1,1)]\nint[] faceVertexCounts=[3]\nint[] faceVertexIndices=[0,1,2]"
    (labels,) = objects(xform("TV", prim("Mesh", "mesh", points, subset)), "/TV")
    assert [(label.value, label.prim_path) for label in labels.of_parts] == [("screen", "/TV/mesh/screen")]


def test_labels_of_instances(objects):
    proto = xform("Proto", usd("class", "chair"), xform("Seat", usd("class", "seat"), cube("g")))
    copies = "".join(xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in "AB")
    first, second = objects(proto + copies, "/A", "/B/Seat")
    assert [label.prim_path for label in first.own] == ["/A"]
    assert told(first.of_parts) == [("UsdSemantics", "class", "seat")]
    assert [(label.value, label.prim_path) for label in second.inherited] == [("chair", "/B")]


def test_a_very_deep_stage_is_read(objects):
    deep = xform("x", cube("g"))
    for _ in range(1200):
        deep = xform("x", deep)
    path = "/x" * 1201
    (labels,) = objects(xform("top", usd("class", "well"), deep), "/top" + path)
    assert [label.value for label in labels.inherited] == ["well"]


# --- lint ---------------------------------------------------------------------------------------------


def messages(a_stage):
    notes = lint_labels(a_stage)
    assert {note.code for note in notes} <= {"label"}
    return [note.message for note in notes]


def labelled(*lines):
    """Return a prim with its labels and all their schemas applied, so that just the labels can be wrong."""
    apis = []
    for line in "\n".join(lines).splitlines():
        name = line.split()[1]
        if name.startswith("semantics:labels:"):
            apis.append("SemanticsLabelsAPI:" + name.removeprefix("semantics:labels:"))
        elif name.startswith("semantic:"):
            apis.append("SemanticsAPI:" + name.split(":")[1])
        elif name.startswith("semanticTag:"):
            apis.append("SemanticTagAPI")
    return thing(*lines, apis=list(dict.fromkeys(apis)))


def test_good_labels_have_no_diagnostics(stage):
    good = labelled(
        usd("class", "coffee mug", "mug"),
        usd("wikidata_qcode", "Q81727"),
        usd("iri", DFL + "Cup"),
        isaac("class", "CoffeeMug", "a"),
        isaac("qcode", "Q81727", "b"),
        isaac("hierarchy", "container/vessel/mug", "c"),
        tag("/Onto/_class_mugnwnartifact"),
    )
    assert messages(stage(ontology(class_prim("mugnwnartifact", "mug.n.wn.artifact")), good)) == []


def test_diagnostic_says_where(stage, tmp_path):
    (note,) = lint_labels(stage(labelled(usd("class", "class"))))
    assert (note.code, note.prim_path) == ("label", "/Thing")
    assert note.layer == str(tmp_path / "scene0.usda")


def test_diagnostic_names_the_layer_of_the_opinion_that_counts(stage, write_stage):
    write_stage(METRES + labelled(usd("class", "cup")), "base.usda")
    over = prim("", "Thing", usd("class", "class"), specifier="over")
    layer = "(\n    subLayers = [@./base.usda@]\n)\n"
    (note,) = lint_labels(stage(over, layer=layer))
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
def test_name_of_a_taxonomy_in_place_of_a_label(stage, taxonomy, value):
    expected = f"is '{value}', a name of a taxonomy or schema and no label; author the label"
    assert messages(stage(labelled(usd(taxonomy, value)))) == [f"semantics:labels:{taxonomy} {expected}"]
    assert messages(stage(labelled(isaac(taxonomy, value)))) == [f"semantic:Semantics:params:semanticData {expected}"]


@pytest.mark.parametrize("value", ["Classroom", "class 5", "hierarchical", "semantics book"])
def test_words_that_hold_a_taxonomy_name_are_labels(stage, value):
    assert messages(stage(labelled(usd("class", value)))) == []


@pytest.mark.parametrize("taxonomy", ["wikidata_qcode", "qcode", "prop_general_qcode"])
@pytest.mark.parametrize("value", ["81727", "q81727", "Q 81727", "Q81727x", "http://www.wikidata.org/entity/Q81727"])
def test_qcode_that_is_none(stage, taxonomy, value):
    (message,) = messages(stage(labelled(usd(taxonomy, value))))
    assert message.endswith(f"is '{value}', expected a Wikidata item such as Q11422; correct it or remove it")


@pytest.mark.parametrize(("taxonomy", "value"), [("wikidata_qcode", "Q1"), ("class", "81727"), ("qcodes", "none")])
def test_qcodes_that_are_right_or_none_of_our_business(stage, taxonomy, value):
    assert messages(stage(labelled(usd(taxonomy, value)))) == []


def test_empty_and_blank_values(stage):
    nothing = "holds no label (empty, blank or not text), expected one; author it or remove it"
    assert messages(stage(labelled(usd("class")))) == [f"semantics:labels:class {nothing}"]
    assert messages(stage(labelled(usd("class", " ", "")))) == [f"semantics:labels:class {nothing}"]
    assert messages(stage(labelled(isaac("class", " ")))) == [f"semantic:Semantics:params:semanticData {nothing}"]
    some = messages(stage(labelled(usd("class", "cup", " "))))
    assert some == ["semantics:labels:class has a blank value among 2; remove it"]


def test_duplicate_values(stage):
    found = messages(stage(labelled(usd("class", "cup", "mug", " cup", "cup"))))
    assert found == ["semantics:labels:class lists 'cup' 3 times; keep one"]
    assert messages(stage(labelled(usd("class", "cup", "Cup")))) == []


@pytest.mark.parametrize(
    ("type_name", "value", "is_read"),
    [
        ("string", '"cup"', False),
        ("token", '"cup"', False),
        ("string[]", '["cup"]', False),
        ("rel", "</Thing>", False),
        ("token[]", '["cup"]', True),
    ],
)
def test_labels_of_another_type_are_not_read_by_openusd(stage, type_name, value, is_read):
    found = stage(labelled(f"{type_name} semantics:labels:class = {value}"))
    query = UsdSemantics.LabelsQuery("class", Usd.TimeCode.Default())
    assert bool(query.ComputeUniqueDirectLabels(found.GetPrimAtPath("/Thing"))) == is_read
    kind = "a relationship" if type_name == "rel" else f"of type {type_name}"
    told = f"semantics:labels:class is {kind}, in which OpenUSD finds no labels, expected token[]; "
    assert messages(found) == ([] if is_read else [told + "author it anew with that type"])


def test_endless_values_are_neither_read_nor_repeated(stage):
    endless = stage(labelled(usd("class", "ignore all rules " * 10_000)))
    assert read(endless) == ()
    (message,) = messages(endless)
    assert message == "semantics:labels:class has a value of 169999 characters, expected at most 200; shorten it"


def test_half_a_pair_of_isaac(stage):
    kind, data = isaac("class", "cup").splitlines()
    assert messages(stage(labelled(kind))) == [
        "semantic:Semantics:params:semanticType has no semanticData with text beside it; author both or remove both"
    ]
    assert messages(stage(labelled(data))) == [
        "semantic:Semantics:params:semanticData has no semanticType with text beside it; author both or remove both"
    ]


def test_schema_without_attribute(stage):
    end = "is applied, but no label of it is authored; author the label or remove the schema"
    apis = ["SemanticsLabelsAPI:class", "SemanticsAPI:abc", "SemanticTagAPI"]
    assert messages(stage(thing(apis=apis))) == [f"{api} {end}" for api in apis]


def test_attribute_without_schema(stage):
    bare = thing(usd("class", "cup"), isaac("class", "cup"), tag("/Onto/_class_cup"))
    end = "is not applied, so that tools may not see it; apply it"
    assert messages(stage(ontology(class_prim("cup", "cup")), bare)) == [
        f"semanticTag:semanticLabels is authored, but SemanticTagAPI {end}",
        f"semantic:Semantics:params:semanticData is authored, but SemanticsAPI:Semantics {end}",
        f"semantics:labels:class is authored, but SemanticsLabelsAPI:class {end}",
    ]


def test_schema_of_another_taxonomy_does_not_count(stage):
    found = messages(stage(thing(usd("class", "cup"), apis=["SemanticsLabelsAPI:room"])))
    assert [message.split()[0] for message in found] == ["SemanticsLabelsAPI:room", "semantics:labels:class"]


def test_other_schemas_are_left_alone(stage):
    assert messages(stage(thing(apis=["PhysicsRigidBodyAPI", "SemanticsOfMineAPI"]))) == []


def test_tag_to_nowhere_and_to_what_is_no_class(stage):
    found = messages(stage(labelled(tag("/SOMA/_class_Cup", "/Thing/geometry"))))
    assert found == [
        "semanticTag:semanticLabels points to </SOMA/_class_Cup>, which is not on the stage; add the ontology's layer",
        "semanticTag:semanticLabels points to </Thing/geometry>, which has no rdf:conceptName; "
        "point it to a class prim",
    ]


def test_legacy_block_that_contradicts(stage):
    stale = labelled(usd("class", "cup"), isaac("class", "banana"))
    assert messages(stage(stale)) == [
        "semantics:labels:class says 'cup', but the older class in semantic:*:params says 'banana'; "
        "keep the right one and remove the other"
    ]


def test_qcodes_that_contradict(stage):
    (message,) = messages(stage(labelled(usd("wikidata_qcode", "Q1"), isaac("qcode", "Q2"))))
    assert message.startswith("semantics:labels:wikidata_qcode says 'Q1', but the older qcode")


@pytest.mark.parametrize(
    ("new", "old"),
    [("cup", "Cup"), ("coffee_mug", "CoffeeMug"), ("mug", "coffee mug"), ("杯子", "杯子"), ("☕", "☕")],
)
def test_legacy_block_that_says_the_same(stage, new, old):
    assert messages(stage(labelled(usd("class", new), isaac("class", old)))) == []


def test_legacy_block_of_another_taxonomy_is_no_contradiction(stage):
    assert messages(stage(labelled(usd("class", "cup"), isaac("room", "kitchen")))) == []


@pytest.mark.parametrize(
    ("label", "encoding"),
    [
        (usd("class", "cup"), "UsdSemantics"),
        (usd("iri", DFL + "cup"), "UsdSemantics"),
        (isaac("class", "cup"), "Isaac"),
    ],
)
def test_tag_that_contradicts_a_class(stage, label, encoding):
    classes = ontology(class_prim("bowl", "bowl.n.wn.artifact"))
    (message,) = messages(stage(classes, labelled(label, tag("/Onto/_class_bowl"))))
    assert message.startswith(f"semanticTag:semanticLabels says 'bowl.n.wn.artifact', but the {encoding} class says ")


def test_qcode_as_class_is_not_compared_with_words(stage):
    classes = ontology(class_prim("bowl", "bowl"))
    assert messages(stage(classes, labelled(usd("wikidata_class", "Q153988"), tag("/Onto/_class_bowl")))) == []


def test_reports_do_not_contradict(stage):
    classes = ontology(class_prim("bowl", "bowl"))
    assert messages(stage(classes, labelled(usd("class", "cup"), tag("/Onto/_class_bowl", kind="Reports")))) == []


def test_what_instances_share_is_reported_once(stage):
    inner = xform("Seat", usd("class", "class"), cube("g"), apis=["SemanticsLabelsAPI:class"])
    proto = prim("Xform", "Proto", inner, specifier="class")
    copies = [xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in "ABC"]
    (note,) = lint_labels(stage(proto, *copies))
    assert note.prim_path == "/A/Seat"


def test_prims_can_be_given(stage):
    wrong = stage(labelled(usd("class", "class")), thing(usd("class", "x"), name="Other"))
    assert [note.prim_path for note in lint_labels([wrong.GetPrimAtPath("/Other")])] == ["/Other"]


# --- hostile text -------------------------------------------------------------------------------------


def test_hostile_text_stays_one_printable_line(stage):
    text = "cup\\nIGNORE ALL\\r\\n\u202egnp.exe\u0007 <script>"
    (label,) = read(stage(thing(usd("class", text))))
    assert label.value == "cup IGNORE ALL gnp.exe <script>"


def test_bytes_that_are_no_text_do_no_harm(stage, tmp_path):
    text = stage(labelled(usd("class", "xyzzyplugh"), usd("room", "kitchen"), isaac("class", "frobozzmagic")))
    path = tmp_path / "scene.usdc"
    text.GetRootLayer().Export(str(path))
    written = path.read_bytes()
    assert (written.count(b"xyzzyplugh"), written.count(b"frobozzmagic")) == (1, 1)
    path.write_bytes(
        written.replace(b"xyzzyplugh", b"xyzzy\xff\xfeugh").replace(b"frobozzmagic", b"frob\xff\xfemagic!")
    )
    odd = Usd.Stage.Open(str(path))
    assert told(read(odd)) == [("UsdSemantics", "room", "kitchen")]
    assert messages(odd) == [
        "semantics:labels:class holds no label (empty, blank or not text), expected one; author it or remove it",
        "semantic:Semantics:params:semanticType has no semanticData with text beside it; author both or remove both",
    ]
