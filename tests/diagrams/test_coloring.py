"""Colours of objects: groups, ranks, legends drawn into pictures, and that colour-blind people tell them apart."""

import io
import itertools
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from tests.conftest import shared_file
from tests.scene.usda import METRES, component, cube, ops
from usd2kg.cli.render import render_command
from usd2kg.diagrams import Coloring, LegendEntry, add_legend, color_by_answer
from usd2kg.diagrams.coloring import color_by_confidence, color_by_group
from usd2kg.diagrams.settings import COLORS, CONFIDENCE
from usd2kg.errors import GraphError, OutputError
from usd2kg.render import Renderer
from usd2kg.render.png import encode_png

Image = pytest.importorskip("PIL.Image")

# Rows of RGB to RGB, linear, for complete protanopia and deuteranopia: Machado, Oliveira and Fernandes 2009, table 1.
PROTANOPIA = [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
DEUTERANOPIA = [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]


def linear(colors):
    """Return linear RGB of colours #rrggbb, one a row, by the definition of sRGB."""
    values = np.array([[int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)] for color in colors])
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def oklab(rgb):
    """Return OKLab of linear RGB (https://bottosson.github.io/posts/oklab)."""
    cones = rgb @ np.transpose(
        [
            [0.4122214708, 0.5363325363, 0.0514459929],
            [0.2119034982, 0.6806995451, 0.1073969566],
            [0.0883024619, 0.2817188376, 0.6299787005],
        ]
    )
    return np.cbrt(np.clip(cones, 0, None)) @ np.transpose(
        [
            [0.2104542553, 0.7936177850, -0.0040720468],
            [1.9779984951, -2.4285922050, 0.4505937099],
            [0.0259040371, 0.7827717662, -0.8086757660],
        ]
    )


def pixels_of(png):
    with Image.open(io.BytesIO(png)) as opened:
        return np.asarray(opened.convert("RGB"))


def share_of(pixels, color):
    """Return the share of pixels that have a colour, lit from dark to bright: its hue and chroma in OKLab."""
    lab = oklab(linear([f"#{r:02x}{g:02x}{b:02x}" for r, g, b in pixels.reshape(-1, 3)]))
    wanted = oklab(linear([color]))[0]
    chroma = np.linalg.norm(lab[:, 1:], axis=1)
    cosine = (lab[:, 1:] @ wanted[1:]) / np.maximum(chroma * np.linalg.norm(wanted[1:]), 1e-9)
    return float(((cosine > 0.97) & (chroma > 0.35 * np.linalg.norm(wanted[1:]))).mean())


# Colours


@pytest.mark.parametrize("vision", [np.eye(3), PROTANOPIA, DEUTERANOPIA])
@pytest.mark.parametrize("colors", [(*COLORS.categories, COLORS.rest), (*CONFIDENCE.colors, COLORS.rest)])
def test_colours_differ_also_for_colour_blind_people(colors, vision):
    lab = oklab(np.clip(linear(colors) @ np.transpose(vision), 0, 1))
    differences = [float(np.linalg.norm(a - b)) for a, b in itertools.combinations(lab, 2)]
    # 0.02 is a just noticeable difference.
    assert min(differences) > 0.07


def test_the_page_has_the_same_colours():
    root = Path(__file__).parents[2]
    subprocess.run([sys.executable, "-m", "tools.write_palette", "--check"], check=True, cwd=root)


def test_the_largest_groups_come_first():
    groups = {"/a": "cup", "/b": "table", "/c": "cup", "/d": None, "/e": "bed"}
    labels = {"bed": "bed", "cup": "cup", "table": "dining table"}
    legend = color_by_group(groups, labels, groups, "no class").legend
    assert legend == (
        LegendEntry("cup", COLORS.categories[0], ("/a", "/c")),
        LegendEntry("bed", COLORS.categories[1], ("/e",)),
        LegendEntry("dining table", COLORS.categories[2], ("/b",)),
        LegendEntry("no class", COLORS.rest, ("/d",)),
    )


