"""A fuzz test of the stage reader: small stages are mangled at random and read, each in a child process.

`python -m tests.scene.fuzzing --seconds 600 --seed 1 [--keep DIR]` prints what happened to how many stages and
returns 1 if the reader broke its promise: a sane Scene or a SceneError of one line, in time and in silence. Mangled
files may crash OpenUSD itself, or keep it busy for ever; this is counted apart. The same seed makes the same files.
"""

import argparse
import ctypes
import faulthandler
import importlib
import itertools
import json
import math
import os
import random
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple

from pxr import Sdf, Tf, Usd, UsdGeom

import usd2kg
from tests.conftest import SHARED
from tests.scene.usda import METRES, component, cube, header, move, ops, prim, rigid, xform
from usd2kg.errors import SceneError
from usd2kg.scene import Box, Joint, MaterialDetails, ReadOptions, Scene, SceneObject, read_scene
from usd2kg.scene.stage import captured_diagnostics

SECONDS = 10
"""Time that one case may take."""
_MEMORY = 4 * 2**30
_LARGEST = 100_000
"""Bytes of the largest file of others that is mangled."""
_KEPT = 3
"""Cases kept of each failure."""
_REPOSITORY = Path(__file__).parents[2]
_PACKAGE = str(Path(usd2kg.__file__).parent)
_READY = "ready\n"


class Outcome(StrEnum):
    """What can become of a case."""

    READ = "read"
    REFUSED = "refused"
    EXCEPTION = "other exception"
    INSANE = "insane scene"
    TALKED = "wrote to the terminal"
    HUNG = "too slow"
    MEMORY = "out of memory"
    DIED = "died"
    OPENUSD_DIED = "OpenUSD died"
    OPENUSD_BUSY = "OpenUSD too slow or out of memory"
    OPENUSD_TALKED = "OpenUSD wrote to the terminal, past its diagnostics"


OPENUSDS = frozenset({Outcome.OPENUSD_DIED, Outcome.OPENUSD_BUSY, Outcome.OPENUSD_TALKED})
"""Outcomes that are not the reader's fault."""


class Verdict(NamedTuple):
    """What became of one case."""

    outcome: Outcome
    place: str = ""
    """Innermost line of usd2kg, or what is insane: equal for equal faults."""
    detail: str = ""


# --- corpus -------------------------------------------------------------------------------------------

Files = dict[str, bytes]
"""Name → content of one stage's files, the root layer first."""

_TRIANGLES = (
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 2)]\nint[] faceVertexCounts = [3, 3]\n"
    "int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]"
)
_CHAIR = xform("Chair", prim("Mesh", "Seat", _TRIANGLES), cube("Leg", at=(1, 0, -1)), kind="component",
               meta=['assetInfo = { string name = "Chair_01"\nasset identifier = @./chair.usd@ }'])  # fmt: skip
_OPS = (
    ("double3", "translate", "(1, 2, 3)"), ("float3", "translate:pivot", "(1, 0, 0)"), ("float", "rotateX", 30),
    ("double", "rotateY", -45), ("half", "rotateZ", 90), ("float3", "rotateXYZ", "(10, 20, 30)"),
    ("quatf", "orient", "(0.5, 0.5, 0.5, 0.5)"), ("float3", "scale", "(1, 2, 0.5)"),
    ("matrix4d", "transform", "( (1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (4, 5, 6, 1) )"),
)  # fmt: skip


def own_corpus() -> dict[str, Files]:
    """Return small stages by name, as text; `base.usda` is a layer beside the root that others refer to."""
    base = METRES.replace("(\n", '(\n    defaultPrim = "Chair"\n', 1) + _CHAIR
    stages = {
        "kinds": _kinds(), "arcs": _arcs(), "variants": _variants(), "instances": _instances(),
        "instancer": _instancer(), "meshes": _meshes(), "xforms": _xforms(), "materials": _materials(),
        "physics": _physics(), "labels": _labels(), "time": _time(), "texts": _texts(), "classes": _classes(),
    }  # fmt: skip
    return {
        name: {"scene.usda": f"#usda 1.0\n{text}".encode(), "base.usda": f"#usda 1.0\n{base}".encode()}
        for name, text in stages.items()
    }


def _kinds():
    table = component("Table", cube("top", size=2), xform("legs", cube("a"), cube("b", purpose="guide")))
    hidden = cube("Hidden", 'token visibility = "invisible"')
    room = xform("Room", table, xform("Sub", cube("c"), kind="subcomponent"), hidden, kind="group")
    return METRES + xform("World", room, prim("Camera", "Eye"), prim("SphereLight", "Lamp"), kind="assembly")


def _arcs():
    prims = [
        xform("A", move(1, 0, 0), meta=["prepend references = @./base.usda@"]),
        xform("B", meta=["payload = @./base.usda@</Chair>"]),
        xform("C", cube("own"), meta=["references = [</World/A>, @./missing.usd@</Thing>]"]),
        prim("", "D", move(0, 9, 0), meta=["references = @./base.usda@</Chair> (offset = 2; scale = 0.5)"]),
    ]
    over = prim("", "Chair", prim("", "Seat", "rel material:binding = </World/A>", specifier="over"), specifier="over")
    return METRES.replace(")", "    subLayers = [@./base.usda@]\n)", 1) + xform("World", *prims) + over


def _variants():
    ball = prim("Sphere", "top", "double radius = 2")
    sets = f'variantSet "shape" = {{\n"round" {{\n{ball}}}\n"flat" {{\n{cube("top")}}}\n}}'
    red = "color3f[] primvars:displayColor = [(1, 0, 0)]"
    inner = f'variantSet "color" = {{\n"red" (payload = @./base.usda@) {{\n{red}\n}}\n}}'
    picked = ['variants = { string shape = "round"\nstring color = "red" }', 'prepend variantSets = ["shape", "color"]']
    return METRES + xform("World", component("Table", sets, inner, meta=picked), cube("Box", at=(3, 0, 0)))


