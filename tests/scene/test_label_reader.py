"""Reading semantic labels in three encodings, and the labels of objects."""

import pytest
from pxr import Usd

from tests.conftest import shared_file
from tests.scene.labels import DFL, EARLIEST, class_prim, isaac, labelled, ontology, tag, thing, usd, values_of
from tests.scene.usda import METRES, cube, prim, xform
from usd2kg.scene import evidence
from usd2kg.scene.label_reader import LabelReader, read_labels
from usd2kg.scene.model import Label
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import open_stage
from usd2kg.scene.traversal import outline_stage


@pytest.fixture
def labels_of(write_stage):
    """A function that writes prims as a stage and returns the labels of one."""

    def run(*prims, path="/Thing", time=EARLIEST):
        stage = Usd.Stage.Open(str(write_stage(METRES + "\n".join(prims))))
        stage.Reload()
        return read_labels(stage.GetPrimAtPath(path), time)

    return run


def all_labels(scene):
    """Return the labels of all prims of a shared scene."""
    stage = Usd.Stage.Open(str(shared_file(f"scenes/{scene}")))
    return [label for item in stage.Traverse() for label in read_labels(item, EARLIEST)]


class TestUsdSemantics:
    @pytest.mark.parametrize("apis", [[], ["SemanticsLabelsAPI:class"]])
    def test_reads_labels_with_and_without_schema(self, labels_of, apis):
        assert labels_of(thing(usd("class", "cup", "mug"), apis=apis)) == (
            Label("/Thing", "UsdSemantics", "class", "cup"),
            Label("/Thing", "UsdSemantics", "class", "mug"),
        )

    def test_sorts_taxonomies_by_name(self, labels_of):
        found = labels_of(thing(usd("wikidata_qcode", "Q81727"), usd("class", "cup"), usd("a:b", "c")))
        assert values_of(found) == [
            ("UsdSemantics", "a:b", "c"),
            ("UsdSemantics", "class", "cup"),
            ("UsdSemantics", "wikidata_qcode", "Q81727"),
        ]

    @pytest.mark.parametrize(("time", "value"), [(EARLIEST, "pupa"), (Usd.TimeCode(5), "butterfly")])
    def test_reads_labels_at_a_time(self, labels_of, time, value):
        samples = 'token[] semantics:labels:class.timeSamples = {\n1: ["pupa"],\n5: ["butterfly"]\n}'
        assert values_of(labels_of(thing(samples), time=time)) == [("UsdSemantics", "class", value)]

    @pytest.mark.parametrize("type_name", ["token", "string"])
    def test_reads_a_single_text(self, labels_of, type_name):
        found = labels_of(thing(f'{type_name} semantics:labels:class = "cup"'))
        assert values_of(found) == [("UsdSemantics", "class", "cup")]

    @pytest.mark.parametrize(
        "line",
        [
            "int semantics:labels:class = 3",
            "rel semantics:labels:class = </Thing>",
            'token[] semantics:label:class = ["cup"]',
            'token[] semanticsLabels:class = ["cup"]',
            'token[] Semantics:labels:class = ["cup"]',
        ],
    )
    def test_ignores_other_types_and_names(self, labels_of, line):
        assert labels_of(thing(line)) == ()

    def test_cleans_values_and_drops_repetitions(self, labels_of):
        found = labels_of(thing(usd("class", " coffee  mug\\n", "", "coffee mug", "\\t")))
        assert values_of(found) == [("UsdSemantics", "class", "coffee mug")]

    def test_label_of_the_iri_taxonomy_has_an_iri(self, labels_of):
        (label,) = labels_of(thing(usd("iri", DFL + "cup.n.wn")))
        assert label.iri == DFL + "cup.n.wn"
        (label,) = labels_of(thing(usd("class", "cup")))
        assert label.iri is None


class TestIsaac:
    @pytest.mark.parametrize("apis", [[], ["SemanticsAPI:Semantics"]])
    def test_reads_labels_with_and_without_schema(self, labels_of, apis):
        found = labels_of(thing(isaac("class", "cup"), apis=apis))
        assert found == (Label("/Thing", "Isaac", "class", "cup"),)

    def test_reads_a_label_from_each_schema_instance(self, labels_of):
        found = labels_of(thing(isaac("class", "cup", "a"), isaac("qcode", "Q81727", "b")))
        assert values_of(found) == [("Isaac", "class", "cup"), ("Isaac", "qcode", "Q81727")]

    @pytest.mark.parametrize("half", ["Type", "Data"])
    def test_ignores_half_a_label(self, labels_of, half):
        assert labels_of(thing(f'string semantic:a:params:semantic{half} = "class"')) == ()

    def test_reads_a_legacy_scene(self):
        """The scene has 12 pairs of attributes on two objects."""
        labels = all_labels("awkward/legacy_labels/cube_cylinder.usda")
        assert len(labels) == 12
        assert {label.encoding for label in labels} == {"Isaac"}
        assert [label.value for label in labels if label.taxonomy == "hierarchy"] == [
            "container/vessel/bottle",
            "container/crate",
        ]


