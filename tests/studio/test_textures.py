"""Textures: where they lie on a mesh, which files are opened, and what is shown where there is no image."""

import io
import logging
import os

import numpy as np
import pytest
from pxr import Sdf, UsdUtils

from tests.conftest import shared_file
from tests.scene.usda import METRES
from tests.studio.test_geometry import document, open_files
from usd2kg.studio import geometry_files
from usd2kg.studio import texture_images as texture_module
from usd2kg.studio.settings import GEOMETRY, TEXTURES

Image = pytest.importorskip("PIL.Image")

VERTEX = 'texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")'
# Two quads that share an edge; the second shows the image a second time, so the edge is a seam.
FACE_VARYING = (
    'texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "faceVarying")\n'
    "int[] primvars:st:indices = [0, 1, 2, 3, 0, 1, 2, 3]"
)
ONE_QUAD = ("[4]", "[0, 1, 2, 3]", "[(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]")
TWO_QUADS = (
    "[4, 4]",
    "[0, 1, 2, 3, 1, 4, 5, 2]",
    "[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)]",
)


def poster(file, uv=VERTEX, mesh=ONE_QUAD, texture="", reader=""):
    """Return a stage with a textured board, whose display colour is red."""
    counts, indices, points = mesh
    return f"""#usda 1.0
{METRES}
def Xform "Poster" (kind = "component")
{{
    def Mesh "Board" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        int[] faceVertexCounts = {counts}
        int[] faceVertexIndices = {indices}
        point3f[] points = {points}
        color3f[] primvars:displayColor = [(1, 0, 0)]
        {uv}
        rel material:binding = </Poster/Paint>
    }}
    def Material "Paint"
    {{
        asset inputs:picture = @{file}@
        token outputs:surface.connect = </Poster/Paint/Surface.outputs:surface>
        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor.connect = </Poster/Paint/Image.outputs:rgb>
            token outputs:surface
        }}
        def Shader "Image"
        {{
            uniform token info:id = "UsdUVTexture"
            asset inputs:file.connect = </Poster/Paint.inputs:picture>
            float2 inputs:st.connect = </Poster/Paint/Coordinates.outputs:result>
            {texture}
            float3 outputs:rgb
        }}
        def Shader "Coordinates"
        {{
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            {reader}
            float2 outputs:result
        }}
    }}
}}
"""


@pytest.fixture
def write_poster(tmp_path):
    def write(file="picture.png", **options):
        path = tmp_path / "poster.usda"
        path.write_text(poster(file, **options), "utf-8")
        return path

    return write


@pytest.fixture
def picture(tmp_path):
    """A file of 1024 x 512 pixels, blue with a green upper left quarter."""
    image = Image.new("RGB", (1024, 512), (0, 0, 255))
    image.paste((0, 255, 0), (0, 0, 512, 256))
    path = tmp_path / "picture.png"
    image.save(path)
    return path


def primitives(files):
    return document(files.file(0))["meshes"][0]["primitives"]


def shown(files, index=0):
    found = files.texture(index)
    return None if found is None else Image.open(io.BytesIO(found.content))


def test_an_image_is_scaled_down(write_poster, picture):
    files, _ = open_files(write_poster())
    (primitive,) = primitives(files)
    assert primitive["extras"] == {"texture": 0, "wrap": ["repeat", "repeat"], "scale": [1, 1, 1]}
    image = shown(files)
    assert (image.format, image.size) == ("JPEG", (512, 256))
    assert image.getpixel((10, 10)) == pytest.approx((0, 255, 0), abs=8)
    assert image.getpixel((500, 10)) == pytest.approx((0, 0, 255), abs=8)


def accessor(content, index):
    """Return the values of an accessor of a GLB file, three or two floats a row."""
    described = document(content)
    record = described["accessors"][index]
    start = 28 + int.from_bytes(content[12:16], "little") + described["bufferViews"][record["bufferView"]]["byteOffset"]
    width = {"VEC2": 2, "VEC3": 3}[record["type"]]
    return np.frombuffer(content, "<f4", record["count"] * width, start).reshape(-1, width)


def coordinates(files):
    """Return (x, y, u, v) of each point, with v upwards, as OpenUSD has it."""
    content = files.file(0)
    attributes = document(content)["meshes"][0]["primitives"][0]["attributes"]
    points, uv = accessor(content, attributes["POSITION"]), accessor(content, attributes["TEXCOORD_0"])
    return {tuple(np.round((x, y, u, 1 - v), 3).tolist()) for (x, y, _), (u, v) in zip(points, uv, strict=True)}


def test_vertex_coordinates(write_poster, picture):
    files, _ = open_files(write_poster())
    assert coordinates(files) == {(0, 0, 0, 0), (2, 0, 1, 0), (2, 1, 1, 1), (0, 1, 0, 1)}


def test_points_at_a_seam_are_split(write_poster, picture):
    files, _ = open_files(write_poster(uv=FACE_VARYING, mesh=TWO_QUADS))
    left = {(0, 0, 0, 0), (1, 0, 1, 0), (1, 1, 1, 1), (0, 1, 0, 1)}
    right = {(1, 0, 0, 0), (2, 0, 1, 0), (2, 1, 1, 1), (1, 1, 0, 1)}
    assert coordinates(files) == left | right