def _instances():
    shared = ["instanceable = true", "references = </Shelf>"]
    copies = [xform(name, move(i, 0, 0), meta=shared) for i, name in enumerate("AB")]
    shelf = xform("Shelf", component("Cup", cube("c")), xform("N", meta=["instanceable = true", "inherits = </_Cup>"]))
    return METRES + shelf + xform("World", *copies) + prim("", "_Cup", cube("g"), specifier="class")


def _instancer():
    lines = [
        "int[] protoIndices = [0, 1, 0]", "point3f[] positions = [(0, 0, 0), (1, 1, 1), (2, 2, 2)]",
        "quath[] orientations = [(1, 0, 0, 0), (0, 1, 0, 0), (0.5, 0.5, 0.5, 0.5)]", "int64[] ids = [7, 8, 9]",
        "float3[] scales = [(1, 1, 1), (2, 2, 2), (1, 0, 1)]", "int64[] invisibleIds = [8]",
        "rel prototypes = [</World/Trees/P/Oak>, </World/Trees/P/Fir>]", "vector3f[] velocities = [(1, 0, 0)]",
    ]  # fmt: skip
    protos = prim("Scope", "P", xform("Oak", cube("o")), prim("Sphere", "Fir", "double radius = 0.5"))
    inactive = "inactiveIds = [9]"
    return METRES + xform("World", prim("PointInstancer", "Trees", *lines, protos, meta=[inactive]), cube("Box"))


def _meshes():
    extent = "float3[] extent = [(0, 0, 0), (1, 1, 2)]"
    normals = 'normal3f[] normals = [(0, 0, 1), (0, 1, 0)] (interpolation = "uniform")'
    subset = prim("GeomSubset", "s", 'uniform token elementType = "face"', "int[] indices = [0]",
                  'uniform token familyName = "materialBind"')  # fmt: skip
    turned = ops(("double3", "rotateXYZ", (20, 30, 40)))
    hint = "float3[] extentsHint = [(0, 0, 0), (1, 2, 3), (0, 0, 0), (1, 1, 1)]"
    meshes = [
        prim("Mesh", "M", _TRIANGLES, extent, normals, subset),
        prim("Mesh", "T", _TRIANGLES, turned, "color3f[] primvars:displayColor = [(1, 0, 0)]"),
        prim("Points", "P", "point3f[] points = [(0, 0, 0), (3, 3, 3)]", "float[] widths = [0.5]"),
        prim("BasisCurves", "C", "point3f[] points = [(0, 0, 0), (1, 1, 1)]", "int[] curveVertexCounts = [2]"),
        prim("Cylinder", "Y", 'uniform token axis = "X"', "double height = 3", "double radius = 1"),
        prim("NurbsPatch", "N", "point3f[] points = [(0, 0, 0)]"), component("H", hint), prim("Plane", "F"),
    ]  # fmt: skip
    return METRES + xform("World", *meshes)


def _xforms():
    every = xform("All", ops(*_OPS), cube("c"), kind="component")
    order = 'uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:scale", "!invert!xformOp:scale"]'
    reset = component("Reset", "float3 xformOp:scale = (2, 2, 0)", order, cube("c"))
    single = [component(f"S{i}", ops(op), cube("c")) for i, op in enumerate(_OPS)]
    return header(metersPerUnit=0.01, upAxis="Y") + xform("World", move(1, 1, 1), every, reset, *single)


def _materials():
    shader = prim("Shader", "s", 'uniform token info:id = "UsdPreviewSurface"', "float inputs:roughness = 0.5",
                  "color3f inputs:diffuseColor = (0.1, 0.2, 0.3)", "token outputs:surface",
                  "float inputs:opacity.connect = </Looks/Red.inputs:o>", "float inputs:metallic = 1")  # fmt: skip
    red = prim("Material", "Red", "token outputs:surface.connect = </Looks/Red/s.outputs:surface>",
               "float inputs:o = 0.5", shader)  # fmt: skip
    wood = prim("Material", "Wood", "token outputs:mdl:surface.connect = </Looks/Wood/m.outputs:out>",
                prim("Shader", "m", "color3f inputs:diffuse_color_constant = (1, 0, 0)",
                     "asset inputs:diffuse_texture = @wood.png@", "token outputs:out"))  # fmt: skip
    api = ['prepend apiSchemas = ["MaterialBindingAPI", "CollectionAPI:all"]']
    subset = prim("GeomSubset", "s", "int[] indices = [0]", 'uniform token familyName = "materialBind"',
                  "rel material:binding = </Looks/Wood>", meta=api)  # fmt: skip
    collection = ["rel collection:all:includes = </World/Chair>",
                  "rel material:binding:collection:x = [</World.collection:all>, </Looks/Red>]"]  # fmt: skip
    chair = component("Chair", "rel material:binding = </Looks/Red>", prim("Mesh", "m", _TRIANGLES, subset), meta=api)
    odd = cube("Odd", "rel material:binding:preview = </Looks/Gone>", meta=api)
    return METRES + xform("World", *collection, chair, odd, meta=api) + prim("Scope", "Looks", red, wood)


def _physics():
    mass = ['prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]']
    lid = xform("Lid", "float physics:mass = 2.5", move(0, 0, 1), cube("g"), meta=mass)
    bodies = ["rel physics:body0 = </World/Pot>", "rel physics:body1 = </World/Pot/Lid>"]
    limits = ["float physics:lowerLimit = -90", "float physics:upperLimit = inf"]
    hinge = prim("PhysicsRevoluteJoint", "Hinge", *bodies, *limits, 'uniform token physics:axis = "Z"',
                 "quatf physics:localRot0 = (0.7, 0.7, 0, 0)", "float state:angular:physics:position = 12",
                 "bool physics:jointEnabled = 0")  # fmt: skip
    slide = prim("PhysicsPrismaticJoint", "Slide", *bodies[1:], *limits, "quatf physics:localRot1 = (0, 0, 0, 0)")
    others = [prim(f"Physics{kind}Joint", kind, *bodies) for kind in ("Fixed", "Spherical", "Distance")]
    gear = prim("PhysxPhysicsGearJoint", "Gear", *bodies)
    pot = rigid("Pot", cube("g", "float physics:mass = 1", meta=mass[:1]), lid)
    layer = header(metersPerUnit=1, upAxis="Z", kilogramsPerUnit=0.001)
    return layer + xform("World", pot, hinge, slide, *others, gear) + prim("PhysicsScene", "Scene")


