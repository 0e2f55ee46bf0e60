"""The usdview plugin: colours and pages on plain OpenUSD, and its commands against a recording stand-in for usdview."""

import importlib
import importlib.machinery
import json
import sys
from types import ModuleType, SimpleNamespace

import pytest
from pxr import Sdf, Usd, UsdGeom

from tests.integrations.conftest import COLOR, INTEGRATIONS, imported_from
from tests.scene.usda import METRES, component, cube, prim, xform
from usd2kg.diagrams.settings import COLORS

FOLDER = INTEGRATIONS / "usdview"


@pytest.fixture(autouse=True)
def _importable(monkeypatch):
    with imported_from(FOLDER, "usd2kg_usdview", monkeypatch):
        yield


@pytest.fixture
def core():
    return importlib.import_module("usd2kg_usdview.core")


@pytest.fixture
def pages():
    return importlib.import_module("usd2kg_usdview.pages")


def color_at(stage, path):
    """Return the colour that a renderer uses for a gprim, flattened and inherited."""
    primvar = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath(path)).FindPrimvarWithInheritance("displayColor")
    (color,) = primvar.ComputeFlattened()
    assert primvar.GetInterpolation() == "constant"
    return tuple(round(channel, 4) for channel in color)


def expected(coloring):
    """Return prim path → colour of the legend, and that of the rest."""
    return {path: tuple(round(c, 4) for c in color) for path, color in coloring.linear_colors().items()}


# Colours


def test_every_object_has_the_colour_of_its_class(core, stage):
    before = stage.GetRootLayer().ExportToString()
    coloring = core.color_by_class(stage, core.ground_stage(stage))
    colors = expected(coloring)
    assert color_at(stage, "/World/Table/Top") == colors["/World/Table"], "its own colour is overridden"
    assert color_at(stage, "/World/Mug/Body") == colors["/World/Mug"] != colors["/World/Table"]
    assert stage.GetRootLayer().ExportToString() == before
    assert {entry.color for entry in coloring.legend} <= {*COLORS.categories, COLORS.rest}


def test_resetting_restores_the_stage(core, stage):
    before = stage.Flatten().ExportToString()
    grounded = core.ground_stage(stage)
    first = core.color_by_class(stage, grounded)
    assert core.color_by_class(stage, grounded) == first, "colours are stable"
    assert len(stage.GetSessionLayer().subLayerPaths) == 1
    assert core.reset_colors(stage)
    assert stage.Flatten().ExportToString() == before
    assert not core.reset_colors(stage)


def test_nested_objects_and_the_rest_have_their_own_colours(core, write_stage):
    lamp = component("Lamp", cube("Foot", size=0.2, at=(0, 0, 0.6)))
    table = xform("Desk", cube("Top"), lamp, kind="assembly")
    stage = Usd.Stage.Open(
        str(write_stage(METRES + xform("World", table, cube("Backdrop", size=0.01, purpose="guide"))))
    )
    colors = expected(core.color_by_class(stage, core.ground_stage(stage)))
    assert color_at(stage, "/World/Desk/Lamp/Foot") == colors["/World/Desk/Lamp"]
    assert color_at(stage, "/World/Backdrop") == colors["/"]


@pytest.mark.parametrize(("own_color", "stays_instance"), [("", True), (COLOR, False)])
def test_instances_stay_instances_if_they_can(core, write_stage, own_color, stays_instance):
    prototype = prim("Xform", "Cup", cube("Body", own_color, size=0.1), specifier="class")
    cups = [component(name, meta=["instanceable = true", "inherits = </Cup>"]) for name in ("Cup_1", "Cup_2")]
    stage = Usd.Stage.Open(
        str(write_stage(METRES + prototype + xform("World", component("Table", cube("Top")), *cups)))
    )
    colors = expected(core.color_by_class(stage, core.ground_stage(stage)))
    assert stage.GetPrimAtPath("/World/Cup_1").IsInstance() == stays_instance
    assert color_at(stage, "/World/Cup_1/Body") == color_at(stage, "/World/Cup_2/Body") == colors["/World/Cup_1"]
    core.reset_colors(stage)
    assert stage.GetPrimAtPath("/World/Cup_1").IsInstance()


def test_indices_of_other_colours_are_blocked(core, write_stage):
    indexed = (
        'color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] (\n interpolation = "uniform"\n)\n'
        "int[] primvars:displayColor:indices = [0, 1, 0, 1, 0, 1]"
    )
    stage = Usd.Stage.Open(str(write_stage(METRES + component("Table", cube("Top", indexed)))))
    colors = expected(core.color_by_class(stage, core.ground_stage(stage)))
    assert color_at(stage, "/Table/Top") == colors["/Table"]


# Pages


def test_the_page_of_an_object(core, pages, stage):
    grounded = core.ground_stage(stage)
    page = pages.object_page(grounded, "/World/Mug/Body")
    prediction = grounded.grounding.by_path["/World/Mug"]
    assert prediction.class_iri.endswith("#Cup")
    assert f"&lt;{prediction.class_iri}&gt;" in page
    assert f"{prediction.confidence:.2f}" in page
    assert "0.100 × 0.100 × 0.100 m" in page
    assert page.count("(score ") == min(len(prediction.candidates), 5)
    assert "Explanation" in page and "Concept" in page


def test_an_object_without_a_class_and_a_prim_without_an_object(core, pages, stage):
    grounded = core.ground_stage(stage)
    assert pages.object_page(grounded, "/World") == "<p>/World belongs to no object.</p>"
    unnamed = grounded.grounding.by_path["/World/Zorblax"]
    assert ("none (" in pages.object_page(grounded, "/World/Zorblax")) == (unnamed.class_iri is None)


