"""Views of one object under each naming regime and evidence group."""

import time
from dataclasses import replace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.grounding.records import neighbours_of
from tests.scene.usda import component, cube, prim, xform
from usd2kg.grounding import EVIDENCE_GROUPS, STUDY_GROUPS, NamingRegime, ObjectView, view_objects
from usd2kg.grounding.context import abbreviate
from usd2kg.scene import ROBOT, Box, Label, ObjectLabels, Scene, SceneObject, StageFrame

MASKED = [NamingRegime.ABBREVIATED, NamingRegime.OPAQUE, NamingRegime.OPAQUE_ANONYMOUS]


def thing(path, parent=None):
    """Return an object with a value in every field."""
    return SceneObject(
        prim_path=path,
        name=path.rpartition("/")[2],
        type_name="Xform",
        kind="component",
        selected_by="authored kind: component",
        parent_path=parent,
        box=Box((0, 0, 0), (1, 2, 3)),
        own_box=Box((0, 0, 0), (1, 1, 1)),
        part_boxes=(),
        position=(4, 5, 6),
        orientation=(0, 0, 0, 1),
        mass_kg=2.5,
        display_name="Coffee cup",
        documentation="A cup for coffee.",
        asset=("ikea_cup",),
        materials=("Porcelain",),
        parts=("handle",),
        display_color=(1, 0, 0),
        instance_of=None,
        labels=ObjectLabels((Label(path, "UsdSemantics", "class", "mug"),), (), ()),
    )


def scene_of(*paths):
    return Scene("test", "sha256:0", StageFrame("Z", 1, 1, True), None, len(paths), tuple(map(thing, paths)), {})


def views(scene, *args, **options):
    return [view for _, view in view_objects(scene, *args, **options)]


KITCHEN = scene_of("/Kitchen/Table", "/Kitchen/Table/CupCBlue_1", "/Kitchen/Table/Plate", "/Kitchen/Lamp")


# --- abbreviating ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "short"),
    [
        ("CupCBlue_1", "cpcbl1"),  # cup → cp, c, blue → bl, 1
        ("refrigerator", "rfrg"),  # r f r g r t r, cut to four
        ("CoffeeTable_01_002", "cfftbl12"),  # cff, tbl, 1, 2
        ("TVCabinet", "tvcbnt"),
        ("Eye", "y"),
        ("Aue", "a"),  # vowels alone keep the first letter
        ("oven_A", "vna"),
        ("Küche", "küch"),  # only a, e, i, o, u are vowels: k ü c h
        ("___", "___"),
    ],
)
def test_abbreviate(name, short):
    assert abbreviate(name) == short


def test_abbreviate_to_another_length():
    assert abbreviate("refrigerator", 2) == "rf"
    assert abbreviate("CoffeeTable", 1) == "ct"


@settings(max_examples=100, deadline=None)
@given(st.text(min_size=1, max_size=20))
@example("chair_፩")  # int() rejects Ethiopic digits, which prim names may contain
@example("x²")
def test_any_name_is_abbreviated_to_lower_case(name):
    short = abbreviate(name)
    assert short
    assert short == short.lower()


def test_abbreviated_names_of_different_names_differ():
    # cup and cap are both cp; the second gets a number.
    names = [view.name for view in views(scene_of("/W/cup", "/W/cap", "/X/cup", "/W/cop"), NamingRegime.ABBREVIATED)]
    assert names == ["cp", "cpx2", "cp", "cpx3"]


identifiers = st.from_regex(r"[A-Za-z][A-Za-z0-9_]{0,6}", fullmatch=True)


@settings(max_examples=75, deadline=None)
@given(st.lists(identifiers, min_size=1, max_size=12))
@example(["cup", "cap", "cpx2", "cop", "cpx3"])
def test_abbreviated_names_are_unique(names):
    scene = scene_of(*(f"/W/g{index}/{name}" for index, name in enumerate(names)))
    short = [view.name for view in views(scene, NamingRegime.ABBREVIATED)]
    assert len(set(zip(names, short, strict=True))) == len(set(names)) == len(set(short))


# --- the regimes -------------------------------------------------------------------------------------


def test_the_semantic_regime_shows_all_fields():
    view = views(KITCHEN)[1]
    assert view == ObjectView(
        name="CupCBlue_1",
        parents=("Kitchen", "Table"),
        groups=("Kitchen", "Table"),
        siblings=view.siblings,
        size=(1, 2, 3),
        mass_kg=2.5,
        position=(4, 5, 6),
        display_name="Coffee cup",
        documentation="A cup for coffee.",
        asset=("ikea_cup",),
        materials=("Porcelain",),
        parts=("handle",),
        labels=("mug",),
        neighbourhood=view.neighbourhood,
        placement=view.placement,
        is_masked=False,
    )
    assert list(view.siblings) == ["Plate"]
    assert [companion.name for companion in neighbours_of(view.neighbourhood)] == ["Plate", "Table", "Lamp"]


