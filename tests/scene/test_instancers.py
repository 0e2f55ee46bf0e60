"""Copies of point instancers: what their prototypes state."""

import pytest

from tests.scene.usda import METRES, cube, header, move, prim, xform
from usd2kg.scene import ReadOptions, read_scene

COPIES = ReadOptions(expand_instancers=True)
APIS = 'prepend apiSchemas = ["PhysicsMassAPI", "SemanticsLabelsAPI:class"]'


def instancer(name, *body, prototypes=("/World/Buckets/Bucket",), indices=(0, 0), lines=()):
    """Return a point instancer whose copies are 2 units apart on the x axis."""
    targets = ", ".join(f"<{path}>" for path in prototypes)
    positions = ", ".join(str((2 * place, 0, 0)) for place in range(len(indices)))
    arrays = [f"int[] protoIndices = {list(indices)}", f"point3f[] positions = [{positions}]"]
    return prim("PointInstancer", name, *arrays, f"rel prototypes = [{targets}]", *lines, *body)


def bucket(*lines, name="Bucket"):
    meta = [APIS, 'displayName = "Blue bucket"', 'customData = { string note = "holds water" }']
    body = ["float physics:mass = 12", "point3f physics:centerOfMass = (0, 0, 3)", *lines]
    paint = "color3f[] primvars:displayColor = [(0, 0, 1)]"
    labels = 'token[] semantics:labels:class = ["bucket"]'
    return xform(name, labels, *body, cube("shell", paint), meta=meta)


def copies(scene):
    return [obj for obj in scene.objects if obj.selected_by == "copy of a point instancer"]


def test_copies_state_what_their_prototype_states(read):
    first, second = copies(read(xform("World", instancer("Buckets", bucket()), cube("b")), options=COPIES))
    for copy in (first, second):
        assert (copy.mass_kg, copy.display_name, copy.display_color) == (12, "Blue bucket", (0, 0, 1))
        assert [(label.prim_path, label.value) for label in copy.labels.own] == [("/World/Buckets/Bucket", "bucket")]
        assert copy.texts == (("customData:note", "holds water"),)
        assert copy.parts == ("shell",)
    assert (first.center_of_mass, second.center_of_mass) == ((0, 0, 3), (2, 0, 3))


def test_the_centre_of_mass_moves_with_the_copy(read):
    # Turned by 90 degrees about x, twice as large, in centimetres: (0, 0, 3) becomes (0, -6, 0) beside the prototype,
    # whose own place (100, 0, 0) OpenUSD adds.
    turned = "quath[] orientations = [(0.7071, 0.7071, 0, 0)]\nfloat3[] scales = [(2, 2, 2)]"
    grown = instancer("Buckets", bucket(move(100, 0, 0)), indices=(0,), lines=[turned])
    scene = read(xform("World", grown, cube("b")), layer=header(metersPerUnit=0.01, upAxis="Z"), options=COPIES)
    assert copies(scene)[0].center_of_mass == pytest.approx((2, -0.06, 0), abs=1e-4)


def test_materials_of_copies_are_bound_at_above_or_below_the_prototype(read):
    binding = 'prepend apiSchemas = ["MaterialBindingAPI"]'
    body = cube("body", "rel material:binding:preview = </World/Steel>", meta=[binding])
    inner = [xform("Bucket", body), xform("Pail", cube("body"))]
    paths = [f"/World/Buckets/{name}" for name in ("Bucket", "Pail")]
    drawn = instancer("Buckets", *inner, "rel material:binding = </World/Oak>", prototypes=paths, indices=(0, 1))
    looks = [prim("Material", name) for name in ("Steel", "Oak")]
    scene = read(xform("World", drawn, *looks, cube("b")), options=COPIES)
    assert [copy.materials for copy in copies(scene)] == [("Oak", "Steel"), ("Oak",)]