def _labels():
    usd = ['token[] semantics:labels:class = ["cup", "mug"]', 'token[] semantics:labels:wikidata_qcode = ["Q81727"]']
    isaac = ['string semantic:a:params:semanticType = "class"', 'string semantic:a:params:semanticData = "cup"']
    tag = ["rel semanticTag:semanticLabels = </Onto/_class_cup>", "rel semanticTag:semanticReports = </Onto/_class_x>"]
    apis = ["SemanticsLabelsAPI:class", "SemanticsAPI:a", "SemanticTagAPI"]
    cup = xform("Cup", *usd, *isaac, *tag, cube("g", *isaac), apis=apis)
    concept = ['string rdf:conceptName = "cup.n.wn"', 'string rdf:namespace = "http://example.org/x.owl#"']
    onto = prim("", "Onto", prim("", "_class_cup", *concept, specifier="class"), specifier="class")
    return METRES + xform("World", cup, component("Other", cube("g")), *usd[:1]) + onto


def _time():
    moved = "double3 xformOp:translate.timeSamples = { -1: (0, 0, 0), 5: (1, 2, 3), 9.5: None }"
    order = 'uniform token[] xformOpOrder = ["xformOp:translate"]'
    shown = 'token visibility.timeSamples = { 0: "inherited", 3: "invisible" }'
    points = "point3f[] points.timeSamples = { 0: [(0, 0, 0), (1, 1, 1)], 2: [(0, 0, 0)] }"
    layer = header(metersPerUnit=1, upAxis="Z", startTimeCode=1, endTimeCode=9, timeCodesPerSecond=24)
    label = 'token[] semantics:labels:class.timeSamples = { 0: ["cup"], 1: [] }'
    return layer + xform("World", cube("A", moved, order), cube("B", shown), prim("Mesh", "M", points, label))


def _texts():
    custom = ['custom string note = "a red cup"', 'custom token[] userProperties:tags = ["kitchen", "cup"]',
              'custom asset file = @cup.png@', "custom double weight = 1.5"]  # fmt: skip
    meta = ['"""A comment\nof two lines"""', 'displayName = "Cup \\"No. 1\\""', 'doc = "What it is"',
            'customData = { string room = "kitchen"\ndictionary d = { int n = 1\ntoken[] t = ["a"] } }',
            'assetInfo = { asset identifier = @cup.usd@\nstring name = "Cup"\nstring version = "1" }',
            "hidden = true", "active = true"]  # fmt: skip
    layer = '(\n    metersPerUnit = 0.0254\n    upAxis = "Y"\n    doc = "d"\n    customLayerData = { int a = 1 }\n)\n'
    return layer + xform("World", component("Cup", *custom, cube("g"), meta=meta), cube("Box"))


def _classes():
    base = prim("", "_Base", cube("g"), 'token[] semantics:labels:class = ["lamp"]', specifier="class")
    derived = prim("", "_Lamp", move(1, 0, 0), meta=["inherits = </_Base>"], specifier="class")
    lamps = [xform("A", meta=["inherits = </_Lamp>"]), xform("B", meta=["specializes = </_Lamp>"], kind="component")]
    moved = "relocates = { </World/A/g> : </World/A/h> }"
    return METRES.replace(")", f"    {moved}\n)", 1) + base + derived + xform("World", *lamps, cube("C"))


def shared_corpus() -> dict[str, Files]:
    """Return the small files among the awkward ones of others; empty where they are absent."""
    folder = SHARED / "scenes" / "awkward"
    paths = [path for path in sorted(folder.rglob("*.usd*")) if path.stat().st_size < _LARGEST]
    return {str(path.relative_to(folder)): {path.name: path.read_bytes()} for path in paths}


def as_crate(files: Files, folder: Path) -> Files | None:
    """Return a stage with its root layer in OpenUSD's binary format, None if it is no text that OpenUSD reads.

    `folder` holds it for a moment.
    """
    (name, data), *others = files.items()
    path = folder / f"{Path(name).stem}.usdc"
    layer = Sdf.Layer.CreateAnonymous(".usda")
    try:
        with captured_diagnostics():
            layer.ImportFromString(_text_of(data))
            layer.Export(str(path))
    except Tf.ErrorException:
        return None
    return {path.name: path.read_bytes(), **dict(others)} if not layer.empty else None


# --- mutators of text ---------------------------------------------------------------------------------

Mutator = Callable[[str, random.Random, list[str]], str]
"""From a text to a mangled one; the list holds the texts of other stages, to take pieces from."""

_LINE = re.compile(r"[^\n]+")
_TOKEN = re.compile(r'"[^"\n]*"|@[^@\n]*@|<[^<>\n]*>|[\w:.+-]+|[^\w\s]')
_NUMBER = re.compile(r'(?<!#usda )(?<![\w"@/:.<])-?\d+(?:\.\d+)?(?![\w".:/@])')
_STRING = re.compile(r'"[^"\n]*"')
_PATH = re.compile(r"(?<=<)[^<>\n]*(?=>)")
_ASSET = re.compile(r"(?<=@)[^@\n ,\]]+(?=@)")
_HEAD = re.compile(r'^[ \t]*(?:def|over|class)\b([^"\n]*)"([^"\n]*)"', re.MULTILINE)
_SCOPE = re.compile(r'(?:def|over|class)\b[^"\n{]*"([^"\n]*)"|[{}]')
_PROPERTY = re.compile(
    r"^[ \t]*((?:custom |uniform )*)([a-z]\w*(?:\[\])?) ([\w:]+)((?:\.timeSamples|\.connect)?)( = .*)?$", re.MULTILINE
)

