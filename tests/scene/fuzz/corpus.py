"""Corpus: small stages that use every feature the reader reads, and small third-party files."""

from pathlib import Path

from pxr import Sdf, Tf

from tests.conftest import SHARED
from tests.scene.usda import METRES, component, cube, header, move, ops, prim, rigid, xform
from usd2kg.scene.stage import captured_diagnostics

_LARGEST = 100_000
"""Bytes of the largest third-party file in the corpus."""

Files = dict[str, bytes]
"""Name → content of the files of one stage, the root layer first."""

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
    """Return small stages by name, as text; they reference the layer `base.usda` beside the root layer."""
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
    """Return the small ones of the shared awkward files; empty if the folder is missing."""
    folder = SHARED / "scenes" / "awkward"
    paths = [path for path in sorted(folder.rglob("*.usd*")) if path.stat().st_size < _LARGEST]
    return {str(path.relative_to(folder)): {path.name: path.read_bytes()} for path in paths}


def as_crate(files: Files, folder: Path) -> Files | None:
    """Return a stage with its root layer as crate, OpenUSD's binary format; None if OpenUSD cannot read the text.

    Args:
        files: the stage as text.
        folder: where the crate is written temporarily.
    """
    (name, data), *others = files.items()
    path = folder / f"{Path(name).stem}.usdc"
    layer = Sdf.Layer.CreateAnonymous(".usda")
    try:
        with captured_diagnostics():
            layer.ImportFromString(text_of(data))
            layer.Export(str(path))
    except Tf.ErrorException:
        return None
    return {path.name: path.read_bytes(), **dict(others)} if not layer.empty else None


def text_of(data: bytes) -> str:
    """Return the text of a layer; empty if it is not a text layer."""
    try:
        return data.decode() if data.startswith(b"#usda") else ""
    except UnicodeDecodeError:
        return ""