def test_a_transform_of_coordinates(write_poster, picture):
    # in * scale * rotate + translation: (1, 0) → (2, 0) → (0, 2) → (0.5, 2).
    stage = write_poster()
    text = stage.read_text("utf-8").replace(
        "</Poster/Paint/Coordinates.outputs:result>", "</Poster/Paint/Turn.outputs:result>"
    )
    turn = """def Shader "Turn"
        {
            uniform token info:id = "UsdTransform2d"
            float2 inputs:in.connect = </Poster/Paint/Coordinates.outputs:result>
            float inputs:rotation = 90
            float2 inputs:scale = (2, 1)
            float2 inputs:translation = (0.5, 0)
            float2 outputs:result
        }
        def Shader "Image\""""
    stage.write_text(text.replace('def Shader "Image"', turn), "utf-8")
    files, _ = open_files(stage)
    assert coordinates(files) == {(0, 0, 0.5, 0), (2, 0, 0.5, 2), (2, 1, -0.5, 2), (0, 1, -0.5, 0)}


def test_wrapping_and_scale(write_poster, picture):
    options = 'token inputs:wrapS = "mirror"\ntoken inputs:wrapT = "clamp"\nfloat4 inputs:scale = (0.5, 2, 0, 1)'
    (primitive,) = primitives(open_files(write_poster(texture=options))[0])
    assert primitive["extras"] == {"texture": 0, "wrap": ["mirror", "clamp"], "scale": [0.5, 1, 0]}


def test_a_picture_in_a_package(write_poster, picture, tmp_path):
    package = tmp_path / "poster.usdz"
    assert UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(write_poster())), str(package))
    picture.unlink()
    files, _ = open_files(package)
    primitives(files)
    assert shown(files).size == (512, 256)


NO_FIT = [
    "",
    VERTEX.replace("(0, 1)]", "(0, nan)]"),
    VERTEX.replace(", (0, 1)]", "]"),
    FACE_VARYING.replace("faceVarying", "uniform"),
]


@pytest.mark.parametrize("uv", NO_FIT)
def test_without_fitting_coordinates_the_display_colour_is_shown(write_poster, picture, uv):
    (primitive,) = primitives(open_files(write_poster(uv=uv))[0])
    assert "extras" not in primitive and "TEXCOORD_0" not in primitive["attributes"]


def bomb(path):
    """Write a PNG of 80 megapixels, in a few bytes."""
    Image.new("1", (10000, 8000)).save(path)


POSTSCRIPT = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n"
HOSTILE = {
    "missing": (lambda path: None, "missing"),
    "text": (lambda path: path.write_bytes(b"root:x:0:0"), "cannot be decoded"),
    "cut": (lambda path: path.write_bytes(path.with_name("picture.png").read_bytes()[:600]), "cannot be decoded"),
    "gigapixel": (bomb, "too many"),
    "folder": (lambda path: path.mkdir(), "not a file"),
    "pipe": (os.mkfifo, "not a file"),
    "postscript": (
        lambda path: path.write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n"),
        "cannot be decoded",
    ),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_a_file_that_is_no_image_is_warned_about_once(write_poster, picture, tmp_path, caplog, case):
    make, message = HOSTILE[case]
    make(tmp_path / "hostile.png")
    files, _ = open_files(write_poster("hostile.png"))
    primitives(files)
    with caplog.at_level(logging.WARNING):
        assert shown(files) is None
        assert shown(files) is None
    (record,) = caplog.records
    assert "hostile.png" in record.getMessage() and message in record.getMessage()


def test_a_large_file_is_not_read(write_poster, picture, monkeypatch):
    monkeypatch.setattr(texture_module, "TEXTURES", TEXTURES._replace(max_file_bytes=100))
    files, _ = open_files(write_poster())
    primitives(files)
    assert shown(files) is None


def test_the_budget_of_a_scene(write_poster, picture, monkeypatch):
    monkeypatch.setattr(texture_module, "TEXTURES", TEXTURES._replace(max_scene_bytes=1000))
    files, _ = open_files(write_poster())
    primitives(files)
    assert shown(files) is None


def test_decimated_meshes_have_no_texture(write_poster, picture, monkeypatch):
    monkeypatch.setattr(geometry_files, "GEOMETRY", GEOMETRY._replace(max_triangles=1, min_mesh_triangles=1))
    (primitive,) = primitives(open_files(write_poster())[0])
    assert "extras" not in primitive


def test_a_texture_that_no_file_names(write_poster, picture):
    files, _ = open_files(write_poster())
    with pytest.raises(IndexError):
        files.texture(0)


def test_a_real_scene():
    files, paths = open_files(shared_file("scenes/iai_apartment/apartment.usdc"))
    textured = set()
    for i in range(len(files.manifest()["chunks"])):
        content = document(files.file(i))
        with_texture = [any("extras" in p for p in mesh["primitives"]) for mesh in content.get("meshes", [])]
        found = [node["extras"]["object"] for node in content.get("nodes", []) if with_texture[node["mesh"]]]
        textured |= {paths[index] for index in found}
    assert {path.rpartition("/")[2] for path in textured} == {"bedside_table"}
    assert shown(files).size == (512, 512)
