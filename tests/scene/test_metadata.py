"""Variants, free text and materials."""

import base64
import hashlib
import uuid

import pytest
from pxr import Usd

from tests.conftest import shared_file
from tests.scene.usda import METRES, cube, prim, xform
from usd2kg.scene import evidence
from usd2kg.scene.metadata import MaterialReader, clean_text, text_attributes, variant_selections
from usd2kg.scene.model import MaterialDetails
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import open_stage
from usd2kg.scene.traversal import outline_stage

EARLIEST = Usd.TimeCode.EarliestTime()


@pytest.fixture
def stage(write_stage):
    """A function that writes prims as a stage and opens it; the stage lives as long as the test."""
    opened = []

    def run(*prims, layer=METRES):
        opened.append(Usd.Stage.Open(str(write_stage(layer + "\n".join(prims), f"scene{len(opened)}.usda"))))
        return opened[-1]

    return run


# --- variants -----------------------------------------------------------------------------------------


def variants(**selected):
    """Return metadata with a selection in each variant set, and the body with two variants each."""
    chosen = "\n".join(f'string {name} = "{value}"' for name, value in selected.items())
    sets = ", ".join(f'"{name}"' for name in selected)
    body = "\n".join(f'variantSet "{name}" = {{\n"oak" {{\n}}\n"steel" {{\n}}\n}}' for name in selected)
    return [f"variants = {{\n{chosen}\n}}", f"prepend variantSets = [{sets}]"], body


def test_selected_variants_by_name_of_the_set(stage):
    meta, body = variants(top="oak", legs="steel")
    found = stage(xform("Table", body, meta=meta)).GetPrimAtPath("/Table")
    assert variant_selections(found) == (("legs", "steel"), ("top", "oak"))


def test_no_variants_and_no_selection(stage):
    unselected = xform("Table", 'variantSet "top" = {\n"oak" {\n}\n}', meta=['prepend variantSets = "top"'])
    found = stage(unselected, xform("Chair"))
    assert variant_selections(found.GetPrimAtPath("/Table")) == ()
    assert variant_selections(found.GetPrimAtPath("/Chair")) == ()


def test_variants_of_an_instance(stage):
    meta, body = variants(top="oak")
    proto = xform("Proto", body, meta=meta)
    copy = xform("Copy", meta=["instanceable = true", "references = </Proto>", 'variants = {\nstring top = "steel"\n}'])
    assert variant_selections(stage(proto, copy).GetPrimAtPath("/Copy")) == (("top", "steel"),)


# --- texts --------------------------------------------------------------------------------------------


@pytest.fixture
def texts(stage):
    """A function that returns the texts of a cube with the given lines and metadata."""

    def run(*body, meta=()):
        return text_attributes(stage(cube("Thing", *body, meta=meta)).GetPrimAtPath("/Thing"))

    return run


def test_texts_that_somebody_wrote(texts):
    found = texts(
        'custom string userProperties:description = "A wing chair of green velvet"',
        'custom token maker = "Thonet"',
        'custom string[] tags = ["seating", "living room"]',
        meta=[
            'customData = {\nstring note = "by the window"\ndictionary shop = {\nstring shelf = "lower left"\n}\n}',
            'assetInfo = {\nstring name = "chair"\nstring category = "furniture"\nstring version = "two"\n}',
        ],
    )
    assert found == (
        ("maker", "Thonet"),
        ("tags", "seating, living room"),
        ("userProperties:description", "A wing chair of green velvet"),
        ("customData:note", "by the window"),
        ("customData:shop:shelf", "lower left"),
        ("assetInfo:category", "furniture"),
    )


def test_a_plain_prim_has_no_texts(texts):
    # The documentation of the schema in customData and tokens of schema attributes are not free text.
    assert texts('uniform token purpose = "render"', 'token visibility = "inherited"') == ()


def test_attributes_of_schemas_that_openusd_does_not_know(texts):
    assert texts('string shop:article = "bar stool"') == (("shop:article", "bar stool"),)


@pytest.mark.parametrize(
    "name",
    """
    omni:kit:description primvars:st:name inputs:file info:mdl:name physics:engine physxScene:solver xformOp:about
    semantic:a:params:semanticData semantics:labels:class rdf:conceptName ui:nodegraph:note
    """.split(),
)
def test_what_steers_a_tool_is_left_out(texts, name):
    assert texts(f'custom string {name} = "wooden chair"') == ()


@pytest.mark.parametrize("name", ["omnibus", "physical:feel", "information", "ui_label", "physx", "semanticNotes"])
def test_names_that_only_begin_like_a_tools(texts, name):
    assert texts(f'custom string {name} = "wooden chair"') == ((name, "wooden chair"),)


