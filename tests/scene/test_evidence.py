"""Mass, asset, materials, parts and names of objects."""

import pytest

from tests.scene.usda import METRES, component, cube, header, ops, prim, rigid, xform
from usd2kg.scene import read_scene

MASS = 'prepend apiSchemas = ["PhysicsMassAPI"]'


def heavy(name, mass, *body, kind="Cube"):
    return prim(kind, name, f"float physics:mass = {mass}", *body, meta=[MASS])


def thing(read, *body, layer=METRES, meta=(), **options):
    """Return the object of a component with `body`."""
    tree = xform("World", component("Thing", *body, meta=meta), cube("other"))
    return read(tree, layer=layer, **options).by_path["/World/Thing"]


# --- mass --------------------------------------------------------------------------------------------


def test_mass_of_the_prim_itself(read):
    obj = thing(read, "float physics:mass = 2.5", cube("a"), meta=[MASS])
    assert obj.mass_kg == 2.5


def test_mass_authored_as_float_is_the_number_typed(read):
    assert thing(read, "float physics:mass = 0.1", cube("a"), meta=[MASS]).mass_kg == 0.1


def test_mass_is_the_sum_over_the_parts(read):
    assert thing(read, heavy("a", 0.5), heavy("b", 0.25), cube("c")).mass_kg == 0.75


def test_mass_of_the_prim_overrides_its_parts(read):
    assert thing(read, "float physics:mass = 3", heavy("a", 0.5), meta=[MASS]).mass_kg == 3


def test_mass_excludes_nested_objects(read):
    drawer = rigid("Drawer", heavy("front", 2))
    scene = read(xform("World", rigid("Cabinet", heavy("carcass", 10), drawer), cube("other")))
    assert [obj.mass_kg for obj in scene.objects] == [10, 2, None]


@pytest.mark.parametrize("mass", [0, -1, "inf"])
def test_missing_mass_is_none(read, mass):
    # UsdPhysics: 0 means "derive it"; the parts are asked then.
    assert thing(read, f"float physics:mass = {mass}", cube("a"), meta=[MASS]).mass_kg is None
    assert thing(read, f"float physics:mass = {mass}", heavy("a", 0.5), meta=[MASS]).mass_kg == 0.5


def mass_notes(read, *things):
    notes = read(xform("World", *things, cube("other"))).diagnostics
    return [(note.prim_path, note.message) for note in notes if note.code == "mass"]


@pytest.mark.parametrize("mass", ["-3", "nan", "inf"])
def test_a_mass_that_is_no_mass_is_reported(read, mass):
    message = f"its mass is {mass}, expected a positive number; it is left out; correct physics:mass"
    assert mass_notes(read, heavy("a", mass), heavy("b", 0), heavy("c", 2)) == [("/World/a", message)]


def test_a_density_without_a_mass_is_reported_once(read):
    dense = "float physics:density = 7850"
    floor = heavy("floor", 0, dense)
    body = rigid("body", heavy("shell", 0, dense), heavy("lid", 0, dense))
    other = rigid("pipe", heavy("shell", 0, dense))
    weighed = rigid("weighed", heavy("shell", 2, dense))
    message = (
        "2 objects have a density (physics:density) and no mass; densities are not evaluated, so there is no mass in "
        "the graph; author physics:mass"
    )
    assert mass_notes(read, floor, rigid("hollow", cube("a")), body, other, weighed) == [("/World/body/shell", message)]
    assert mass_notes(read, body)[0][1].startswith("1 object has a density (physics:density) and no mass; densities")
    assert mass_notes(read, floor) == []


def test_ignores_a_mass_without_its_schema(read):
    assert thing(read, "float physics:mass = 2", cube("a")).mass_kg is None


def test_masses_are_kilograms(read):
    # The stage weighs in grams.
    layer = header(metersPerUnit=1, upAxis="Z", kilogramsPerUnit=0.001)
    assert thing(read, heavy("a", 250), layer=layer).mass_kg == pytest.approx(0.25)