def test_opaque_names_are_numbers_in_traversal_order():
    assert [view.name for view in views(KITCHEN, NamingRegime.OPAQUE)] == ["obj_001", "obj_002", "obj_003", "obj_004"]


def test_only_the_target_is_masked():
    view = views(KITCHEN, NamingRegime.OPAQUE)[1]
    assert (view.parents, list(view.siblings)) == (("Kitchen", "Table"), ["Plate"])


def test_the_anonymous_regime_masks_the_other_names_too():
    view = views(KITCHEN, NamingRegime.OPAQUE_ANONYMOUS)[0]
    assert view.neighbourhood is None
    assert (view.name, view.parents, list(view.siblings)) == ("obj_001", ("group_1",), ["sibling_2"])
    everything = repr([(v, list(v.siblings)) for v in views(KITCHEN, NamingRegime.OPAQUE_ANONYMOUS)])
    for word in ("Kitchen", "Table", "Cup", "Plate", "Lamp"):
        assert word not in everything


@pytest.mark.parametrize("regime", MASKED)
def test_masked_regimes_hide_all_other_text(regime):
    for view in views(KITCHEN, regime):
        assert view.is_masked
        assert (view.asset, view.labels, view.materials, view.parts) == ((), (), (), ())
        assert (view.display_name, view.documentation) == ("", "")
        assert (view.size, view.position, view.mass_kg) == ((1, 2, 3), (4, 5, 6), 2.5)


@pytest.mark.parametrize("regime", MASKED)
def test_masked_regimes_hide_other_text_even_if_requested(regime):
    for view in views(KITCHEN, regime, groups=EVIDENCE_GROUPS):
        assert (view.asset, view.labels, view.materials, view.parts, view.display_name) == ((), (), (), (), "")
        assert (view.neighbourhood is None) == (regime is NamingRegime.OPAQUE_ANONYMOUS)


# --- evidence groups ---------------------------------------------------------------------------------

FIELDS = {
    "name": {"name", "display_name", "documentation"},
    "geometry": {"size", "mass_kg"},
    "position": {"position"},
    "hierarchy": {"parents", "groups", "siblings"},
    "asset": {"asset"},
    "materials": {"materials"},
    "parts": {"parts"},
    "labels": {"labels"},
    "neighbours": {"neighbourhood"},
}


def shown(view):
    """Return the names of the fields that are not empty."""
    values = {name: getattr(view, name) for name in set().union(*FIELDS.values())}
    return {name for name, value in values.items() if _holds(value)}


def _holds(value):
    return value is not None and (not hasattr(value, "__len__") or len(value) > 0)


def test_all_groups_are_tested():
    assert set(FIELDS) == EVIDENCE_GROUPS
    assert {"name", "geometry", "position", "hierarchy"} == STUDY_GROUPS


@pytest.mark.parametrize("group", sorted(FIELDS))
def test_one_group_shows_only_its_fields(group):
    assert shown(views(KITCHEN, groups=frozenset({group}))[1]) == FIELDS[group]


@pytest.mark.parametrize("group", sorted(FIELDS))
def test_all_groups_but_one_hide_its_fields(group):
    others = set().union(*(fields for name, fields in FIELDS.items() if name != group))
    assert shown(views(KITCHEN, groups=EVIDENCE_GROUPS - {group})[1]) == others


def test_no_group_shows_nothing():
    assert shown(views(KITCHEN, groups=frozenset())[1]) == set()


@pytest.mark.parametrize("regime", [NamingRegime.ABBREVIATED, NamingRegime.OPAQUE])
def test_a_masked_target_has_companions_except_in_the_study_groups(regime):
    others = [[companion.name for companion in neighbours_of(view.neighbourhood)] for view in views(KITCHEN, regime)]
    # Children of the table have its name among their parents and are not companions of it.
    assert [sorted(names) for names in others] == [
        ["Lamp"],
        ["Lamp", "Plate", "Table"],
        ["CupCBlue_1", "Lamp", "Table"],
        ["CupCBlue_1", "Plate", "Table"],
    ]
    assert {view.neighbourhood for view in views(KITCHEN, regime, groups=STUDY_GROUPS)} == {None}


# --- labels ------------------------------------------------------------------------------------------

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"


def label(taxonomy, value, encoding="UsdSemantics", **known):
    return Label("/W/x", encoding, taxonomy, value, **known)


def label_words(*own, inherited=(), of_parts=()):
    labelled = replace(thing("/W/x"), labels=ObjectLabels(own, inherited, of_parts))
    scene = scene_of()
    return views(replace(scene, objects=(labelled,)))[0].labels


def test_what_is_articulated_like_a_robot_is_labelled_as_one():
    panda = replace(thing("/W/panda"), selected_by=ROBOT, labels=ObjectLabels((), (), ()))
    labelled = replace(panda, labels=ObjectLabels((label("class", "crane"),), (), ()))
    assert [view.labels for view in views(replace(scene_of(), objects=(panda, labelled)))] == [("robot",), ("crane",)]