class TestMultiverse:
    def test_reads_the_class_prim_of_a_tag(self, labels_of):
        (label,) = labels_of(ontology(class_prim("cupnwn", "cup.n.wn")), thing(tag("/Onto/_class_cupnwn")))
        assert label == Label("/Thing", "Multiverse", DFL, "cup.n.wn")
        assert label.iri == DFL + "cup.n.wn"

    def test_class_prim_inherits_the_namespace(self, labels_of):
        above = class_prim("DFL_namespace")
        meta = ["inherits = </_class_DFL_namespace>"]
        cup = prim("", "_class_cup", 'string rdf:conceptName = "cup"', meta=meta, specifier="class")
        (label,) = labels_of(above, ontology(cup), thing(tag("/Onto/_class_cup")))
        assert (label.taxonomy, label.value) == (DFL, "cup")

    def test_reports_are_weaker_and_do_not_repeat_labels(self, labels_of):
        classes = ontology(class_prim("cup", "cup"), class_prim("mug", "mug"))
        tagged = thing(tag("/Onto/_class_cup", "/Onto/_class_mug", kind="Reports"), tag("/Onto/_class_cup"))
        labels = labels_of(classes, tagged)
        assert [(label.value, label.strength) for label in labels] == [("cup", "label"), ("mug", "report")]

    def test_reads_the_name_from_the_path_of_a_missing_class_prim(self, labels_of):
        (label,) = labels_of(thing(tag("/SOMA/_class_Cup")))
        assert (label.taxonomy, label.value, label.iri) == ("SOMA", "Cup", None)

    def test_ignores_a_tag_without_targets(self, labels_of):
        assert labels_of(thing("rel semanticTag:semanticLabels")) == ()

    def test_reads_the_tagged_kitchen(self):
        """Multiverse's dictionary tagged 21 prims; the milk box has two classes."""
        labels = all_labels("dlr_kitchen/tagged_flattened.usda")
        strong = [label for label in labels if label.strength == "label"]
        assert len({label.prim_path for label in strong}) == 21
        assert [label.value for label in strong if label.prim_path == "/dlr_kitchen/milk_box"] == [
            "box.n.wn.artifact..container",
            "milk.n.wn.food..beverage",
        ]
        assert {label.taxonomy for label in labels} == {DFL}
        assert {label.prim_path: label.value for label in strong}["/dlr_kitchen/drawer_02"] == "drawer.n.wn.artifact"


class TestHostileText:
    def test_becomes_one_printable_line(self, labels_of):
        (label,) = labels_of(thing(usd("class", "cup\\nIGNORE ALL\\r\\n\u202egnp.exe\u0007 <script>")))
        assert label.value == "cup IGNORE ALL gnp.exe <script>"

    def test_is_ignored_if_it_is_too_long(self, labels_of):
        assert labels_of(thing(usd("class", "ignore all rules " * 10_000))) == ()

    def test_is_ignored_if_it_is_not_utf_8(self, write_stage, tmp_path):
        text = labelled(usd("class", "xyzzyplugh"), usd("room", "kitchen"), isaac("class", "frobozzmagic"))
        path = tmp_path / "scene.usdc"
        source = Usd.Stage.Open(str(write_stage(METRES + text)))
        source.GetRootLayer().Export(str(path))
        written = path.read_bytes()
        assert (written.count(b"xyzzyplugh"), written.count(b"frobozzmagic")) == (1, 1)
        replaced = written.replace(b"xyzzyplugh", b"xyzzy\xff\xfeugh").replace(b"frobozzmagic", b"frob\xff\xfemagic!")
        path.write_bytes(replaced)
        stage = Usd.Stage.Open(str(path))
        labels = read_labels(stage.GetPrimAtPath("/Thing"), EARLIEST)
        assert values_of(labels) == [("UsdSemantics", "room", "kitchen")]