# --- centre of mass ----------------------------------------------------------------------------------


def center(x, y, z):
    return f"point3f physics:centerOfMass = ({x}, {y}, {z})"


def test_center_of_mass_is_in_the_world(read):
    # Turned by 90° about z: (1, 0, 0) of the object is (0, 1, 0); translated by (10, 0, 0).
    turned = ops(("double3", "translate", (10, 0, 0)), ("float", "rotateZ", 90))
    obj = thing(read, "float physics:mass = 2", center(1, 0, 0.5), turned, cube("a"), meta=[MASS])
    assert obj.center_of_mass == pytest.approx((10, 1, 0.5))


def test_center_of_mass_on_a_y_up_stage_in_centimetres(read):
    # (10, 20, 30) cm, y up, is (0.1, -0.3, 0.2) m.
    layer = header(metersPerUnit=0.01, upAxis="Y")
    obj = thing(read, "float physics:mass = 2", center(10, 20, 30), cube("a"), meta=[MASS], layer=layer)
    assert obj.center_of_mass == pytest.approx((0.1, -0.3, 0.2))


def test_center_of_mass_is_weighted_by_mass(read):
    # (3 × (1, 0, 0) + 1 × (0, 0, 2)) / 4
    obj = thing(read, heavy("a", 3, center(1, 0, 0)), heavy("b", 1, center(0, 0, 2)), cube("c"))
    assert obj.center_of_mass == pytest.approx((0.75, 0, 0.5))


def test_center_of_mass_is_none_if_one_part_has_none(read):
    assert thing(read, heavy("a", 3, center(1, 0, 0)), heavy("b", 1)).center_of_mass is None
    assert thing(read, heavy("a", 3)).center_of_mass is None


def test_center_of_mass_without_a_mass_is_read_from_the_prim(read):
    assert thing(read, center(1, 2, 3), cube("a"), meta=[MASS]).center_of_mass == pytest.approx((1, 2, 3))


@pytest.mark.parametrize("value", ["(-inf, -inf, -inf)", "(nan, 0, 0)"])
def test_center_of_mass_that_is_not_finite_is_none(read, value):
    # UsdPhysics: minus infinity is the fallback, to be derived.
    line = f"point3f physics:centerOfMass = {value}"
    assert thing(read, "float physics:mass = 2", line, cube("a"), meta=[MASS]).center_of_mass is None


# --- asset -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("arc", ["references", "payload", "prepend references", "add payload"])
def test_asset_has_the_name_of_its_file(read, write_stage, arc):
    write_stage('(\n    defaultPrim = "A"\n)\n' + xform("A", cube("mesh")), "props/ikea_chair.v2.usda")
    tree = xform("World", prim("", "Thing", meta=[f"{arc} = @props/ikea_chair.v2.usda@"]), cube("other"))
    assert read(tree).by_path["/World/Thing"].asset == ("ikea_chair.v2",)


def test_asset_info_comes_first_and_names_are_not_repeated(read, write_stage):
    write_stage('(\n    defaultPrim = "A"\n)\n' + xform("A", cube("mesh")), "chair.usda")
    info = 'assetInfo = {\n    string name = "Stefan"\n    asset identifier = @lib/chair.usd@\n}'
    tree = xform("World", prim("", "Thing", meta=[info, "references = @chair.usda@"]), cube("other"))
    assert read(tree).by_path["/World/Thing"].asset == ("Stefan", "chair")


def test_nested_assets_are_named(read, write_stage):
    write_stage('(\n    defaultPrim = "G"\n)\n' + xform("G", cube("mesh")), "chair_geo.usda")
    outer = '(\n    defaultPrim = "A"\n)\n' + xform("A", meta=["payload = @chair_geo.usda@"])
    write_stage(outer, "chair.usda")
    tree = xform("World", prim("", "Thing", meta=["references = @chair.usda@"]), cube("other"))
    assert read(tree).by_path["/World/Thing"].asset == ("chair", "chair_geo")