_NUMBERS = """
nan inf -inf -0 0 -1 1e308 -1e308 3.5e38 1e30 1e-320 1e400 2147483648 4294967296 -9223372036854775809
18446744073709551616 0.1 7 None 1e-9
""".split()
_CHARACTERS = (
    "\0\a\b\r\v\x1b\x7f\x85\xa0\u00e9\u0301\u200b\u2028\u202e\ufeff\uffff\ud800\u6905\U0001f600\"'\\\n\t{}()<>@#"
)
_VALUES = {
    "string": ['"x"', '""', '"""two\nlines"""', "'q'"],
    "token": ['"X"', '"invisible"', '"guide"', '"partition"', '"class"'],
    "token[]": ['["a", ""]', "[]"],
    "string[]": ['["a", "\\t"]'],
    "bool": ["1", "false"],
    "int": ["-1", "2147483647"],
    "int[]": ["[]", "[-1, 2147483647, 0]"],
    "int64[]": ["[-1, 9223372036854775807]", "[8, 8]"],
    "uchar": ["255"],
    "half": ["inf", "65504"],
    "float": ["nan", "1e39", "-0"],
    "float[]": ["[nan]", "[]"],
    "double": ["inf", "1e308", "0"],
    "timecode": ["3"],
    "double2": ["(1, nan)"],
    "double3": ["(nan, 0, 0)", "(1e308, 1e308, 1e308)", "(0, 0, 0)"],
    "float3": ["(0, 1, 1e38)", "(inf, inf, -inf)"],
    "float4": ["(1, 2, 3, 4)"],
    "color3f": ["(nan, 0, 0)", "(2, -1, 0)"],
    "color3f[]": ["[]", "[(nan, 0, 0)]"],
    "point3f[]": ["[(nan, 0, 0), (1, 1, 1)]", "[]", "[(1e38, 0, 0), (-1e38, 0, 0), (1, 2, 3)]"],
    "point3d[]": ["[(1e308, 0, 0), (-1e308, 2, 3)]"],
    "quatf": ["(0, 0, 0, 0)", "(nan, 0, 0, 1)", "(1e38, 1e38, 1e38, 1e38)"],
    "quath[]": ["[(0, 0, 0, 0)]", "[]"],
    "matrix4d": ["( (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0) )"],
    "asset": ["@x.png@", "@@", "@./scene.usda@"],
    "asset[]": ["[@a@, @b@]"],
    "rel": ["</>", "</World>", "[]", "[</World>, </World.a>]", "<..>", "None"],
    "opaque": [""],
    "dictionary": ["{ int a = 1 }"],
    "pathExpression": ['"//*"'],
}
"""Types with odd values of them."""
_TYPES = """
Xform Scope Cube Sphere Cone Capsule Cylinder Plane Mesh Points BasisCurves NurbsPatch TetMesh PointInstancer
GeomSubset Camera Material Shader NodeGraph PhysicsRevoluteJoint PhysicsPrismaticJoint PhysicsFixedJoint PhysicsScene
SphereLight SkelRoot Skeleton Volume OpenVDBAsset HermiteCurves Bogus
""".split()
_METADATA = (
    "active = false", "instanceable = true", "hidden = true", 'kind = "component"', 'kind = "assembly"', 'kind = ""',
    "references = None", "references = </World>", "payload = @./scene.usda@", "inherits = </World>", "clips = {}",
    "specializes = [</World>, </World>]", "references = @./scene.usda@</World> (offset = nan; scale = 0)",
    'apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "SemanticsLabelsAPI:", "SemanticsAPI:a:b", ""]',
    'prepend apiSchemas = ["PhysicsArticulationRootAPI", "Bogus", "CollectionAPI", "MaterialBindingAPI"]',
    'variants = { string shape = "" }', 'prepend variantSets = "shape"', 'displayName = ""', 'displayName = "\\n"',
    'doc = "\\x01"', "assetInfo = { int name = 3\ndouble identifier = nan }", "assetInfo = { string[] name = [] }",
    "customData = { dictionary a = {}\ntoken t = \"\" }", "permission = private", 'customData = { int "a b" = 1 }',
    'metersPerUnit = "1"', "metersPerUnit = 0", "metersPerUnit = 1e-320", "kilogramsPerUnit = nan", "upAxis = 3",
    'defaultPrim = "None"', "startTimeCode = nan", "endTimeCode = -1e308", "subLayers = [@./scene.usda@]",
)  # fmt: skip


def _spans(text: str, rng: random.Random) -> tuple[str, list[tuple[int, int]]]:
    """Return what joins them and the spans of all lines, or of all tokens; never none."""
    joint, pattern = ("\n", _LINE) if rng.random() < 0.5 else (" ", _TOKEN)
    return joint, [match.span() for match in pattern.finditer(text)] or [(0, 0)]


def _delete(text, rng, others):
    start, end = rng.choice(_spans(text, rng)[1])
    return text[:start] + text[end:]


def _duplicate(text, rng, others):
    joint, spans = _spans(text, rng)
    start, end = rng.choice(spans)
    return text[:end] + joint + text[start:end] + text[end:]


def _swap(text, rng, others):
    _, spans = _spans(text, rng)
    (a, b), (c, d) = sorted(rng.choices(spans, k=2))
    return text if b > c else text[:a] + text[c:d] + text[b:c] + text[a:b] + text[d:]


def _replace(pattern: re.Pattern[str], text: str, rng: random.Random, new: Callable[[re.Match[str]], str]) -> str:
    """Replace one match, sometimes several."""
    found = list(pattern.finditer(text))
    for match in sorted(rng.sample(found, min(len(found), rng.choice((1, 1, 1, 4)))), key=re.Match.start, reverse=True):
        text = text[: match.start()] + new(match) + text[match.end() :]
    return text


def _number(text, rng, others):
    return _replace(_NUMBER, text, rng, lambda _: rng.choice(_NUMBERS))