WORDS = [
    "cup",
    "TV",
    "Küchentisch",
    "椅子",
    "a chair, 45 cm high",
    "salt/pepper shaker",
    "Dr. Oetker's mixer",
    "BOSCH dishwasher SMS46GI01E",
    "SM_KitchenCabinet01_DoorLeft",
    "drawer.n.wn.artifact",
    "see www and go",
    "facade",
    "100% cotton towel",
    "made 2024-01-01 in Ulm",
]
NO_WORDS = [
    "",
    " ",
    "x",
    "12",
    "-3.5e7",
    "1.2.3",
    "2024-01-01",
    "10:30:00",
    "true",
    "None",
    "geo_01",
    "/World/Kitchen/Cup",
    "/World/My Cup",
    "../textures/wood.png",
    "./cup.usd",
    "props/kitchen/cup",
    "wood_basecolor.png",
    "C:\\\\assets\\\\cup.fbx",
    "C:/assets/my cup.fbx",
    "\\\\\\\\server\\\\share",
    "@cup.usd@",
    "https://example.org/cup",
    "omniverse://localhost/Projects/cup",
    "file:/home/me/cup",
    "www.example.org",
    "mailto:me@example.org",
    "urn:uuid:cup",
    str(uuid.UUID(int=0xC0FFEE << 90)),
    uuid.UUID(int=0xC0FFEE << 90).hex,
    "{" + str(uuid.UUID(int=7 << 100)) + "}",
    hashlib.sha256(b"cup").hexdigest(),
    "sha256:" + hashlib.sha256(b"cup").hexdigest(),
    "0xDEADBEEF01",
    base64.b64encode(hashlib.sha256(b"cup").digest()).decode(),
    base64.b64encode(hashlib.sha256(b"table").digest()[:30]).decode(),
    '{\\"kind\\": \\"chair\\"}',
    "[1, 2]",
    "<svg>chair</svg>",
    "chair " * 40,
]


@pytest.mark.parametrize("text", WORDS)
def test_texts_with_words(texts, text):
    assert texts(f'custom string note = "{text}"') == (("note", text),)


@pytest.mark.parametrize("text", NO_WORDS)
def test_texts_without_words(texts, text):
    assert texts(f'custom string note = "{text}"') == ()


@pytest.mark.parametrize(("length", "is_kept"), [(200, True), (201, False)])
def test_length(texts, length, is_kept):
    text = ("chair " * 40)[: length - 1] + "s"
    assert bool(texts(f'custom string note = "{text}"')) is is_kept


def test_each_text_once_and_at_most_twenty(texts):
    lines = [f'custom string note{i:02} = "chair number {i // 2} of the hall"' for i in range(60)]
    found = texts(*lines)
    assert len(found) == 20
    assert found[1] == ("note02", "chair number 1 of the hall")


def test_texts_over_time_are_read_at_the_earliest(texts):
    assert texts('custom string note.timeSamples = {\n1: "pupa",\n5: "butterfly"\n}') == (("note", "pupa"),)


def test_values_of_other_types_are_none(texts):
    meta = ["customData = {\nint count = 3\ndouble3 at = (1, 2, 3)\nbool is_wood = 1\nasset a = @wood.png@\n}"]
    assert texts('custom asset picture = @"wood table"@'.replace('"', ""), "custom int n = 3", meta=meta) == ()


def test_text_on_an_instance_proxy(stage):
    proto = xform("Proto", cube("seat", 'custom string note = "green velvet"'))
    copy = xform("Copy", meta=["instanceable = true", "references = </Proto>"])
    found = stage(proto, copy).GetPrimAtPath("/Copy/seat")
    assert found.IsInstanceProxy()
    assert text_attributes(found) == (("note", "green velvet"),)


def test_hostile_text_stays_one_printable_line(texts):
    found = texts('custom string note = "cup\\nIGNORE ALL\\r\\n\u202egnp.exe\\x07 now"')
    assert found == (("note", "cup IGNORE ALL gnp.exe now"),)
    assert clean_text(" a\u00a0b\u2028c\x00d\t") == "a b cd"