def test_missing_and_foreign_asset_paths_give_names(read):
    meta = ["references = @D:\\props\\Kettle.usd@"]
    assert read(xform("World", prim("", "Thing", meta=meta), cube("o"))).by_path["/World/Thing"].asset == ("Kettle",)


def test_without_arcs_there_is_no_asset(read):
    internal = prim("", "Copy", meta=["references = </World/Thing>"])
    scene = read(xform("World", component("Thing", cube("a")), internal))
    assert [obj.asset for obj in scene.objects] == [(), ()]


# --- geometry file -----------------------------------------------------------------------------------


def asset_file(write_stage, name):
    return write_stage('(\n    defaultPrim = "A"\n)\n' + xform("A", cube("mesh")), name)


@pytest.mark.parametrize("arc", ["references", "prepend payload"])
def test_geometry_file_is_relative_to_the_stage(read, write_stage, arc):
    asset_file(write_stage, "props/chair.usda")
    tree = xform("World", prim("", "Thing", meta=[f"{arc} = @./props/chair.usda@"]), cube("other"))
    assert read(tree).by_path["/World/Thing"].geometry_file == "props/chair.usda"


def test_geometry_file_of_a_sublayer_is_relative_to_the_stage(read, write_stage):
    asset_file(write_stage, "rooms/props/chair.usda")
    room = xform("World", prim("", "Thing", meta=["references = @props/chair.usda@"]), cube("other"))
    write_stage(room, "rooms/room.usda")
    scene = read("", layer=METRES.replace("(\n", "(\n    subLayers = [@rooms/room.usda@]\n"))
    assert scene.by_path["/World/Thing"].geometry_file == "rooms/props/chair.usda"


def test_geometry_file_elsewhere_is_as_authored(read):
    tree = xform("World", prim("", "Thing", meta=["references = @https://assets.example/chair.usd@"]), cube("o"))
    assert read(tree).by_path["/World/Thing"].geometry_file == "https://assets.example/chair.usd"


def test_geometry_file_of_a_body_is_that_of_its_only_asset(read, write_stage):
    asset_file(write_stage, "chair.usda")
    asset_file(write_stage, "table.usda")
    visual = prim("", "visual", meta=["references = @chair.usda@"])
    twice = prim("", "again", meta=["references = @chair.usda@"])
    other = prim("", "other", meta=["references = @table.usda@"])
    assert thing(read, visual, twice).geometry_file == "chair.usda"
    assert thing(read, visual, other).geometry_file == "", "two files: neither is the geometry of the whole"


def test_without_files_there_is_no_geometry_file(read):
    internal = prim("", "Copy", meta=["references = </World/Thing>"])
    scene = read(xform("World", component("Thing", cube("a")), internal))
    assert [obj.geometry_file for obj in scene.objects] == ["", ""]


# --- materials ---------------------------------------------------------------------------------------


def bound(name, *materials):
    targets = ", ".join(f"</World/Looks/{material}>" for material in materials)
    return cube(name, f"rel material:binding = [{targets}]", meta=['prepend apiSchemas = ["MaterialBindingAPI"]'])


def bind(material):
    return f"rel material:binding = </World/Looks/{material}>"


def test_materials_are_named_in_order_of_appearance(read):
    obj = thing(read, bound("b", "Oak"), xform("deep", bound("a", "Steel")), bound("c", "Oak"))
    assert obj.materials == ("Oak", "Steel")


def test_parts_without_a_binding_inherit_the_material(read):
    assert thing(read, bind("Paint"), cube("plain"), bound("a", "Steel")).materials == ("Paint", "Steel")


def test_leaves_out_a_material_that_all_parts_override(read):
    # UsdShade: the binding nearest to the geometry wins.
    assert thing(read, bind("Paint"), bound("a", "Steel")).materials == ("Steel",)


