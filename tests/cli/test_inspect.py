"""usd2kg inspect: shapes, counts, the properties of one object, and similar diagnostics."""

import json
import sys
from itertools import takewhile

import pytest

from tests.cli.conftest import Run
from tests.scene.usda import METRES, component, cube, move, prim, rigid, xform

LABELLED = "token[] semantics:labels:class = ["
STEEL = prim(
    "Material",
    "Steel",
    "token outputs:surface.connect = </Room/Steel/Shader.outputs:surface>",
    prim(
        "Shader",
        "Shader",
        'uniform token info:id = "UsdPreviewSurface"',
        "color3f inputs:diffuseColor = (0.5, 0.25, 0.125)",
        "float inputs:metallic = 1",
        "token outputs:surface",
    ),
)
BOUND = "rel material:binding = </Room/Steel>"
BINDS = 'prepend apiSchemas = ["MaterialBindingAPI"]'
HINGE = prim(
    "PhysicsRevoluteJoint",
    "hinge",
    "rel physics:body0 = </Room/Cupboard>",
    "rel physics:body1 = </Room/Cupboard_Door>",
    'uniform token physics:axis = "Z"',
    "float physics:lowerLimit = 0",
    "float physics:upperLimit = 90",
)


@pytest.fixture
def kitchen(write_stage):
    """Return a stage: a labelled cupboard with a hinged door, a stool, and an object without geometry."""
    paint = prim("Cube", "board", "double size = 2", BOUND, meta=[BINDS])
    made = 'custom string maker = "Oak and Sons"'
    cupboard = rigid(
        "Cupboard", f'{LABELLED}"cupboard", "cabinet"]', made, paint, meta=['displayName = "wall cupboard"']
    )
    door = rigid("Cupboard_Door", move(3, 0, 0), cube("panel"))
    lost = component("Lost", prim("Mesh", "M"))
    walls = [cube("floor", move(0, 0, 0.05), size=0.1)]
    room = xform("Room", f'{LABELLED}"kitchen"]', cupboard, door, component("Stool", *walls), lost, HINGE, STEEL)
    return write_stage(METRES + room)


class TestShapes:
    def test_adds_columns(self, run: Run, kitchen):
        done = run("inspect", kitchen, "--shapes")
        assert (done.code, done.err) == (0, "")
        header, cupboard, *_ = done.out.splitlines()
        assert header.split("  ")[0] == "path"
        assert "tight box m" in header
        assert "2.000 × 2.000 × 2.000" in cupboard
        assert " 8000 " in cupboard
        assert " 0.81 " in cupboard

    def test_json_has_shapes(self, run: Run, kitchen):
        objects = {
            item["path"]: item for item in json.loads(run("inspect", kitchen, "--shapes", "--json").out)["objects"]
        }
        shape = objects["/Room/Cupboard"]["shape"]
        assert (shape["volume_m3"], shape["surface_m2"], shape["long_m"]) == pytest.approx((8, 24, 2))
        assert shape["capacity_m3"] == 0
        assert objects["/Room/Lost"]["shape"] is None

    def test_are_not_measured_by_default(self, run: Run, kitchen):
        assert "tight box" not in run("inspect", kitchen).out
        assert all("shape" not in item for item in json.loads(run("inspect", kitchen, "--json").out)["objects"])

    def test_measures_the_capacity_of_a_vessel(self, run: Run, write_stage):
        walls = [
            prim(
                "Cube",
                f"w{i}",
                "double size = 1",
                f"float3 xformOp:scale = {scale}",
                f"double3 xformOp:translate = {at}",
                'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]',
            )
            for i, (scale, at) in enumerate(
                [
                    ((1, 1, 0.1), (0, 0, 0.05)),
                    ((0.1, 1, 0.9), (-0.45, 0, 0.55)),
                    ((0.1, 1, 0.9), (0.45, 0, 0.55)),
                    ((0.8, 0.1, 0.9), (0, -0.45, 0.55)),
                    ((0.8, 0.1, 0.9), (0, 0.45, 0.55)),
                ]
            )
        ]
        scene = write_stage(METRES + component("Tub", *walls))
        shape = json.loads(run("inspect", scene, "--shapes", "--json").out)["objects"][0]["shape"]
        assert shape["capacity_m3"] == pytest.approx(0.8 * 0.8 * 0.9, rel=0.03)
        assert " litres of water as it stands, openness 0.5" in run("inspect", scene, "--why", "/Tub").out

    def test_why_without_scipy_names_the_extra(self, run: Run, kitchen, monkeypatch):
        monkeypatch.setitem(sys.modules, "scipy.spatial", None)
        assert "pip install 'usd2kg[shapes]'" in run("inspect", kitchen, "--why", "/Room/Cupboard").out

    def test_does_not_repeat_diagnostics(self, run: Run, kitchen):
        notes = json.loads(run("inspect", kitchen, "--shapes", "--json").out)["diagnostics"]
        assert len({json.dumps(note) for note in notes}) == len(notes)