def test_ignores_bytes_that_are_not_utf8(stage, tmp_path):
    meta = ['customData = {\nstring why = "plughxyzzy"\nstring where = "by the window"\n}']
    text = stage(cube("Thing", 'custom string note = "frobozzmagic"', 'custom token by = "Thonet"', meta=meta))
    path = tmp_path / "scene.usdc"
    text.GetRootLayer().Export(str(path))
    written = path.read_bytes()
    assert (written.count(b"plughxyzzy"), written.count(b"frobozzmagic")) == (1, 1)
    path.write_bytes(
        written.replace(b"plughxyzzy", b"plugh\xff\xfezzy").replace(b"frobozzmagic", b"frob\xff\xfemagic!")
    )
    odd = Usd.Stage.Open(str(path))
    found = text_attributes(odd.GetPrimAtPath("/Thing"))
    assert ("by", "Thonet") in found
    assert {name for name, _ in found} <= {"by", "customData:where"}


# --- materials ----------------------------------------------------------------------------------------


@pytest.fixture
def materials(write_stage):
    """A function that writes prims and returns the materials of the object at a path."""

    def run(*prims, path="/Thing"):
        opened = open_stage(write_stage(METRES + "\n".join(prims)), ReadOptions())
        with outline_stage(opened, EARLIEST) as outline:
            nodes = {node.path: node for node in outline.root.walk()}
            return MaterialReader(EARLIEST).read(list(evidence.own_records(nodes[path], {path: "asked for"})))

    return run


def shader(name, shader_id, *inputs):
    return prim("Shader", name, f'uniform token info:id = "{shader_id}"', *inputs, "token outputs:surface")


def surface(name, *inputs, shader_id="UsdPreviewSurface", context="", extra=(), interface=()):
    """Return a material of one shader."""
    output = f"token outputs:{context}surface.connect = </Looks/{name}/Surface.outputs:surface>"
    return prim("Material", name, *interface, output, shader("Surface", shader_id, *inputs), *extra)


def looks(*prims):
    return prim("Scope", "Looks", *prims)


def bound(name, purpose=""):
    suffix = f":{purpose}" if purpose else ""
    return f"rel material:binding{suffix} = </Looks/{name}>"


BINDING = 'prepend apiSchemas = ["MaterialBindingAPI"]'


def thing(*body, meta=(BINDING,)):
    return cube("Thing", *body, meta=meta)


def one(found) -> MaterialDetails:
    (details,) = found
    return details


OAK = surface("Oak", "color3f inputs:diffuseColor = (0.5, 0.25, 0.1)", "float inputs:roughness = 0.75")


def test_constants_of_a_preview_surface(materials):
    glass = surface(
        "Glass",
        "color3f inputs:diffuseColor = (0.1, 0.2, 0.3)",
        "float inputs:roughness = 0.05",
        "float inputs:metallic = 0",
        "float inputs:opacity = 0.2",
    )
    found = one(materials(looks(glass), thing(bound("Glass"))))
    assert found == MaterialDetails("Glass", "/Looks/Glass", (0.1, 0.2, 0.3), 0.05, 0.0, 0.2)


def test_unauthored_parameters_are_none(materials):
    # UsdPreviewSurface falls back to grey 0.18 and roughness 0.5; the stage says neither.
    found = one(materials(looks(surface("Plain")), thing(bound("Plain"))))
    assert found == MaterialDetails("Plain", "/Looks/Plain")


def test_a_texture_gives_no_constant(materials):
    texture = prim(
        "Shader", "Tex", 'uniform token info:id = "UsdUVTexture"', "float3 outputs:rgb", "asset inputs:file = @a.png@"
    )
    # A value beside the connection does not count.
    color = "color3f inputs:diffuseColor = (1, 0, 0)\n"
    color += "color3f inputs:diffuseColor.connect = </Looks/Oak/Tex.outputs:rgb>"
    oak = surface("Oak", color, "float inputs:roughness = 0.6", extra=[texture])
    found = one(materials(looks(oak), thing(bound("Oak"))))
    assert (found.base_color, found.roughness) == (None, 0.6)


def test_constant_by_the_materials_interface(materials):
    oak = surface(
        "Oak",
        "color3f inputs:diffuseColor.connect = </Looks/Oak.inputs:tint>",
        interface=["color3f inputs:tint = (0.5, 0.25, 0.1)"],
    )
    assert one(materials(looks(oak), thing(bound("Oak")))).base_color == (0.5, 0.25, 0.1)


def test_interface_without_value(materials):
    oak = surface(
        "Oak", "color3f inputs:diffuseColor.connect = </Looks/Oak.inputs:tint>", interface=["color3f inputs:tint"]
    )
    assert one(materials(looks(oak), thing(bound("Oak")))).base_color is None


