"""usd2kg convert: a stage from a file of another format."""

from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from tests.cli.conftest import Run
from usd2kg.studio import PROJECT_FILE, ProjectSources

pytest.importorskip("trimesh", reason="needs the extra convert")

CUP = "o Cup\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@pytest.fixture
def cup(tmp_path: Path) -> Path:
    path = tmp_path / "cup.obj"
    path.write_text(CUP)
    return path


def test_writes_a_stage_with_the_given_unit(run: Run, cup: Path):
    done = run("convert", cup, "--metres-per-unit", "0.01", "--up-axis", "Z")
    assert (done.code, done.out) == (0, "")
    assert done.err.splitlines()[0].startswith("OBJ states neither units nor an up axis")
    assert done.err.splitlines()[-1].endswith("written to cup.usdc")
    stage = Usd.Stage.Open("cup.usdc")
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.01
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert stage.GetPrimAtPath("/cup/Cup/mesh").IsA(UsdGeom.Mesh)


@pytest.mark.parametrize("command", ["inspect", "ground", "build"])
def test_commands_take_the_file_itself(run: Run, cup: Path, command: str):
    done = run(command, cup)
    assert done.code == 0
    assert "cup" in (done.out + done.err).lower()


def test_labels_need_a_stage_on_disk(run: Run, cup: Path):
    run("ground", cup, "-o", "cup.csv")
    done = run("label", cup, "cup.csv")
    assert done.code == 2
    assert "usd2kg convert" in done.err


@pytest.fixture
def flat(cup: Path) -> Path:
    folder = cup.parent / "my.flat"
    (folder / "kitchen").mkdir(parents=True)
    for name in ("coffee cup", "plate"):
        (folder / "kitchen" / f"{name}.obj").write_text(CUP)
    return folder


def test_a_folder_is_converted_as_one_scene(run: Run, flat: Path):
    (flat / "kitchen" / "broken.obj").write_text("f 1 2 3")
    done = run("convert", flat)
    assert (done.code, done.out) == (0, "")
    assert any("kitchen/broken.obj: cannot be converted" in line for line in done.err.splitlines())
    assert done.err.splitlines()[-1].endswith("written to my.flat.usdc")
    stage = Usd.Stage.Open("my.flat.usdc")
    assert stage.GetPrimAtPath("/my_flat/kitchen/coffee_cup").GetDisplayName() == "coffee cup"


@pytest.mark.parametrize("command", ["inspect", "ground", "build", "render"])
def test_commands_take_the_folder_itself(run: Run, flat: Path, command: str):
    done = run(command, flat)
    assert done.code == 0
    assert "flat" in done.out + done.err


def test_a_folder_is_compared_with_its_graph(run: Run, flat: Path):
    run("build", flat, "-o", "before.ttl")
    (flat / "kitchen" / "plate.obj").unlink()
    done = run("diff", "before.ttl", flat)
    assert "plate" in done.out


def test_the_studio_opens_a_folder_as_a_scene_or_as_a_project(run: Run, flat: Path, monkeypatch: pytest.MonkeyPatch):
    opened: list[tuple[Path, Path | None]] = []

    def serve(folder: Path, sources: ProjectSources | None, *_: object, **__: object) -> None:
        opened.append((folder, sources and sources.scene))

    monkeypatch.setattr("usd2kg.studio.serve_studio", serve)
    project = flat.parent / "flat.studio"
    project.mkdir()
    for folder in (flat, project):
        assert run("studio", folder, "--no-browser").code == 0
    (flat / PROJECT_FILE).touch()
    run("studio", flat, "--no-browser")
    assert opened == [(Path("my.flat.studio"), flat), (project, None), (flat, None)]


def test_labels_of_a_folder_need_a_stage_on_disk(run: Run, flat: Path):
    run("ground", flat, "-o", "flat.csv")
    done = run("label", flat, "flat.csv")
    assert done.code == 2
    assert "usd2kg convert" in done.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["cup.obj", "-o", "cup.glb"], "expected a USD layer"),
        (["cup.obj", "-o", "no/cup.usdc"], "does not exist"),
        (["cup.obj", "--up-axis", "X"], "expected Y or Z"),
        (["missing.obj"], "no such file"),
        (["cup.usda"], "USD stages need no conversion"),
        (["cup.fbx"], "no known format (ending '.fbx'), expected one of .glb, .gltf, .obj, .urdf, .xml, .ifc, .ifczip"),
    ],
)
def test_refuses_what_cannot_be_converted(run: Run, arguments: list[str], message: str):
    for name in ("cup.obj", "cup.usda", "cup.fbx"):
        Path(name).write_text(CUP)
    done = run("convert", *arguments)
    assert done.code == 2
    assert message in done.err
    assert len(done.err.splitlines()) == 1
    assert sorted(path.name for path in Path().iterdir()) == ["cup.fbx", "cup.obj", "cup.usda"]