@pytest.mark.parametrize(
    ("one", "word"),
    [
        (label("class", "coffee mug"), "coffee mug"),
        (label("semantics", "drawer"), "drawer"),
        (label("wikidata_class", "table"), "table"),
        (label("class", "chair", "Isaac"), "chair"),
        (label("iri", SOMA + "Drawer"), "Drawer"),
        (label("iri", "https://lab.example/things/Beaker/"), "Beaker"),
        (label(SOMA, "DesignedChair", "Multiverse"), "DesignedChair"),
        (label("WordNet", "drawer.n.wn.artifact", "Multiverse"), "drawer"),
        (label("WordNet", "coffee_table.n.wn.artifact", "Multiverse"), "coffee_table"),
    ],
)
def test_class_labels_are_shown_as_names(one, word):
    assert label_words(one) == (word,)


@pytest.mark.parametrize(
    "one",
    [
        label("wikidata_qcode", "Q81727"),
        label("hierarchy", "furniture/chair"),
        label("colour", "red"),
        label("id", "17", "Isaac"),
        label("WordNet", "drawer.n.wn.artifact", "Multiverse", strength="report"),
    ],
)
def test_labels_that_name_no_class_are_not_shown(one):
    assert label_words(one) == ()


def test_labels_keep_their_order_without_repeats():
    three = [label("class", "cup"), label("class", "cup", "Isaac"), label("class", "mug")]
    assert label_words(*three) == ("cup", "mug")


def test_inherited_labels_and_labels_of_parts_are_not_shown():
    assert label_words(inherited=(label("class", "kitchen"),), of_parts=(label("class", "handle"),)) == ()


def test_labels_are_read_from_the_stage(read):
    wordnet = prim("", "Onto", prim("", "_class_drawer", 'string rdf:conceptName = "drawer.n.wn.artifact"'))
    usd = 'token[] semantics:labels:class = ["mug", "cup"]'
    stem = "string semantic:Semantics:params:semantic"
    isaac = f'{stem}Type = "class"\n{stem}Data = "chair"'
    tag = "rel semanticTag:semanticLabels = </Onto/_class_drawer>"
    bodies = {"a": usd, "b": isaac, "c": tag, "d": ""}
    scene = read(wordnet, xform("World", *(component(name, body, cube("geo")) for name, body in bodies.items())))
    shown = {obj.name: view.labels for obj, view in view_objects(scene)}
    assert shown == {"a": ("mug", "cup"), "b": ("chair",), "c": ("drawer",), "d": ()}
    for regime in MASKED:
        assert {view.labels for _, view in view_objects(scene, regime, EVIDENCE_GROUPS)} == {()}


# --- siblings ----------------------------------------------------------------------------------------


def test_siblings_exclude_the_target():
    siblings = views(scene_of("/W/a", "/W/b", "/W/c", "/V/d"))[1].siblings
    assert (len(siblings), list(siblings), siblings[0], siblings[1], siblings[-1]) == (2, ["a", "c"], "a", "c", "c")
    assert siblings[:5] == ["a", "c"]
    with pytest.raises(IndexError):
        siblings[2]


def test_a_sibling_of_the_same_name_stays():
    scene = scene_of("/W/a", "/W/b")
    twins = Scene("t", "", scene.frame, None, 3, (*scene.objects, thing("/W/a2")), {})
    assert list(views(twins)[0].siblings) == ["b", "a2"]


@pytest.mark.parametrize(
    ("regime", "parents", "groups"),
    [
        (NamingRegime.OPAQUE, ("Kitchen", "Cabinet", "slots", "top"), ("slots", "top")),
        (NamingRegime.OPAQUE_ANONYMOUS, ("group_1", "group_2", "group_3", "group_4"), ("group_3", "group_4")),
    ],
)
def test_groups_are_the_parents_below_the_parent_object(regime, parents, groups):
    scene = scene_of("/Kitchen/Cabinet")
    drawer = thing("/Kitchen/Cabinet/slots/top/Drawer", parent="/Kitchen/Cabinet")
    both = Scene("t", "", scene.frame, None, 2, (*scene.objects, drawer), {})
    cabinet_view, drawer_view = views(both, regime)
    assert cabinet_view.groups == cabinet_view.parents == parents[:1]
    assert (drawer_view.parents, drawer_view.groups) == (parents, groups)


def test_objects_at_the_root_are_siblings_without_parents():
    first = views(scene_of("/a", "/b"))[0]
    assert (first.parents, list(first.siblings)) == ((), ["b"])


@pytest.mark.parametrize("regime", list(NamingRegime))
def test_time_is_not_quadratic_in_the_number_of_siblings(regime):
    # A list for each view would hold 1e8 names.
    scene = scene_of(*(f"/W/Book_{index}" for index in range(10_000)))
    start = time.process_time()
    lengths = {len(view.siblings) for view in views(scene, regime)}
    assert lengths == {9_999}
    assert time.process_time() - start < 5


def test_a_name_of_thousands_of_digits_is_abbreviated():
    assert abbreviate("cup_" + "0" * 3 + "7" * 5000) == "cp" + "7" * 5000
    assert abbreviate("cup_000") == "cp0"