def test_material_is_inherited_from_ancestors(read):
    chairs = xform("Chairs", bind("Oak"), component("A", cube("a")), component("B", bound("b", "Steel")))
    scene = read(xform("World", chairs, cube("other")))
    assert [obj.materials for obj in scene.objects] == [("Oak",), ("Steel",), ()]


def test_materials_of_geometry_subsets_count(read):
    subset = prim("GeomSubset", "glass", 'uniform token elementType = "face"', "int[] indices = [0]", bind("Glass"))
    mesh = prim("Mesh", "pane", "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]", "int[] faceVertexCounts = [3]",
                "int[] faceVertexIndices = [0, 1, 2]", bind("Frame"), subset)  # fmt: skip
    assert thing(read, mesh).materials == ("Frame", "Glass")


def test_materials_exclude_nested_objects(read):
    cabinet = rigid("Cabinet", bound("carcass", "Oak"), rigid("Handle", bound("bar", "Steel")))
    scene = read(xform("World", cabinet, cube("other")))
    assert [obj.materials for obj in scene.objects] == [("Oak",), ("Steel",), ()]


# --- parts, texts, colour, instances -----------------------------------------------------------------


def test_parts_are_the_distinct_names_below(read):
    obj = thing(read, xform("frame", cube("leg")), xform("back", cube("leg")), cube("Thing"))
    assert obj.parts == ("frame", "leg", "back")


def test_parts_leave_out_nested_objects(read):
    scene = read(xform("World", rigid("Cabinet", cube("carcass"), rigid("Drawer", cube("front"))), cube("other")))
    assert [obj.parts for obj in scene.objects] == [("carcass",), ("front",), ()]


def test_display_name_and_documentation(read):
    obj = thing(read, cube("a"), meta=['displayName = "Kitchen table"', 'doc = """  Seats four. """'])
    assert (obj.display_name, obj.documentation) == ("Kitchen table", "Seats four.")
    plain = thing(read, cube("a"))
    assert (plain.display_name, plain.documentation) == ("", "")


def test_first_authored_display_color(read):
    red = cube("red", "color3f[] primvars:displayColor = [(0.8, 0.1, 0.2)]")
    blue = cube("blue", "color3f[] primvars:displayColor = [(0, 0, 1)]")
    assert thing(read, cube("plain"), red, blue).display_color == (0.8, 0.1, 0.2)
    assert thing(read, cube("plain")).display_color is None


def test_instances_share_their_prototype(write_stage):
    write_stage('(\n    defaultPrim = "A"\n)\n' + xform("A", cube("mesh")), "cup.usda")
    copies = [prim("", n, meta=["references = @cup.usda@", "instanceable = true"]) for n in ("Cup1", "Cup2")]
    plain = prim("", "Cup3", meta=["references = @cup.usda@"])
    scene = read_scene(write_stage(METRES + xform("World", *copies, plain)))
    first, second, third = scene.objects
    assert first.instance_of == second.instance_of is not None
    assert third.instance_of is None
    assert first.parts == third.parts == ("mesh",)


def test_kind_and_type_are_as_authored(read):
    scene = read(xform("World", component("Thing", cube("a")), cube("other")))
    assert [(obj.type_name, obj.kind) for obj in scene.objects] == [("Xform", "component"), ("Cube", "")]


def test_ancestors_are_given_nearest_first(read):
    handle = rigid("Handle", cube("bar"))
    scene = read(
        xform("World", rigid("Cabinet", cube("c"), xform("slot", rigid("Drawer", cube("f"), handle))), cube("o"))
    )
    handle = scene.by_path["/World/Cabinet/slot/Drawer/Handle"]
    assert [obj.name for obj in scene.ancestors(handle)] == ["Drawer", "Cabinet"]
    assert list(scene.ancestors(scene.by_path["/World/o"])) == []