def _string(text, rng, others):
    strings = [*_STRING.findall(text), '""', '"none"', '"' + "long " * 1000 + '"']
    return _replace(_STRING, text, rng, lambda _: rng.choice(strings))


def _quote(text, rng, others):
    marks = ("'{}'", '"""{}"""', "'{}\"", '"""{}\n"""', "{}", '"{}', '"{}\\', "@{}@")
    return _replace(_STRING, text, rng, lambda match: rng.choice(marks).format(match[0][1:-1]))


def _retype(text, rng, others):
    """Give a property another type and a value of it, sometimes as time samples or connected."""

    def new(match: re.Match[str]) -> str:
        type_name = rng.choice(list(_VALUES))
        value = rng.choice(_VALUES[type_name])
        if rng.random() < 0.2 and type_name != "rel":
            return f"{type_name} {match[3]}.timeSamples = {{ 0: {value}, {rng.choice(_NUMBERS)}: {value} }}"
        if rng.random() < 0.1:
            return f"{type_name} {match[3]}.connect = <{rng.choice(paths_of(text))}.{match[3]}>"
        return f"{match[1]}{type_name} {match[3]}" + (f" = {value}" if value else "")

    return _replace(_PROPERTY, text, rng, new)


def _move_property(text, rng, others):
    """Put a line of some stage behind a line of this one."""
    lines = rng.choice([text, *others]).splitlines()
    here = text.splitlines() or [""]
    here.insert(rng.randrange(len(here)) + 1, rng.choice(lines or [""]))
    return "\n".join(here)


def _prim_type(text, rng, others):
    return _replace(_HEAD, text, rng, lambda match: match[0].replace(match[1], f" {rng.choice(_TYPES)} ", 1))


def _rename(text, rng, others):
    names = [match[2] for match in _HEAD.finditer(text)] + ["", "1a", "a b", "\u6905\u5b50", "a-b", "x" * 300]
    return _replace(_HEAD, text, rng, lambda match: match[0].replace(f'"{match[2]}"', f'"{rng.choice(names)}"'))


def _retarget(text, rng, others):
    paths = [*paths_of(text), "/", "..", ".", "/Gone/Away", "/World.a", "/World{a=b}C", "relative/path", "", "//"]
    return _replace(_PATH, text, rng, lambda _: rng.choice(paths))


def _asset(text, rng, others):
    assets = ("./scene.usda", "./base.usda", "scene.usda:SDF_FORMAT_ARGS:a=b", "", "/", "/dev/null", "x" * 5000, ".",
              "./missing.usdz[a.usd]", "http://x.invalid/a.usd", "%zz", "\u6905.usda", "`${A}`", "a.png")  # fmt: skip
    return _replace(_ASSET, text, rng, lambda _: rng.choice(assets))


def _metadata(text, rng, others):
    """Give a prim or the layer metadata, its own if it has none yet."""

    def new(match: re.Match[str]) -> str:
        return f"{match[0]} (\n{rng.choice(_METADATA)}\n)"

    bare = re.compile(r'(?m)^[ \t]*(?:def|over|class)\b[^"\n]*"[^"\n]*"(?=\s*\{)')
    if rng.random() < 0.6 and bare.search(text):
        return _replace(bare, text, rng, new)
    return _replace(re.compile(r"(?m)^.*\($|#usda 1\.0\n\($"), text, rng, lambda m: f"{m[0]}\n{rng.choice(_METADATA)}")


def _truncate(text, rng, others):
    return text[: rng.randrange(len(text) + 1)]


def _characters(text, rng, others):
    """Put odd characters into strings, or anywhere."""
    odd = "".join(rng.choices(_CHARACTERS, k=rng.choice((1, 1, 1, 5))))
    if rng.random() < 0.7:
        return _replace(_STRING, text, rng, lambda match: match[0][:-1] + odd + '"')
    place = rng.randrange(len(text) + 1)
    return text[:place] + odd + text[place:]


def _nest(text, rng, others):
    """Put prims below a few hundred others, or a value into as many brackets."""
    depth = rng.choice((10, 200, 500))
    first = _HEAD.search(text)
    if first and rng.random() < 0.6:
        heads = "".join(f'def {rng.choice(["Xform ", "Scope ", ""])}"n"\n{{\n' for _ in range(depth))
        return text[: first.start()] + heads + text[first.start() :] + "\n}\n" * depth
    opening, closing = rng.choice((("[", "]"), ("(", ")"), ("{ dictionary d = ", "}")))
    value = opening * depth + closing * depth
    return _replace(_PROPERTY, text, rng, lambda match: f"{match[0]} ( customData = {value} )")


def _blocks(text: str) -> list[tuple[int, int]]:
    """Return the spans of whole prims."""
    found: list[tuple[int, int]] = []
    opened: list[int | None] = []
    start: int | None = None
    for match in _SCOPE.finditer(text):
        if match[0] == "{":
            opened.append(start)
            start = None
        elif match[0] == "}":
            began = opened.pop() if opened else None
            if began is not None:
                found.append((began, match.end()))
        else:
            start = match.start()
    return found


def paths_of(text: str) -> list[str]:
    """Return the paths of the prims that a layer of text seems to hold; the root's if there are none."""
    paths, stack = [], []
    name = None
    for match in _SCOPE.finditer(text):
        if match[0] == "{":
            stack.append(name)
            if name is not None:
                paths.append("/" + "/".join(filter(None, stack)))
            name = None
        elif match[0] == "}":
            del stack[-1:]
        else:
            name = match[1]
    return paths or ["/"]


def _copy_prim(text, rng, others):
    """Put a prim of some stage, under its own or another name, into a prim of this one or beside it."""
    source = rng.choice([text, text, *others])
    blocks = _blocks(source)
    if not blocks:
        return text
    start, end = rng.choice(blocks)
    block = source[start:end]
    if rng.random() < 0.7:
        block = _SCOPE.sub(lambda match: match[0].replace(f'"{match[1]}"', f'"copy{rng.randrange(9)}"'), block, count=1)
    places = [match.end() for match in re.finditer(r"(?m)^\s*\}$", text)] or [len(text)]
    place = rng.choice(places)
    return f"{text[:place]}\n{block}\n{text[place:]}"