def test_copies_inherit_the_labels_of_their_instancer(read):
    group = 'token[] semantics:labels:class = ["{}"]'
    shared = xform("Protos", group.format("library"), bucket())
    path = ["/Protos/Bucket"]
    tree = [
        xform(name, group.format(name.lower()), instancer("I", prototypes=path, indices=(0,)))
        for name in ("Shed", "Attic")
    ]
    scene = read(xform("World", *tree, cube("b")), prim("Scope", "Hidden"), shared, options=COPIES)
    assert [[label.value for label in copy.labels.inherited] for copy in copies(scene)] == [["shed"], ["attic"]]
    assert [label.is_inherited for copy in copies(scene) for label in copy.labels.inherited] == [True, True]


def test_an_identifier_of_the_source_is_not_that_of_each_copy(read):
    known = xform("Bucket", cube("a"), meta=['customData = { string usd2kgSourceId = "1a2b" }'])
    assert [c.source_id for c in copies(read(xform("World", instancer("Buckets", known)), options=COPIES))] == ["", ""]


@pytest.mark.parametrize("meta", ["active = false", 'kind = "component"'])
def test_a_prototype_without_content_has_copies_with_its_names(read, meta):
    hollow = xform("Bucket", 'token visibility = "invisible"', cube("a"), meta=[meta, 'displayName = "Pail"'])
    found = copies(read(xform("World", instancer("Buckets", hollow), cube("b")), options=COPIES))
    assert [(copy.name, copy.display_name, copy.mass_kg) for copy in found] == [
        ("Bucket_0", "Pail", None),
        ("Bucket_1", "Pail", None),
    ]


def test_a_stage_with_expanded_instancers_that_changed_is_read_anew(write_stage):
    """A prototype that stays in memory would keep the stage open, and OpenUSD its layers."""
    for mass in (12, 7):
        text = instancer("Buckets", bucket()).replace("mass = 12", f"mass = {mass}")
        path = write_stage(METRES + xform("World", text, cube("b")))
        assert {copy.mass_kg for copy in copies(read_scene(path, options=COPIES))} == {mass}


# --- copies that are one object -----------------------------------------------------------------------


def notes(scene):
    return [(note.prim_path, note.message) for note in scene.diagnostics if note.code == "instancer"]


def test_copies_that_are_one_object_are_reported_with_the_option(read):
    buckets = instancer("Buckets", bucket(), indices=(0, 0, 0))
    expected = "its point instancers draw 3 copies of Bucket that are one object"
    remedy = "; --expand-instancers makes every copy an object"
    assert notes(read(xform("World", buckets, cube("b")))) == [("/World/Buckets", expected + remedy)]
    pails = instancer("Pails", prototypes=("/World/Buckets/Bucket",))
    several = expected + ", and 2 such objects have 5 copies in all" + remedy
    assert notes(read(xform("World", buckets, pails, cube("b")))) == [("/World/Buckets", several)]
    assert notes(read(xform("World", buckets, pails, cube("b")), options=COPIES)) == []


def test_a_single_copy_is_not_reported(read):
    assert notes(read(xform("World", instancer("Buckets", bucket(), indices=(0,)), cube("b")))) == []


def own_labels(read, *prototypes, lines=(), indices=(0, 1)):
    paths = [f"/World/Buckets/{name}" for name in ("Bucket", "Pail")]
    drawn = instancer("Buckets", *prototypes, prototypes=paths, indices=indices, lines=lines)
    labels = read(xform("World", drawn, cube("b"))).by_path["/World/Buckets"].labels
    return [(label.prim_path, label.value) for label in labels.own]


def test_labels_that_all_drawn_prototypes_have_are_those_of_their_instancer(read):
    pail, plain = bucket(name="Pail"), xform("Pail", cube("a"))
    found = [("/World/Buckets/Bucket", "bucket")]
    assert own_labels(read, bucket(), pail) == found
    assert own_labels(read, bucket(), plain) == []
    # The second prototype has no copy.
    assert own_labels(read, bucket(), plain, indices=(0, 0)) == found
    assert own_labels(read, indices=()) == []


def test_labels_of_the_instancer_replace_those_of_its_prototypes(read):
    line = 'token[] semantics:labels:class = ["pile"]'
    assert own_labels(read, bucket(), bucket(name="Pail"), lines=[line]) == [("/World/Buckets", "pile")]