def test_a_correction_changes_no_colour_of_a_class():
    before = {"/a": "cup", "/b": "cup", "/c": "table", "/d": "table", "/e": "table"}
    after = {**before, "/c": "cup", "/d": "cup", "/e": "bowl"}
    labels = {name: name for name in ("bowl", "cup", "table")}
    legend = color_by_group(after, labels, before, "no class").legend
    assert [(entry.label, entry.color) for entry in legend] == [
        ("cup", COLORS.categories[1]),
        ("bowl", COLORS.categories[2]),
    ]


def test_more_groups_than_colours_share_the_last_one():
    groups = {f"/{i}": f"class {i:02}" for i in range(30)}
    legend = color_by_group({**groups, "/none": None}, {g: g for g in groups.values()}, groups, "no class").legend
    assert len(legend) == len(COLORS.categories) + 1
    assert (legend[-1].label, len(legend[-1].prim_paths)) == ("others or no class", 30 - len(COLORS.categories) + 1)


def test_a_confidence_that_is_not_given_is_not_a_low_one():
    legend = color_by_confidence({"/a": 0.95, "/b": 0.949, "/c": 0.0, "/d": None}).legend
    assert [(entry.label, entry.prim_paths) for entry in legend] == [
        ("0.95 to 1", ("/a",)),
        ("0.80 to 0.95", ("/b",)),
        ("below 0.20", ("/c",)),
        ("not given", ("/d",)),
    ]


def test_linear_colours_are_of_all_objects():
    colors = color_by_answer(["/a", "/b"], {"/b"}).linear_colors()
    assert colors["/b"] == pytest.approx(tuple(linear([COLORS.answer])[0]))
    assert colors["/"] == colors["/a"] == pytest.approx(tuple(linear([COLORS.rest])[0]))


# Legend


def test_the_legend_is_beside_the_picture():
    picture = np.random.default_rng(0).integers(0, 256, (40, 60, 3), dtype=np.uint8)
    coloring = Coloring(tuple(LegendEntry(f"class {i}", color, ("/a",)) for i, color in enumerate(COLORS.categories)))
    pixels = pixels_of(add_legend(encode_png(picture), coloring, "Class"))
    assert np.array_equal(pixels[:40, :60], picture)
    column = pixels[:, 60:].reshape(-1, 3).tolist()
    for color in COLORS.categories:
        # A square of 12 x 12 pixels without its corners.
        assert column.count([int(color[i : i + 2], 16) for i in (1, 3, 5)]) > 100
    paper = pixels[-1, -1]
    assert (pixels[:, -3:] == paper).all() and (pixels[-3:, 60:] == paper).all(), "the text ends before the border"


@pytest.mark.parametrize("label", ["W" * 80, "食卓" * 40, "<b>&\x07" * 100])
def test_long_and_hostile_names_are_not_cut_at_the_border(label):
    picture = encode_png(np.zeros((20, 20, 3), np.uint8))
    pixels = pixels_of(add_legend(picture, Coloring((LegendEntry(label, "#e69f00", ("/a",)),)), label))
    assert (pixels[:, -5:] == pixels[-1, -1]).all()


# Pictures


@pytest.fixture
def kitchen(write_stage):
    floor = component(
        "Floor", cube("Slab", ops(("double3", "translate", (0, 0, -0.05)), ("double3", "scale", (4, 4, 0.1))))
    )
    table = component(
        "Table", cube("Top", ops(("double3", "translate", (0, 0, 0.4)), ("double3", "scale", (1, 1, 0.8))))
    )
    mug = component("Mug", cube("Body", size=0.3, at=(0, 0, 0.95)))
    return write_stage(METRES + floor + table + mug)


def invoke(*arguments):
    app = typer.Typer()
    app.command()(render_command)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_objects_have_the_colours_of_the_legend(kitchen):
    pixels = pixels_of(
        Renderer(kitchen).render_scene(size=(120, 90), colors={"/Mug": (0.8, 0.0, 0.0), "/": (0.0, 0.0, 0.8)})
    )
    assert 0.005 < share_of(pixels, "#ff0000") < 0.1
    assert share_of(pixels, "#0000ff") > 0.2