MUTATORS: dict[Mutator, int] = {
    _delete: 3, _duplicate: 2, _swap: 2, _number: 8, _string: 5, _quote: 1, _retype: 10, _move_property: 4,
    _prim_type: 6, _rename: 4, _retarget: 6, _asset: 4, _metadata: 8, _truncate: 1, _characters: 4, _nest: 1,
    _copy_prim: 6,
}  # fmt: skip
"""Mutators of text, and how often each is taken."""


def mangle_text(text: str, rng: random.Random, others: list[str]) -> str:
    """Return the text after one to five mutators."""
    for mutate in rng.choices(list(MUTATORS), weights=list(MUTATORS.values()), k=rng.choice((1, 1, 1, 2, 2, 3, 5))):
        text = mutate(text, rng, others) if text else text
    return text


# --- mutators of bytes --------------------------------------------------------------------------------


def mangle_bytes(data: bytes, rng: random.Random) -> bytes:
    """Return the bytes with one to four faults: flipped, zeroed, set, spliced, cut out or put in; or cut off."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        at, elsewhere = rng.randrange(len(data) + 1), rng.randrange(len(data) + 1)
        if rng.random() < 0.3:
            # Offsets and lengths are 64 bits each.
            at &= ~7
        size = rng.choice((1, 1, 2, 4, 8, 64))
        there = data[at : at + size]
        flipped = bytes(byte ^ (1 << rng.randrange(8)) for byte in there)
        noise = rng.randbytes(size)
        pieces = (flipped, bytes(size), b"\xff" * size, noise, data[elsewhere : elsewhere + size], b"", there + noise)
        data = data[:at] + rng.choice(pieces) + data[at + size :]
    return data[: rng.randrange(len(data) + 1)] if rng.random() < 0.05 else data


# --- what is sane -------------------------------------------------------------------------------------


def insane(scene: Scene) -> Iterator[str]:
    """Yield what a scene holds that none should."""
    yield from _insane_objects(scene)
    if scene.prim_count != len(scene.objects) + sum(scene.left_out.values()):
        yield "prims neither objects nor left out"
    if not (_is_positive(scene.frame.metres_per_unit) and _is_positive(scene.frame.kilograms_per_unit)):
        yield "frame without positive units"
    if scene.time is not None and not math.isfinite(scene.time):
        yield "time not finite"
    seen: set[str] = set()
    for obj in scene.objects:
        if obj.parent_path is not None and obj.parent_path not in seen:
            yield "parent that does not come before"
        if obj.parent_path is not None and not obj.prim_path.startswith(obj.parent_path + "/"):
            yield "parent that is not above"
        seen.add(obj.prim_path)
    for joint in scene.joints:
        yield from _insane_joint(joint)
    for note in scene.diagnostics:
        if not note.message or not _is_line(note.message):
            yield f"{note.code} diagnostic of no line or several"
    yield from _unwritable(scene)


def _insane_objects(scene: Scene) -> Iterator[str]:
    if len({obj.prim_path for obj in scene.objects}) < len(scene.objects):
        yield "prim path twice"
    for obj in scene.objects:
        yield from _insane_object(obj)


def _insane_object(obj: SceneObject) -> Iterator[str]:
    for name, box in (("box", obj.box), ("own box", obj.own_box), *(("part box", box) for box in obj.part_boxes)):
        if box is not None and not _is_sane_box(box):
            yield f"{name} not finite or inside out"
    if obj.position is not None and not _are_finite(obj.position):
        yield "position not finite"
    if obj.orientation is not None and not abs(math.hypot(*obj.orientation) - 1) < 1e-6:
        yield "orientation no unit quaternion"
    if obj.mass_kg is not None and not _is_positive(obj.mass_kg):
        yield "mass not finite or not positive"
    if obj.display_color is not None and not _are_finite(obj.display_color):
        yield "display colour not finite"
    if obj.oriented_size is not None and not all(math.isfinite(size) and size >= 0 for size in obj.oriented_size):
        yield "oriented size not finite or negative"
    if obj.instances is not None and obj.instances.count < 0:
        yield "fewer than no copies"
    for details in obj.material_details:
        yield from _insane_material(details)


def _insane_material(details: MaterialDetails) -> Iterator[str]:
    numbers = (*(details.base_color or ()), details.roughness, details.metallic, details.opacity)
    if not _are_finite(number for number in numbers if number is not None):
        yield "material not finite"


def _insane_joint(joint: Joint) -> Iterator[str]:
    if joint.axis_vector is not None and not abs(math.hypot(*joint.axis_vector) - 1) < 1e-6:
        yield "joint axis no unit vector"
    if not _are_finite(number for number in (joint.lower, joint.upper, joint.value) if number is not None):
        yield "joint limit or value not finite"


def _unwritable(scene: Scene) -> Iterator[str]:
    try:
        repr((scene.objects, scene.joints, scene.diagnostics)).encode()
        "".join(text for obj in scene.objects for text in _texts_of(obj)).encode()
    except UnicodeEncodeError:
        yield "text that is not Unicode"


def _texts_of(obj: SceneObject) -> Iterator[str]:
    yield from (obj.name, obj.display_name, obj.documentation, *obj.asset, *obj.materials, *obj.parts)
    yield from itertools.chain(*obj.texts, *obj.variants)
    yield from (label.value for labels in obj.labels for label in labels)


def _is_sane_box(box: Box) -> bool:
    return _are_finite((*box.lower, *box.upper)) and all(a <= b for a, b in zip(box.lower, box.upper, strict=True))


def _are_finite(numbers: Iterable[float]) -> bool:
    return all(map(math.isfinite, numbers))


def _is_positive(number: float) -> bool:
    return 0 < number < math.inf


def _is_line(text: str) -> bool:
    return len(text.splitlines()) == 1


# --- reading in a child process -----------------------------------------------------------------------


def read_checked(path: str) -> Verdict:
    """Return what `read_scene` makes of a file."""
    try:
        scene = read_scene(path)
        problem = next(insane(scene), None)
        if not problem and any(obj.instances for obj in scene.objects):
            copies = read_scene(path, options=ReadOptions(expand_instancers=True))
            problem = next((f"{problem} of a copy" for problem in _insane_objects(copies)), None)
        return Verdict(Outcome.INSANE, problem) if problem else Verdict(Outcome.READ)
    except SceneError as error:
        message = str(error)
        if _is_line(message) and message.startswith(f"{path}: "):
            return Verdict(Outcome.REFUSED, detail=message[:500])
        return Verdict(Outcome.INSANE, "message of several lines, or without the file", message[:500])
    except MemoryError:
        return Verdict(Outcome.MEMORY, detail=traceback.format_exc()[-1000:])
    except Exception as error:
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename.startswith(_PACKAGE)]
        place = f"{type(error).__name__} in {_place(frames[-1].filename, frames[-1].lineno, frames[-1].name)}"
        return Verdict(Outcome.EXCEPTION, place, traceback.format_exc()[-1000:])


def read_plainly(path: str) -> Verdict:
    """Return `Outcome.READ` once OpenUSD alone has composed a file, given all its values and measured it."""
    try:
        with captured_diagnostics():
            stage = Usd.Stage.Open(path)
            for item in stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)):
                for attribute in item.GetAuthoredAttributes():
                    attribute.Get(Usd.TimeCode.EarliestTime())
            UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), ["default"]).ComputeWorldBound(stage.GetPseudoRoot())
    except (Tf.ErrorException, UnicodeDecodeError):
        return Verdict(Outcome.REFUSED)
    except MemoryError:
        return Verdict(Outcome.MEMORY)
    return Verdict(Outcome.READ)


def _place(file: str, line: int | None, function: str) -> str:
    return f"{Path(file).parent.name}/{Path(file).name}:{line} {function}"


def serve(examine: str, trace: str) -> None:
    """Answer each path on standard input by a verdict, one line of JSON, until the input ends.

    Args:
        examine: `module:function` that gives the verdict.
        trace: file for where Python stood when the process was killed by a signal or took too long.
    """
    module, _, name = examine.partition(":")
    judge = getattr(importlib.import_module(module), name)
    answers = os.fdopen(os.dup(1), "w")
    print(end=_READY, file=answers, flush=True)
    libc = ctypes.CDLL(None)
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    warnings.simplefilter("error")
    with tempfile.TemporaryFile() as said, Path(trace).open("w") as places:
        os.dup2(said.fileno(), 1)
        os.dup2(said.fileno(), 2)
        faulthandler.enable(places)
        for line in sys.stdin:
            faulthandler.dump_traceback_later(SECONDS - 1, file=places)
            verdict = judge(line.rstrip("\n"))
            faulthandler.cancel_dump_traceback_later()
            sys.stdout.flush()
            sys.stderr.flush()
            libc.fflush(None)
            if os.lseek(1, 0, os.SEEK_END) and verdict.outcome in {Outcome.READ, Outcome.REFUSED}:
                os.lseek(1, 0, os.SEEK_SET)
                text = os.read(1, 500).decode(errors="replace")
                # Numbers differ from case to case.
                verdict = Verdict(Outcome.TALKED, re.split(r"[\d(\n]", text, maxsplit=1)[0][:60], text)
            os.ftruncate(1, 0)
            os.lseek(1, 0, os.SEEK_SET)
            print(json.dumps(verdict), file=answers, flush=True)


class Worker:
    """A child process that examines one file after the other; a new one takes the place of one that died."""

    def __init__(self, examine: str, folder: Path) -> None:
        self.starts = 0
        self._examine = examine
        self._trace = folder / f"trace_{examine.partition(':')[2]}"
        self._process: subprocess.Popen[str] | None = None

    def ask(self, path: Path, seconds: float = SECONDS) -> Verdict:
        """Return the verdict on a file; `DIED` or `HUNG` where the worker gave none."""
        process = self._process or self._start()
        print(path, file=process.stdin, flush=True)
        ready, _, _ = select.select([process.stdout], [], [], seconds)
        answer = process.stdout.readline() if ready else ""
        if answer:
            outcome, place, detail = json.loads(answer)
            return Verdict(Outcome(outcome), place, detail)
        self.close()
        place = self._last_place()
        if not ready:
            return Verdict(Outcome.HUNG, place)
        code = process.returncode
        return Verdict(Outcome.DIED, f"{signal.Signals(-code).name if code < 0 else f'exit {code}'} in {place}")

    def _start(self) -> subprocess.Popen[str]:
        self.starts += 1
        run = "import sys; from tests.scene.fuzzing import serve; serve(*sys.argv[1:])"
        self._process = subprocess.Popen(
            [sys.executable, "-c", run, self._examine, str(self._trace)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=_REPOSITORY,
        )  # fmt: skip
        if self._process.stdout.readline() != _READY:
            raise RuntimeError(f"the worker for {self._examine} does not start")
        return self._process

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            with self._process as process:
                process.kill()
            self._process = None

    def _last_place(self) -> str:
        text = self._trace.read_text(errors="replace")
        # Innermost first.
        found = re.search(rf'File "({re.escape(_PACKAGE)}[^"]*)", line (\d+) in (\S+)', text)
        return _place(found[1], int(found[2]), found[3]) if found else "OpenUSD"


_OPENUSDS_SHARE = {
    Outcome.HUNG: Outcome.OPENUSD_BUSY,
    Outcome.MEMORY: Outcome.OPENUSD_BUSY,
    Outcome.TALKED: Outcome.OPENUSD_TALKED,
}


class Judge:
    """Writes the files of cases into a folder and finds out what becomes of them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._cases = itertools.count()
        self.reader = Worker("tests.scene.fuzzing:read_checked", folder)
        self._plain = Worker("tests.scene.fuzzing:read_plainly", folder)

    def judge(self, files: Files) -> Verdict:
        """Return what becomes of a stage; what OpenUSD alone does not survive either is put down to OpenUSD."""
        # A new path each time: OpenUSD keeps layers by their paths.
        folder = self._folder / str(next(self._cases))
        write_files(files, folder)
        path = folder / next(iter(files))
        verdict = self.reader.ask(path)
        if verdict.outcome == Outcome.DIED and verdict.place.startswith("SIG"):
            # Python code alone cannot end so.
            verdict = verdict._replace(outcome=Outcome.OPENUSD_DIED)
        openusds = _OPENUSDS_SHARE.get(verdict.outcome)
        if openusds and self._plain.ask(path).outcome not in {Outcome.READ, Outcome.REFUSED}:
            verdict = verdict._replace(outcome=openusds)
        shutil.rmtree(folder)
        return verdict

    def close(self) -> None:
        """End the child processes."""
        self.reader.close()
        self._plain.close()