class TestCounts:
    def test_counts_labels_joints_and_texts(self, run: Run, kitchen):
        # All four objects inherit the label of the room; it counts once.
        assert (
            "also read: 3 labels on 4 objects (3 UsdSemantics), 1 joint (1 revolute), 1 text on 1 object; "
            "--why PATH shows those of one object\n"
        ) in run("inspect", kitchen).out

    def test_counts_variants(self, run: Run, write_stage):
        cup = 'def Xform "Cup" ( kind = "component"\nvariants = { string size = "big" }\n' + (
            'prepend variantSets = "size" )\n{ def Cube "c" {}\nvariantSet "size" = {\n"big" {}\n"small" {}\n}\n}\n'
        )
        scene = write_stage(METRES + cup)
        assert "also read: 1 chosen variant on 1 object;" in run("inspect", scene).out
        assert "variants   size = big\n" in run("inspect", scene, "--why", "/Cup").out

    def test_prints_no_counts_of_zero(self, run: Run, room):
        assert "also read" not in run("inspect", room).out

    def test_shortens_lists_of_parts_in_the_table_only(self, run: Run, write_stage):
        scene = write_stage(METRES + component("Shelf", *(cube(f"board_{i}", at=(0, 0, 2 * i)) for i in range(9))))
        assert "board_5, … (9 in all)" in run("inspect", scene).out
        assert "board_5, board_6, board_7, board_8\n" in run("inspect", scene, "--why", "/Shelf").out


class TestWhy:
    @pytest.fixture
    def rows(self, run: Run, kitchen):
        """Return a function from a prim path to the first line and the rows by property."""

        def read(path):
            done = run("inspect", kitchen, "--why", path)
            assert (done.code, done.err) == (0, "")
            first, _, *lines = done.out.splitlines()
            width = next(i for i, c in enumerate(lines[0]) if i > len("name") and c != " ")
            found, name = {}, ""
            for line in lines:
                name = line[:width].strip() or name
                found.setdefault(name, []).append(line[width:])
            return first, found

        return read

    def test_shows_all_properties(self, rows):
        first, found = rows("/Room/Cupboard")
        assert first == "/Room/Cupboard is an object: rigid body"
        assert found["name"] == ["Cupboard"]
        assert found["display name"] == ["wall cupboard"]
        assert found["words"] == ["wall, cupboard"]
        assert found["box"] == ["2.00 × 2.00 × 2.00 m (w×d×h), centre at 0.00 0.00 0.00 m"]
        assert found["materials"] == ["Steel: linear RGB 0.50 0.25 0.12, metallic 1"]
        assert found["texts"] == ["maker: Oak and Sons"]
        assert found["labels"] == [
            "cupboard (UsdSemantics, class)",
            "cabinet (UsdSemantics, class)",
            "kitchen (UsdSemantics, class, from /Room)",
        ]
        assert found["joints"] == [
            "revolute: /Room/Cupboard_Door moves against it, about a vertical axis, from 0° to 90° (joint /Room/hinge)"
        ]
        assert found["volume"] == ["8000 litres enclosed, 8000 litres in its convex hull"]
        assert found["holds"] == ["no water as it stands"]

    def test_describes_a_joint_from_either_object(self, rows):
        joint = rows("/Room/Cupboard_Door")[1]["joints"]
        assert joint == [
            "revolute: it moves against /Room/Cupboard, about a vertical axis, from 0° to 90° (joint /Room/hinge)"
        ]

    def test_shows_an_object_without_geometry(self, rows):
        found = rows("/Room/Lost")[1]
        assert found["box"] == ["no geometry"]
        assert any(note.startswith("empty-box: ") for note in found["note"])
        assert "tight box" not in found

    def test_explains_a_prim_that_is_no_object(self, run: Run, kitchen):
        done = run("inspect", kitchen, "--why", "/Room/Cupboard/board")
        assert done.code == 0
        assert done.out.count("\n") == 1
        assert done.out.startswith("/Room/Cupboard/board is not an object: ")

    def test_explains_a_prim_on_a_stage_without_objects(self, run: Run, write_stage):
        done = run("inspect", write_stage('def Camera "view" {}\n'), "--why", "/view")
        assert (done.code, done.err) == (0, "")
        assert done.out.startswith("/view is not an object: ")

    @pytest.mark.parametrize("path", ["/Nowhere", "/Room/Cupboard[0]"])
    def test_rejects_an_unknown_prim(self, run: Run, kitchen, path):
        done = run("inspect", kitchen, "--why", path)
        assert (done.code, done.out) == (2, "")
        assert path in done.err

    def test_shows_an_instance_of_a_point_instancer(self, run: Run, write_stage):
        instancer = prim(
            "PointInstancer",
            "I",
            "int[] protoIndices = [0, 0]",
            "point3f[] positions = [(0, 0, 0), (5, 0, 0)]",
            "rel prototypes = </Shelf/I/P>",
            xform("P", cube("C")),
        )
        scene = write_stage(METRES + component("Shelf", cube("Board"), instancer))
        done = run("inspect", scene, "--why", "/Shelf/I[1]", "--expand-instancers")
        assert done.code == 0
        assert "centre at 5.00 0.00 0.00 m" in done.out

    def test_prints_json(self, run: Run, kitchen):
        data = json.loads(run("inspect", kitchen, "--why", "/Room/Cupboard_Door", "--json").out)
        assert (data["path"], data["why"]) == ("/Room/Cupboard_Door", "/Room/Cupboard_Door is an object: rigid body")
        assert data["object"]["shape"]["volume_m3"] == pytest.approx(1)
        assert [joint["prim_path"] for joint in data["object"]["joints"]] == ["/Room/hinge"]
        nothing = json.loads(run("inspect", kitchen, "--why", "/Room/hinge", "--json").out)
        assert nothing["object"] is None