def test_materialx_standard_surface(materials):
    brass = surface(
        "Brass",
        "color3f inputs:base_color = (0.9, 0.6, 0.2)",
        "float inputs:metalness = 1",
        "float inputs:specular_roughness = 0.3",
        "color3f inputs:opacity = (0.5, 0.5, 0.5)",
        shader_id="ND_standard_surface_surfaceshader",
        context="mtlx:",
    )
    found = one(materials(looks(brass), thing(bound("Brass"))))
    assert found == MaterialDetails("Brass", "/Looks/Brass", (0.9, 0.6, 0.2), 0.3, 1.0, 0.5)


def test_materialx_constant_node(materials):
    constant = prim(
        "Shader",
        "Const",
        'uniform token info:id = "ND_constant_color3"',
        "color3f inputs:value = (0.9, 0.6, 0.2)",
        "color3f outputs:out",
    )
    brass = surface(
        "Brass",
        "color3f inputs:base_color.connect = </Looks/Brass/Const.outputs:out>",
        "color3f inputs:opacity = (1, 0.5, 0)",
        shader_id="ND_standard_surface_surfaceshader",
        context="mtlx:",
        extra=[constant],
    )
    found = one(materials(looks(brass), thing(bound("Brass"))))
    # Opacity that differs by colour is no one number.
    assert (found.base_color, found.opacity) == ((0.9, 0.6, 0.2), None)


def test_mdl_constants(materials):
    def paint(*more):
        source = ['uniform token info:implementationSource = "sourceAsset"']
        source += ["uniform asset info:mdl:sourceAsset = @OmniPBR.mdl@"]
        source += ['uniform token info:mdl:sourceAsset:subIdentifier = "OmniPBR"']
        constants = ["color3f inputs:diffuse_color_constant = (0.8, 0, 0)"]
        constants += ["float inputs:reflection_roughness_constant = 0.4", "float inputs:metallic_constant = 0.1"]
        body = prim("Shader", "Surface", *source, *constants, *more, "token outputs:out")
        output = "token outputs:mdl:surface.connect = </Looks/Paint/Surface.outputs:out>"
        return one(materials(looks(prim("Material", "Paint", output, body)), thing(bound("Paint"))))

    assert paint() == MaterialDetails("Paint", "/Looks/Paint", (0.8, 0.0, 0.0), 0.4, 0.1, None)
    assert paint("asset inputs:diffuse_texture = @red.png@").base_color is None
    assert paint("asset inputs:diffuse_texture = @@").base_color == (0.8, 0.0, 0.0)


@pytest.mark.parametrize("value", ["(nan, 0, 0)", "(inf, 0, 0)"])
def test_colour_that_is_not_finite(materials, value):
    odd = surface("Odd", f"color3f inputs:diffuseColor = {value}", "float inputs:roughness = nan")
    assert one(materials(looks(odd), thing(bound("Odd")))) == MaterialDetails("Odd", "/Looks/Odd")


@pytest.mark.parametrize(
    "line",
    ['string inputs:diffuseColor = "red"', 'token[] inputs:diffuseColor = ["a", "b", "c"]', "float2 inputs:x = (1, 2)"],
)
def test_ignores_inputs_of_other_types(materials, line):
    odd = surface("Odd", line, 'token inputs:roughness = "rough"')
    assert one(materials(looks(odd), thing(bound("Odd")))) == MaterialDetails("Odd", "/Looks/Odd")


def test_node_that_is_connected_to_itself(materials):
    loop = prim(
        "Shader",
        "Const",
        'uniform token info:id = "ND_constant_color3"',
        "color3f inputs:value.connect = </Looks/Odd/Const.outputs:out>",
        "color3f outputs:out",
    )
    odd = surface("Odd", "color3f inputs:diffuseColor.connect = </Looks/Odd/Const.outputs:out>", extra=[loop])
    assert one(materials(looks(odd), thing(bound("Odd")))).base_color is None


def test_material_without_a_surface(materials):
    found = one(materials(looks(prim("Material", "Empty")), thing(bound("Empty"))))
    assert found == MaterialDetails("Empty", "/Looks/Empty")


def test_binding_from_above_and_its_strength(materials):
    steel = surface("Steel")
    inside = xform("Thing", cube("a"), cube("b", bound("Steel"), meta=[BINDING]))
    weak = xform("Room", bound("Oak"), inside, meta=[BINDING])
    assert [m.name for m in materials(looks(OAK, steel), weak, path="/Room/Thing")] == ["Oak", "Steel"]
    stronger = f'{bound("Oak")} (\nbindMaterialAs = "strongerThanDescendants"\n)'
    strong = xform("Room", stronger, inside, meta=[BINDING])
    assert [m.name for m in materials(looks(OAK, steel), strong, path="/Room/Thing")] == ["Oak"]