def write_files(files: Files, folder: Path) -> None:
    """Write the files of a stage into a new folder."""
    folder.mkdir(parents=True)
    for name, data in files.items():
        (folder / name).write_bytes(data)


# --- the loop -----------------------------------------------------------------------------------------


class Case(NamedTuple):
    """One mangled stage."""

    name: str
    """Seed, number and what it was made of; the same name means the same files."""
    files: Files


@dataclass
class Tally:
    """What happened to all cases."""

    outcomes: Counter[str] = field(default_factory=Counter)
    found: dict[Verdict, list[Case]] = field(default_factory=dict)
    """Each fault of OpenUSD or ours, told apart by place, with its first cases."""

    def add(self, case: Case, verdict: Verdict) -> None:
        """Count a case."""
        self.outcomes[verdict.outcome] += 1
        if verdict.outcome in {Outcome.READ, Outcome.REFUSED}:
            return
        same = next((known for known in self.found if known[:2] == verdict[:2]), verdict)
        cases = self.found.setdefault(same, [])
        if len(cases) < _KEPT:
            cases.append(case)

    @property
    def failures(self) -> list[str]:
        """What the reader itself did wrong, with the first case of each fault."""
        return [
            f"{verdict.outcome}: {verdict.place} ({cases[0].name}) {verdict.detail}"
            for verdict, cases in self.found.items()
            if verdict.outcome not in OPENUSDS
        ]

    def __str__(self) -> str:
        lines = [f"{count:7} {outcome}" for outcome, count in self.outcomes.most_common()]
        lines += [f"{verdict.outcome}: {verdict.place} ({cases[0].name})" for verdict, cases in self.found.items()]
        return "\n".join(lines)

    def keep(self, folder: Path) -> None:
        """Write the files of all faults, each with a note of what it does."""
        for verdict, cases in self.found.items():
            for case in cases:
                below = folder / re.sub(r"\W+", "_", f"{verdict.outcome} {verdict.place} {case.name}")
                shutil.rmtree(below, ignore_errors=True)
                write_files(case.files, below)
                (below / "what.txt").write_text("\n".join(verdict), encoding="utf-8", errors="replace")


