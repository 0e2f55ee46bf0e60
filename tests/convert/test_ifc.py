"""IFC files are converted at reading: storeys, rooms, elements, kinds of things, identifiers, properties, units."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from tests.graph.records import open_store
from usd2kg import build
from usd2kg.convert.write import convert_file
from usd2kg.errors import GraphError, SceneError
from usd2kg.scene import read_scene

ifcopenshell = pytest.importorskip("ifcopenshell", reason="needs the extra ifc: pip install 'usd2kg[ifc]'")
aggregate = pytest.importorskip("ifcopenshell.api.aggregate")
context = pytest.importorskip("ifcopenshell.api.context")
feature = pytest.importorskip("ifcopenshell.api.feature")
geometry = pytest.importorskip("ifcopenshell.api.geometry")
material = pytest.importorskip("ifcopenshell.api.material")
pset = pytest.importorskip("ifcopenshell.api.pset")
root = pytest.importorskip("ifcopenshell.api.root")
spatial = pytest.importorskip("ifcopenshell.api.spatial")
style = pytest.importorskip("ifcopenshell.api.style")
unit = pytest.importorskip("ifcopenshell.api.unit")


class House:
    """An IFC file in millimetres with one storey."""

    def __init__(self, schema: str = "IFC4") -> None:
        self.model = ifcopenshell.file(schema=schema)
        if schema == "IFC2X3":
            self._add_author()
        self.project = root.create_entity(self.model, "IfcProject", name="Test house")
        unit.assign_unit(self.model, length={"is_metric": True, "raw": "MILLIMETERS"})
        whole = context.add_context(self.model, context_type="Model")
        self.body = context.add_context(
            self.model, context_type="Model", context_identifier="Body", target_view="MODEL_VIEW", parent=whole
        )
        self.site, self.building, self.storey = (
            root.create_entity(self.model, kind, name=name)
            for kind, name in [("IfcSite", "Plot"), ("IfcBuilding", "House"), ("IfcBuildingStorey", "Ground floor")]
        )
        for part, above in [(self.site, self.project), (self.building, self.site), (self.storey, self.building)]:
            aggregate.assign_object(self.model, products=[part], relating_object=above)

    def _add_author(self) -> None:
        """IFC 2x3 requires an author."""
        new = self.model.create_entity
        organization = new("IfcOrganization", None, "Lab")
        new("IfcPersonAndOrganization", new("IfcPerson", "me"), organization)
        new("IfcApplication", organization, "1", "test", "test")

    def add(
        self, kind: str, name: str | None, at: tuple[float, ...], size: tuple[float, ...], **attributes: Any
    ) -> Any:
        """Return a product that is a box; metres, `at` its lower corner."""
        product = root.create_entity(self.model, kind, name=name)
        for key, value in attributes.items():
            setattr(product, key, value)
        x, y, z = (1000.0 * length for length in size)
        new = self.model.create_entity
        origin = new("IfcAxis2Placement2D", new("IfcCartesianPoint", (x / 2, y / 2)))
        profile = new("IfcRectangleProfileDef", "AREA", None, origin, x, y)
        position = new("IfcAxis2Placement3D", new("IfcCartesianPoint", (0.0, 0.0, 0.0)))
        solid = new("IfcExtrudedAreaSolid", profile, position, new("IfcDirection", (0.0, 0.0, 1.0)), z)
        shape = new("IfcShapeRepresentation", self.body, "Body", "SweptSolid", [solid])
        geometry.assign_representation(self.model, product=product, representation=shape)
        matrix = np.eye(4)
        matrix[:3, 3] = at
        geometry.edit_object_placement(self.model, product=product, matrix=matrix)
        return product

    def put(self, product: Any, container: Any) -> Any:
        """Return the product, contained in a spatial element."""
        spatial.assign_container(self.model, products=[product], relating_structure=container)
        return product

    def compose(self, whole: Any, *parts: Any) -> None:
        aggregate.assign_object(self.model, products=list(parts), relating_object=whole)

    def save(self, path: Path) -> Path:
        self.model.write(str(path))
        return path


STOREY = "/Test_house/Plot/House/Ground_floor"


@pytest.fixture
def house() -> House:
    """A kitchen of 4 × 3 × 2.5 m with a table and a box on it, beside a bedroom with a bed, and a wall between."""
    made = House()
    kitchen = made.add("IfcSpace", "101", (0, 0, 0), (4, 3, 2.5), LongName="Kitchen")
    bedroom = made.add("IfcSpace", "102", (4.2, 0, 0), (4, 3, 2.5), LongName="Bedroom")
    made.compose(made.storey, kitchen, bedroom)
    made.put(made.add("IfcFurniture", "F-01", (1, 1, 0), (1.2, 0.8, 0.75), PredefinedType="TABLE"), kitchen)
    made.put(made.add("IfcBuildingElementProxy", "Bread box", (1.2, 1.2, 0.75), (0.3, 0.2, 0.15)), kitchen)
    made.put(made.add("IfcFurniture", "F-02", (5, 1, 0), (2, 1.6, 0.5), PredefinedType="BED"), bedroom)
    made.put(made.add("IfcWall", "Wall/A", (4, 0, 0), (0.2, 3, 2.5), Tag="W17"), made.storey)
    return made


def test_names_kinds_and_units(house: House, tmp_path: Path):
    scene = read_scene(house.save(tmp_path / "house.ifc"))
    assert sorted(obj.prim_path.removeprefix(STOREY) for obj in scene.objects) == [
        "/Bedroom",
        "/Bread_box",
        "/F_01",
        "/F_02",
        "/Kitchen",
        "/Wall_A",
    ]
    wall = scene.by_path[f"{STOREY}/Wall_A"]
    assert wall.display_name == "Wall/A"
    # The file is in millimetres.
    assert (scene.frame.metres_per_unit, scene.frame.up_axis) == (1, "Z")
    assert wall.box is not None
    assert wall.box.lower == pytest.approx((4, 0, 0))
    assert wall.box.size == pytest.approx((0.2, 3, 2.5))
    labels = {obj.name: [label.value for label in obj.labels.own] for obj in scene.objects}
    assert labels["F_01"] == ["table"]
    assert labels["Kitchen"] == ["room"]
    assert labels["Wall_A"] == ["wall"]
    assert labels["Bread_box"] == []


def test_spaces_are_rooms_and_things_are_in_them(house: House, tmp_path: Path):
    result = build(house.save(tmp_path / "house.ifc"))
    rooms = {(relation.target, relation.anchor) for relation in result.graph.relations if relation.kind == "room"}
    assert {(f"{STOREY}/F_01", f"{STOREY}/Kitchen"), (f"{STOREY}/F_02", f"{STOREY}/Bedroom")} <= rooms
    on = {(relation.target, relation.anchor) for relation in result.graph.relations if relation.kind == "on"}
    assert (f"{STOREY}/Bread_box", f"{STOREY}/F_01") in on
    found = open_store(result.graph).sparql(
        "SELECT ?thing WHERE { ?thing u2k:inRoom ?room . ?room rdfs:label '101 Kitchen' ; skos:altLabel 'Kitchen' } "
        "ORDER BY ?thing"
    )
    assert [row[0].rpartition(".")[2] for row in found.rows if row[0]] == ["Bread_box", "F_01"]


def test_rooms_are_found_by_number_and_by_name(house: House, tmp_path: Path):
    store = open_store(build(house.save(tmp_path / "house.ifc")).graph)
    for room in ("room 101", "101 Kitchen", "kitchen", "kitchen 101"):
        assert sorted(row[0] for row in store.inside(room).rows) == ["Bread box", "F-01"], room
    assert [row[0] for row in store.inside("room 102").rows] == ["F-02"]
    with pytest.raises(GraphError, match="room 103"):
        store.inside("room 103")


@pytest.mark.parametrize(
    ("name", "long_name", "shown"),
    [
        ("12", "Office 12", "Office 12"),
        ("Hall", "", "Hall"),
        (None, "Hall", "Hall"),
        (" 7 ", " Hall ", "7 Hall"),
        # It is no part of another number.
        ("1", "Room 10", "1 Room 10"),
    ],
)
def test_the_number_of_a_space_stands_once_in_its_name(tmp_path: Path, name, long_name, shown):
    house = House()
    space = house.add("IfcSpace", name, (0, 0, 0), (4, 3, 2.5), LongName=long_name)
    house.compose(house.storey, space)
    (room,) = read_scene(house.save(tmp_path / "house.ifc")).objects
    assert (room.display_name or room.name) == shown


def test_things_are_found_by_their_global_id(house: House, tmp_path: Path):
    (wall,) = house.model.by_type("IfcWall")
    result = build(house.save(tmp_path / "house.ifc"))
    assert result.scene.by_path[f"{STOREY}/Wall_A"].source_id == wall.GlobalId
    found = open_store(result.graph).sparql(
        f"SELECT ?path WHERE {{ ?thing dcterms:identifier '{wall.GlobalId}' ; u2k:primPath ?path }}"
    )
    assert found.rows == ((f"{STOREY}/Wall_A",),)
    assert not any(wall.GlobalId == text for obj in result.scene.objects for _, text in obj.texts)


def test_identifiers_properties_and_containers_are_custom_data(house: House, tmp_path: Path):
    (wall,) = house.model.by_type("IfcWall")
    properties = pset.add_pset(house.model, product=wall, name="Pset_WallCommon")
    pset.edit_pset(house.model, pset=properties, properties={"FireRating": "half an hour", "IsExternal": False})
    house.storey.Elevation = 1500.0
    convert_file(house.save(tmp_path / "house.ifc"), tmp_path / "house.usda")
    stage = Usd.Stage.Open(str(tmp_path / "house.usda"))
    data = stage.GetPrimAtPath(f"{STOREY}/Wall_A").GetCustomDataByKey("ifc")
    assert (data["globalId"], data["class"], data["tag"]) == (wall.GlobalId, "IfcWall", "W17")
    assert data["properties"] == {"Pset_WallCommon": {"FireRating": "half an hour", "IsExternal": False}}
    table = stage.GetPrimAtPath(f"{STOREY}/F_01").GetCustomDataByKey("ifc")
    assert (table["container"], table["predefinedType"]) == ("101 Kitchen", "TABLE")
    assert stage.GetPrimAtPath(STOREY).GetCustomDataByKey("ifc:elevation") == 1.5
    scene = read_scene(tmp_path / "house.usda")
    assert "half an hour" in [text for _, text in scene.by_path[f"{STOREY}/Wall_A"].texts]
    assert scene.origin is not None
    assert scene.origin.converter.startswith("ifcopenshell ")


def test_the_solid_of_a_room_is_a_guide(house: House, tmp_path: Path):
    convert_file(house.save(tmp_path / "house.ifc"), tmp_path / "house.usda")
    stage = Usd.Stage.Open(str(tmp_path / "house.usda"))
    room = UsdGeom.Mesh(stage.GetPrimAtPath(f"{STOREY}/Kitchen/body"))
    assert room.GetPurposeAttr().Get() == UsdGeom.Tokens.guide
    assert UsdGeom.ModelAPI(stage.GetPrimAtPath(f"{STOREY}/Kitchen")).GetExtentsHint()[1] == (4, 3, 2.5)
    assert [prim.GetName() for prim in stage.Traverse() if Usd.ModelAPI(prim).IsGroup()] == [
        "Test_house",
        "Plot",
        "House",
        "Ground_floor",
    ]


def test_parts_of_an_element_are_subcomponents_in_its_frame(tmp_path: Path):
    house = House()
    stair = house.put(house.add("IfcStair", "Stair", (1, 1, 0), (0.1, 0.1, 0.1)), house.storey)
    house.compose(stair, house.add("IfcStairFlight", None, (3, 0, 0), (1, 2, 1.5)))
    scene = read_scene(house.save(tmp_path / "house.ifc"))
    (found,) = scene.objects
    assert (found.prim_path, found.parts) == (f"{STOREY}/Stair", ("body", "StairFlight"))
    assert found.box is not None
    assert (found.box.lower, found.box.upper) == (pytest.approx((1, 0, 0)), pytest.approx((4, 2, 1.5)))


def test_openings_are_cut_and_doors_are_objects(tmp_path: Path):
    house = House()
    wall = house.put(house.add("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 2.5)), house.storey)
    opening = house.add("IfcOpeningElement", "Hole", (1, 0, 0), (1, 0.2, 2))
    feature.add_feature(house.model, feature=opening, element=wall)
    door = house.put(house.add("IfcDoor", "Door", (1, 0.05, 0), (1, 0.1, 2)), house.storey)
    feature.add_filling(house.model, opening=opening, element=door)
    convert_file(house.save(tmp_path / "house.ifc"), tmp_path / "house.usda")
    scene = read_scene(tmp_path / "house.usda")
    assert sorted(obj.name for obj in scene.objects) == ["Door", "Wall"]
    stage = Usd.Stage.Open(str(tmp_path / "house.usda"))
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath(f"{STOREY}/Wall/body"))
    assert {point[0] for point in mesh.GetPointsAttr().Get()} == {0, 1, 2, 4}


def test_colours_and_materials(tmp_path: Path):
    house = House()
    wall = house.put(house.add("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 2.5)), house.storey)
    red = style.add_style(house.model, name="red")
    shade = {"SurfaceColour": {"Name": None, "Red": 1.0, "Green": 0.25, "Blue": 0.0}}
    style.add_surface_style(house.model, style=red, ifc_class="IfcSurfaceStyleShading", attributes=shade)
    style.assign_representation_styles(
        house.model, shape_representation=wall.Representation.Representations[0], styles=[red]
    )
    brick = material.add_material(house.model, name="brick")
    material.assign_material(house.model, products=[wall], material=brick)
    (found,) = read_scene(house.save(tmp_path / "house.ifc")).objects
    # ((0.25 + 0.055) / 1.055) ** 2.4, by the transfer function of sRGB.
    assert found.display_color == pytest.approx((1, 0.050876, 0), abs=1e-5)
    assert found.materials == ("brick",)


def test_elements_outside_of_any_structure_are_read(tmp_path: Path):
    house = House("IFC2X3")
    house.add("IfcFurnishingElement", "Chair", (0, 0, 0), (0.5, 0.5, 0.9))
    (chair,) = read_scene(house.save(tmp_path / "house.ifc")).objects
    assert chair.prim_path == "/Test_house/Chair"
    assert [label.value for label in chair.labels.own] == ["furniture"]


def test_the_same_file_gives_the_same_stage(house: House, tmp_path: Path):
    path = house.save(tmp_path / "house.ifc")
    assert read_scene(path).content_hash == read_scene(path).content_hash


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a shopping list", "cannot be converted"),
        ("ISO-10303-21;\nHEADER;\n", "cannot be converted"),
        ("", "is empty"),
    ],
)
def test_a_broken_file_is_one_clear_error(tmp_path: Path, text: str, reason: str):
    path = tmp_path / "house.ifc"
    path.write_text(text)
    with pytest.raises(SceneError, match=reason) as caught:
        read_scene(path)
    assert len(str(caught.value).splitlines()) == 1


def test_a_file_without_geometry_is_refused(tmp_path: Path):
    with pytest.raises(SceneError, match="no product has a body that can be tessellated"):
        read_scene(House().save(tmp_path / "house.ifc"))


def damaged(folder: Path, damage: Callable[[House], None]) -> Path:
    house = House()
    house.put(house.add("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 2.5)), house.storey)
    damage(house)
    return house.save(folder / "house.ifc")


def without_id(house: House) -> None:
    house.model.by_type("IfcWall")[0].GlobalId = None


def in_a_circle(house: House) -> None:
    relation = house.model.by_type("IfcRelAggregates")[0]
    relation.RelatedObjects = [relation.RelatingObject]


@pytest.mark.parametrize(
    ("damage", "message"), [(without_id, r"#\d+ has no GlobalId"), (in_a_circle, r"#\d+ is a part of itself")]
)
def test_what_the_library_would_read_for_ever_is_refused(tmp_path: Path, damage: Callable[[House], None], message: str):
    with pytest.raises(SceneError, match=message):
        read_scene(damaged(tmp_path, damage))


@pytest.mark.parametrize("surplus", ["#{id}", "#1", "5.", ".T.", "(#1)"])
def test_a_surplus_attribute_before_the_global_id_is_refused(tmp_path: Path, surplus: str):
    path = damaged(tmp_path, lambda house: None)
    text = path.read_text()
    found = re.search(r"#(\d+)=IFCWALL\(", text)
    assert found is not None
    path.write_text(text.replace(found[0], f"{found[0]}{surplus.format(id=found[1])},"))
    message = (
        rf"house\.ifc: cannot be converted \(#{found[1]} IfcWall has a GlobalId that is no text; it may have a surplus"
    )
    with pytest.raises(SceneError, match=message):
        read_scene(path)


def test_a_surplus_attribute_at_the_end_is_ignored(tmp_path: Path):
    path = damaged(tmp_path, lambda house: None)
    path.write_text(re.sub(r"(#\d+=IFCWALL\(.*)\);", r"\1,$);", path.read_text()))
    assert [obj.name for obj in read_scene(path).objects] == ["Wall"]


def test_whatever_the_library_raises_is_one_error(tmp_path: Path):
    (tmp_path / "house.ifczip").write_bytes(b"no zip")
    with pytest.raises(SceneError, match=r"house\.ifczip: cannot be converted \(File is not a zip file\)"):
        read_scene(tmp_path / "house.ifczip")


def test_proxies_and_rooms_that_no_project_leads_to_are_read(tmp_path: Path):
    house = House()
    house.add("IfcProxy", "Pump", (0, 0, 0), (1, 1, 1), ProxyType="PRODUCT")
    apart = root.create_entity(house.model, "IfcBuildingStorey", name="Loft")
    room = house.add("IfcSpace", "Attic", (0, 0, 3), (4, 4, 2))
    aggregate.assign_object(house.model, products=[room], relating_object=apart)
    house.put(house.add("IfcFurniture", "Trunk", (1, 1, 3), (1, 0.5, 0.5)), apart)
    names = {found.name for found in read_scene(house.save(tmp_path / "house.ifc")).objects}
    assert {"Pump", "Attic", "Trunk"} <= names