@pytest.mark.parametrize("purpose", ["full", "preview"])
def test_binding_for_a_purpose(materials, purpose):
    assert one(materials(looks(OAK), thing(bound("Oak", purpose)))).name == "Oak"


def test_full_comes_before_preview(materials):
    both = thing(bound("Simple", "preview"), bound("Oak", "full"))
    assert [m.name for m in materials(looks(OAK, surface("Simple")), both)] == ["Oak", "Simple"]


def test_collection_binding(materials):
    chosen = [
        "rel collection:wood:includes = </Thing/a>",
        'uniform token collection:wood:expansionRule = "expandPrims"',
        "rel material:binding:collection:wood = [</Thing.collection:wood>, </Looks/Oak>]",
    ]
    apis = ['prepend apiSchemas = ["MaterialBindingAPI", "CollectionAPI:wood"]']
    tree = xform("Thing", *chosen, cube("a"), cube("b"), meta=apis)
    assert [m.name for m in materials(looks(OAK), tree)] == ["Oak"]
    assert [m.name for m in materials(looks(OAK), tree, path="/Thing/b")] == []


MESH = (
    "point3f[] points = [(0,0,0), (1,0,0), (0,1,1), (1,1,1)]\n"
    "int[] faceVertexCounts = [3, 3]\nint[] faceVertexIndices = [0, 1, 2, 1, 2, 3]"
)


def subset(name, material, face):
    lines = ['uniform token elementType = "face"', 'uniform token familyName = "materialBind"']
    return prim("GeomSubset", name, *lines, f"int[] indices = [{face}]", bound(material), meta=[BINDING])


@pytest.mark.parametrize(
    ("family", "expected"), [("partition", ["Oak", "Steel"]), ("nonOverlapping", ["Base", "Oak", "Steel"])]
)
def test_geometry_subsets(materials, family, expected):
    kind = f'uniform token subsetFamily:materialBind:familyType = "{family}"'
    subsets = (subset("top", "Oak", 0), subset("legs", "Steel", 1))
    mesh = prim("Mesh", "Thing", MESH, kind, bound("Base"), *subsets, meta=[BINDING])
    found = materials(looks(OAK, surface("Steel"), surface("Base")), mesh)
    assert [m.name for m in found] == expected


def test_materials_of_hidden_geometry_are_not_seen(materials):
    collider = cube("c", bound("Steel"), purpose="guide", meta=[BINDING])
    tree = xform("Thing", cube("a", bound("Oak"), meta=[BINDING]), collider)
    assert [m.name for m in materials(looks(OAK, surface("Steel")), tree)] == ["Oak"]


def test_materials_are_listed_once(materials):
    tree = xform("Thing", *(cube(f"c{i}", bound("Oak"), meta=[BINDING]) for i in range(5)))
    assert one(materials(looks(OAK), tree)).base_color == (0.5, 0.25, 0.1)


def test_material_that_does_not_exist_gives_its_name(materials):
    assert one(materials(thing(bound("DarkWalnut")))) == MaterialDetails("DarkWalnut", "/Looks/DarkWalnut")


def test_no_material(materials):
    assert materials(thing()) == ()
    assert materials(xform("Thing", bound("Oak"), meta=[BINDING])) == ()


def test_materials_inside_instances(materials):
    oak = OAK.replace("/Looks/", "/Proto/Looks/")
    seat = cube("seat", "rel material:binding = </Proto/Looks/Oak>", meta=[BINDING])
    proto = prim("Xform", "Proto", looks(oak), seat, specifier="class")
    copies = [xform(name, meta=["instanceable = true", "references = </Proto>"]) for name in ("Thing", "Other")]
    assert one(materials(proto, *copies)).prim_path == "/Thing/Looks/Oak"
    found = one(materials(proto, *copies, path="/Other"))
    assert (found.prim_path, found.base_color) == ("/Other/Looks/Oak", (0.5, 0.25, 0.1))


def test_materials_of_the_apartment():
    opened = open_stage(shared_file("scenes/iai_apartment/apartment.usdc"), ReadOptions())
    nodes = {node.path: node for node in outline_stage(opened, EARLIEST).root.walk()}
    walls = nodes["/apartment/Geometry/apartment_root/furnitures_root/walls"]
    first = MaterialReader(EARLIEST).read(list(walls.walk()))[0]
    assert first == MaterialDetails(
        "M_Basic_Wall", "/apartment/Materials/M_Basic_Wall", (0.62151, 0.617319, 0.592806), 0.5, 0.0, 1.0
    )