def make_cases(corpus: dict[str, Files], seed: int) -> Iterator[Case]:
    """Yield mangled stages without end: of the text ones every fourth as crate, crates as they are."""
    with tempfile.TemporaryDirectory() as folder:
        crates = [(name, crate) for name, files in corpus.items() if (crate := as_crate(files, Path(folder)))]
    texts = [text for files in corpus.values() if (text := _text_of(next(iter(files.values()))))]
    for number in itertools.count():
        # A string: the same numbers in each run, and apart for neighbouring seeds.
        rng = random.Random(f"{seed} {number}")
        name, files = rng.choice(crates if crates and number % 4 == 3 else list(corpus.items()))
        # Mostly the root; the whole is written anew, so that the root stays first.
        chosen = next(iter(files)) if rng.random() < 0.85 else rng.choice(list(files))
        yield Case(f"{seed} {number} {name}", {**files, chosen: _mangle(files[chosen], rng, texts)})


def all_cases(seed: int) -> Iterator[Case]:
    """Yield mangled stages of our own, and in turn with them those of others where they are there."""
    streams = [make_cases(corpus, seed) for corpus in (own_corpus(), shared_corpus()) if corpus]
    return itertools.chain.from_iterable(zip(*streams, strict=True))


def _mangle(data: bytes, rng: random.Random, texts: list[str]) -> bytes:
    text = _text_of(data)
    # Half a surrogate makes a file that is not UTF-8.
    return mangle_text(text, rng, texts).encode(errors="surrogatepass") if text else mangle_bytes(data, rng)


def _text_of(data: bytes) -> str:
    """Return a layer of text; empty if it is none."""
    try:
        return data.decode() if data.startswith(b"#usda") else ""
    except UnicodeDecodeError:
        return ""


def fuzz(cases: Iterable[Case], seconds: float = math.inf) -> Tally:
    """Return what becomes of the cases, up to the first that comes after `seconds`."""
    tally = Tally()
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(Path(folder))
        try:
            for case in itertools.takewhile(lambda _: time.monotonic() < end, cases):
                tally.add(case, judge.judge(case.files))
        finally:
            judge.close()
    return tally


def main() -> int:
    """Fuzz for a while; return 1 if the reader did something wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.scene.fuzzing", description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600, help="how long (default: 600)")
    parser.add_argument("--seed", type=int, default=1, help="same seed, same files (default: 1)")
    parser.add_argument("--keep", type=Path, help="folder for the files of all faults")
    arguments = parser.parse_args()
    tally = fuzz(all_cases(arguments.seed), arguments.seconds)
    print(tally)
    if arguments.keep:
        tally.keep(arguments.keep)
    return 1 if tally.failures else 0


if __name__ == "__main__":
    sys.exit(main())