def test_the_command_colours_by_class(kitchen, tmp_path):
    target = tmp_path / "k.png"
    result = invoke(kitchen, "-o", target, "--color-by", "class", "--size", "160x120")
    assert (result.exit_code, result.stdout) == (0, "")
    pixels = pixels_of(target.read_bytes())
    assert pixels.shape[1] > 160 and pixels.shape[0] == 120
    for color in COLORS.categories[:3]:
        assert share_of(pixels[:, :160], color) > 0.005
        assert share_of(pixels[:, 160:], color) > 0.003


def test_the_command_colours_by_support(kitchen, tmp_path):
    target = tmp_path / "k.png"
    assert invoke(kitchen, "-o", target, "--color-by", "support", "--size", "160x120").exit_code == 0
    picture = pixels_of(target.read_bytes())[:, :160]
    # The table is on the floor, which comes first in the scene, and the mug on the table.
    table, mug = (share_of(picture, color) for color in COLORS.categories[:2])
    assert table > mug > 0.005
    assert share_of(picture, COLORS.categories[2]) < 0.001


def test_the_command_highlights_an_answer(kitchen, tmp_path):
    target = tmp_path / "k.png"
    result = invoke(kitchen, "-o", target, "--ask", "what stands on the table?", "--size", "160x120")
    assert "; 1 object\n" in result.stderr
    picture = pixels_of(target.read_bytes())[:, :160]
    assert 0.005 < share_of(picture, COLORS.answer) < 0.2


def test_decisions_change_the_class(kitchen, tmp_path):
    decisions = tmp_path / "d.csv"
    decisions.write_text("path,decision\n/Mug,none\n", "utf-8")
    targets = [tmp_path / "before.png", tmp_path / "after.png"]
    invoke(kitchen, "-o", targets[0], "--color-by", "class", "--size", "160x120")
    invoke(kitchen, "-o", targets[1], "--color-by", "class", "--size", "160x120", "--decisions", decisions)
    before, after = (pixels_of(target.read_bytes())[:, :160] for target in targets)
    lost = [share_of(before, color) > 0.005 > share_of(after, color) for color in COLORS.categories[:3]]
    assert lost.count(True) == 1


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (
            ["--color-by", "weight"],
            OutputError,
            "concept, confidence, room, support or answer",
        ),
        (["--color-by", "answer"], OutputError, "needs a question"),
        (["--color-by", "room", "--ask", "where is the mug?"], OutputError, "does not show the answer"),
        (["/Mug", "--color-by", "room", "--context"], OutputError, "without --color-by"),
        (["--decisions", "d.csv"], OutputError, "choose another --color-by"),
        (["--ask", "what is on the xylophone?"], GraphError, "xylophone"),
    ],
)
def test_errors_of_the_command(kitchen, tmp_path, arguments, error, message):
    result = invoke(kitchen, *arguments, "-o", tmp_path / "x.png")
    assert isinstance(result.exception, error)
    assert message in str(result.exception)


def is_slow(*modes):
    return [pytest.param(mode, marks=pytest.mark.slow) for mode in modes]


@pytest.mark.parametrize("mode", ["class", "room", *is_slow("concept", "confidence", "support")])
def test_real_scenes_have_the_colours_of_their_legend(tmp_path, mode):
    check_legend(shared_file("scenes/aws_robomaker/small_house.usdc"), tmp_path / "house.png", mode)


@pytest.mark.parametrize("mode", ["concept", "confidence", "support"])
def test_a_small_scene_has_the_colours_of_its_legend(kitchen, tmp_path, mode):
    check_legend(kitchen, tmp_path / "kitchen.png", mode)


def check_legend(scene, target, mode):
    assert invoke(scene, "-o", target, "--color-by", mode, "--size", "320x240").exit_code == 0
    pixels = pixels_of(target.read_bytes())
    first = CONFIDENCE.colors[0] if mode == "confidence" else COLORS.categories[0]
    if mode != "room":
        assert share_of(pixels[:240, :320], first) > 0.003
    column = pixels[:, 320:].reshape(-1, 3).tolist()
    shown = first if mode != "room" else COLORS.rest
    assert column.count([int(shown[i : i + 2], 16) for i in (1, 3, 5)]) > 100