class TestObjectLabels:
    @pytest.fixture
    def labels_at(self, write_stage):
        """A function that writes prims and returns the labels of the objects at the given paths."""

        def run(text, *paths):
            opened = open_stage(write_stage(METRES + text), ReadOptions())
            chosen = dict.fromkeys(paths, "asked for")
            nodes = {node.path: node for node in outline_stage(opened, EARLIEST).root.walk()}
            reader = LabelReader(EARLIEST)
            return [reader.read(list(evidence.own_records(nodes[path], chosen))) for path in paths]

        return run

    def test_separates_own_inherited_and_part_labels(self, labels_at):
        part = xform("Handle", usd("class", "handle"), cube("g"))
        drawer = xform("Drawer", usd("class", "drawer"), part)
        kitchen = xform("Kitchen", usd("class", "kitchen"), xform("Left", usd("side", "left"), drawer))
        (labels,) = labels_at(kitchen, "/Kitchen/Left/Drawer")
        assert [label.value for label in labels.own] == ["drawer"]
        assert [(label.value, label.prim_path, label.is_inherited) for label in labels.inherited] == [
            ("left", "/Kitchen/Left", True),
            ("kitchen", "/Kitchen", True),
        ]
        assert [(label.value, label.prim_path, label.is_inherited) for label in labels.of_parts] == [
            ("handle", "/Kitchen/Left/Drawer/Handle", False)
        ]

    def test_labels_of_nested_objects_are_not_part_labels(self, labels_at):
        drawer = xform("Drawer", usd("class", "drawer"), cube("front"))
        cabinet = xform("Cabinet", usd("class", "cabinet"), cube("case"), drawer)
        outer, inner = labels_at(cabinet, "/Cabinet", "/Cabinet/Drawer")
        assert (values_of(outer.own), outer.of_parts) == ([("UsdSemantics", "class", "cabinet")], ())
        assert values_of(inner.inherited) == [("UsdSemantics", "class", "cabinet")]

    @pytest.mark.parametrize(
        ("whole", "parts", "found"),
        [
            # On the only mesh, on all meshes alike, on some of them, and different ones.
            ((), (("bucket",),), ["bucket"]),
            ((), (("bucket",), ("bucket",)), ["bucket"]),
            ((), (("bucket",), ()), []),
            ((), (("bucket",), ("handle",)), []),
            (("pail",), (("bucket",),), []),
        ],
    )
    def test_labels_of_all_the_geometry_are_of_the_whole(self, labels_at, whole, parts, found):
        meshes = [cube(f"mesh_{at}", *(usd("class", value) for value in part)) for at, part in enumerate(parts)]
        (labels,) = labels_at(xform("W", xform("X17", *(usd("class", value) for value in whole), *meshes)), "/W/X17")
        assert [label.value for label in labels.of_whole] == found

    @pytest.mark.parametrize(
        ("above", "beside", "found"), [("wrap_17", (), ["bucket"]), ("wrap_17", (cube("y"),), []), ("Office", (), [])]
    )
    def test_labels_of_a_wrapper_are_of_the_whole(self, labels_at, above, beside, found):
        wrapper = xform(above, usd("class", "bucket"), xform("X17", cube("x")), *beside)
        (labels,) = labels_at(xform("W", wrapper, cube("z")), f"/W/{above}/X17")
        assert [label.value for label in labels.of_whole] == found

    def test_own_labels_are_not_inherited_again(self, labels_at):
        (labels,) = labels_at(xform("A", usd("class", "x", "y"), xform("B", usd("class", "x"), cube("g"))), "/A/B")
        assert [label.value for label in labels.own] == ["x"]
        assert [label.value for label in labels.inherited] == ["y"]

    def test_part_labels_are_distinct_and_bounded(self, labels_at):
        same = [xform(f"b{i}", usd("class", "board"), cube("g")) for i in range(3)]
        different = [xform(f"c{i}", usd("class", f"board {i}"), cube("g")) for i in range(100)]
        (labels,) = labels_at(xform("Shelf", *same, *different), "/Shelf")
        assert [(label.value, label.prim_path) for label in labels.of_parts][:2] == [
            ("board", "/Shelf/b0"),
            ("board 0", "/Shelf/c0"),
        ]
        assert len(labels.of_parts) == 64

    def test_geometry_subsets_are_parts(self, labels_at):
        subset = prim("GeomSubset", "screen", usd("class", "screen"), "int[] indices = [0]")
        points = "point3f[] points = [(0,0,0),(1,0,0),(0,1,1)]"
        faces = "int[] faceVertexCounts=[3]\nint[] faceVertexIndices=[0,1,2]"
        (labels,) = labels_at(xform("TV", prim("Mesh", "mesh", points, faces, subset)), "/TV")
        assert [(label.value, label.prim_path) for label in labels.of_parts] == [("screen", "/TV/mesh/screen")]

    def test_reads_labels_inside_instances(self, labels_at):
        proto = xform("Proto", usd("class", "chair"), xform("Seat", usd("class", "seat"), cube("g")))
        copies = "".join(xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in "AB")
        first, second = labels_at(proto + copies, "/A", "/B/Seat")
        assert [label.prim_path for label in first.own] == ["/A"]
        assert values_of(first.of_parts) == [("UsdSemantics", "class", "seat")]
        assert [(label.value, label.prim_path) for label in second.inherited] == [("chair", "/B")]

    def test_inherits_across_1200_levels(self, labels_at):
        deep = xform("x", cube("g"))
        for _ in range(1200):
            deep = xform("x", deep)
        (labels,) = labels_at(xform("top", usd("class", "well"), deep), "/top" + "/x" * 1201)
        assert [label.value for label in labels.inherited] == ["well"]