class TestDiagnostics:
    @pytest.fixture
    def broken(self, write_stage):
        """Return a function that writes a stage with cups whose labels are the taxonomy name."""

        def write(count):
            cups = (component(f"Cup{i}", cube("c", at=(2 * i, 0, 0)), f'{LABELLED}"class"]') for i in range(count))
            return write_stage(METRES + "".join(cups))

        return write

    def label_lines(self, run, scene):
        lines = run("inspect", scene).out.splitlines()
        first = next(i for i, line in enumerate(lines) if "a name of a taxonomy" in line)
        return list(takewhile(lambda line: "is not applied" not in line, lines[first:]))

    def test_shows_three_similar_diagnostics(self, run: Run, broken):
        scene = broken(12)
        lines = self.label_lines(run, scene)
        assert [line.split()[1] for line in lines[:3]] == ["/Cup0", "/Cup1", "/Cup2"]
        assert lines[3].endswith("… and 9 more like it; --json has them all")
        assert len(lines) == 4
        notes = json.loads(run("inspect", scene, "--json").out)["diagnostics"]
        assert len([note for note in notes if "a name of a taxonomy" in note["message"]]) == 12

    @pytest.mark.parametrize("count", [1, 3, 4])
    def test_shows_up_to_four_similar_diagnostics(self, run: Run, broken, count):
        lines = self.label_lines(run, broken(count))
        assert len(lines) == count
        assert not any("more like it" in line for line in lines)


class TestUntrustedText:
    def test_replaces_control_characters(self, run: Run, write_stage):
        meta = ['displayName = "a\\x1b[2Jb\\nc"', 'doc = "\\x07d\u202ee"', 'kind = "x\\x1b]0;y"']
        scene = write_stage(METRES + component("Cup", cube("c"), f'{LABELLED}"\\x1b[31mred"]', meta=meta))
        for arguments in ((), ("--why", "/Cup"), ("--shapes",)):
            done = run("inspect", scene, *arguments)
            assert done.code == 0
            assert all(c.isprintable() or c == "\n" for c in done.out + done.err)
            assert not any(line.startswith("c") for line in done.out.splitlines())

    def test_json_escapes_control_characters(self, run: Run, write_stage):
        name = "a\x9b2Jb\u202ec"
        scene = write_stage(METRES + component("Cup", cube("c"), meta=[f'displayName = "{name}"']))
        done = run("inspect", scene, "--json")
        assert all(c.isprintable() or c == "\n" for c in done.out)
        assert json.loads(done.out)["objects"][0]["display_name"] == name