def test_names_are_escaped(core, pages, write_stage):
    body = component("Mug", cube("Body"), meta=['displayName = "<b>mug</b>"'])
    stage = Usd.Stage.Open(str(write_stage(METRES + body)))
    page = pages.object_page(core.ground_stage(stage), "/Mug")
    assert "&lt;b&gt;mug&lt;/b&gt;" in page and "<b>mug" not in page


# Container


class Usdview:
    """Records what the plugin does to usdview."""

    def __init__(self, stage):
        self.stage, self.prim, self.qMainWindow = stage, None, object()
        self.dataModel = SimpleNamespace(viewSettings=SimpleNamespace(enableSceneMaterials=True))
        self.status, self.menus, self.dialogs, self.updates = [], {}, [], 0

    def PrintStatus(self, message):
        self.status.append(message)

    def UpdateViewport(self):
        self.updates += 1

    # The registry and the builder of the user interface

    def registerCommandPlugin(self, name, title, run, description=""):
        return SimpleNamespace(name=name, displayName=title, run=lambda: run(self), description=description)

    def findOrCreateMenu(self, name):
        items = self.menus.setdefault(name, {})
        return SimpleNamespace(addItem=lambda command: items.__setitem__(command.displayName, command))

    def run(self, title):
        self.menus["usd2kg"][title].run()


@pytest.fixture
def usdview(monkeypatch, stage):
    usdview = Usdview(stage)
    package, plugin, qt = (ModuleType(f"pxr.Usdviewq{name}") for name in ("", ".plugin", ".qt"))
    package.__spec__ = importlib.machinery.ModuleSpec("pxr.Usdviewq", None, is_package=True)
    package.__path__ = []
    plugin.PluginContainer = type("PluginContainer", (), {})
    qt.QtWidgets = None
    for module in (package, plugin, qt):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setattr("pxr.Tf.Type.Define", lambda _: None)
    monkeypatch.delenv("USD2KG_ONTOLOGY", raising=False)
    container = importlib.import_module("usd2kg_usdview").Usd2kgPluginContainer()

    def open_dialog(parent, title, html):
        assert parent is usdview.qMainWindow
        usdview.dialogs.append((title, html))
        return SimpleNamespace(isVisible=lambda: True)

    monkeypatch.setattr(importlib.import_module("usd2kg_usdview.dialog"), "open_dialog", open_dialog)
    container.registerPlugins(usdview, usdview)
    container.configureView(usdview, usdview)
    return usdview


def test_the_menu(usdview):
    assert list(usdview.menus) == ["usd2kg"]
    commands = usdview.menus["usd2kg"]
    assert list(commands) == ["Color by class", "Reset colors", "Object page"]
    assert all(command.description and command.name.startswith("Usd2kg.") for command in commands.values())


def test_colouring_hides_materials_and_resetting_restores_them(usdview):
    view = usdview.dataModel.viewSettings
    usdview.run("Color by class")
    usdview.run("Color by class")
    assert not view.enableSceneMaterials
    title, legend = usdview.dialogs[-1]
    assert title == "usd2kg: classes" and "bgcolor" in legend
    usdview.run("Reset colors")
    assert view.enableSceneMaterials
    assert list(usdview.stage.GetSessionLayer().subLayerPaths) == []
    usdview.run("Reset colors")
    assert usdview.status[-2:] == ["usd2kg: the colours are reset", "usd2kg: the stage has no colours to reset"]
    assert usdview.updates == 4


def test_the_page_of_the_selected_prim(usdview):
    usdview.run("Object page")
    assert usdview.status == ["usd2kg: select a prim first"]
    usdview.prim = usdview.stage.GetPrimAtPath("/World/Mug/Body")
    usdview.run("Object page")
    usdview.run("Object page")
    assert [title for title, _ in usdview.dialogs] == ["usd2kg: object"] * 2
    assert "/World/Mug" in usdview.dialogs[0][1]
    assert usdview.status.count("usd2kg: grounding the objects…") == 1, "the second page needs no grounding"


def test_another_stage_is_grounded_again(usdview, write_stage):
    usdview.prim = usdview.stage.GetPrimAtPath("/World/Mug")
    usdview.run("Object page")
    usdview.stage = Usd.Stage.Open(str(write_stage(METRES + component("Table", cube("Top")), "other.usda")))
    usdview.prim = usdview.stage.GetPrimAtPath("/Table")
    usdview.run("Object page")
    assert "/Table" in usdview.dialogs[-1][1]


def test_errors_are_in_the_status_line(usdview, monkeypatch, tmp_path):
    monkeypatch.setenv("USD2KG_ONTOLOGY", str(tmp_path / "missing.owl"))
    usdview.run("Color by class")
    assert usdview.status[-1].startswith("usd2kg: ") and "missing.owl" in usdview.status[-1]
    assert usdview.dialogs == []


def test_plug_info_names_the_container(usdview):
    (plugin,) = json.loads((FOLDER / "plugInfo.json").read_text("utf-8"))["Plugins"]
    ((name, info),) = plugin["Info"]["Types"].items()
    # OpenUSD imports the package that the plugin is named after, and finds the class by its Tf type: module and name.
    container = importlib.import_module(plugin["Name"]).Usd2kgPluginContainer
    assert name == f"{container.__module__}.{container.__qualname__}"
    assert info["bases"] == ["pxr.Usdviewq.plugin.PluginContainer"]


def test_the_modules_without_qt_need_no_usdview(core, pages):
    assert not hasattr(sys.modules["usd2kg_usdview"], "Usd2kgPluginContainer")
    assert core.find_object(SimpleNamespace(by_path={"/A": 1}), str(Sdf.Path("/A/B/C"))) == 1
