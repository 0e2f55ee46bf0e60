"""The Omniverse extension: its core on plain OpenUSD, and its menu and task against a recording stand-in for Kit."""

import asyncio
import importlib
import os
import subprocess
import sys
import tomllib
from types import ModuleType, SimpleNamespace

import pytest
from pxr import Usd, UsdSemantics

from tests.integrations.conftest import INTEGRATIONS, SCENE, imported_from
from usd2kg.errors import OutputError, SceneError

FOLDER = INTEGRATIONS / "omniverse" / "usd2kg.omni"
CONFIG = tomllib.loads((FOLDER / "config" / "extension.toml").read_text("utf-8"))


@pytest.fixture(autouse=True)
def _importable(monkeypatch):
    with imported_from(FOLDER, "usd2kg_omni", monkeypatch):
        yield


@pytest.fixture
def core(_importable):
    return importlib.import_module("usd2kg_omni.core")


def class_labels(stage: Usd.Stage, path: str) -> list[str]:
    """Return the class labels that OpenUSD and Replicator read from a prim."""
    prim = stage.GetPrimAtPath(path)
    return (
        list(UsdSemantics.LabelsAPI(prim, "class").GetLabelsAttr().Get() or [])
        if prim.HasAPI(UsdSemantics.LabelsAPI, "class")
        else []
    )


# Core


def test_labels_go_into_the_session(core, stage):
    before = stage.GetRootLayer().ExportToString()
    grounded = core.ground_stage(stage)
    assert class_labels(stage, "/World/Table") == ["Table"]
    assert class_labels(stage, "/World/Mug") == ["Cup"]
    assert stage.GetRootLayer().ExportToString() == before
    assert grounded.labelled == grounded.report.counts["written"] > 1
    assert grounded.summary.startswith("3 objects of ")
    assert f"{grounded.labelled} labelled" in grounded.summary


def test_removing_the_labels_restores_the_stage(core, stage):
    before = stage.Flatten().ExportToString()
    core.ground_stage(stage)
    assert core.remove_labels(stage)
    assert stage.Flatten().ExportToString() == before
    assert not core.remove_labels(stage)


def test_earlier_labels_are_no_evidence(core, stage):
    first = core.ground_stage(stage)
    second = core.ground_stage(stage)
    assert second.objects.grounding.predictions == first.objects.grounding.predictions
    assert second.report == first.report


def test_the_legacy_encoding_and_the_confidence_are_settings(core, stage):
    settings = core.LabelSettings(encodings="semantics,isaac", min_confidence=0.5)
    grounded = core.ground_stage(stage, settings=settings)
    mug = stage.GetPrimAtPath("/World/Mug")
    assert mug.GetAttribute("semantic:Semantics:params:semanticType").Get() == "class"
    assert mug.GetAttribute("semantic:Semantics:params:semanticData").Get() == "Cup"
    assert class_labels(stage, "/World/Zorblax") == []
    assert "left out" in grounded.summary


def test_the_ontology_is_an_argument(core, stage, tmp_path):
    ontology = tmp_path / "tiny.ttl"
    ontology.write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        "<http://x.org/o> a owl:Ontology . <http://x.org/o#Vessel> a owl:Class ; rdfs:label 'mug'@en .\n"
        "<http://x.org/o#Board> a owl:Class ; rdfs:label 'table'@en .\n",
        "utf-8",
    )
    core.ground_stage(stage, ontology)
    assert class_labels(stage, "/World/Mug") == ["Vessel"]


@pytest.mark.parametrize(
    ("setting", "message"),
    [({"mode": "all"}, "mode all: expected one of new, overwrite, skip"), ({"encodings": "rdf"}, "encodings rdf: exp")],
)
def test_invalid_settings(core, stage, setting, message):
    with pytest.raises(OutputError, match=message):
        core.ground_stage(stage, settings=core.LabelSettings(**setting))


def test_a_stage_without_objects(core):
    with pytest.raises(SceneError):
        core.ground_stage(Usd.Stage.CreateInMemory())


# Extension


class Kit:
    """Records what the extension does to Kit."""

    def __init__(self, stage):
        self.stage = stage
        self.settings = {}
        self.actions, self.menus, self.messages = {}, [], []

    def click(self, title):
        """Run the action of a menu item."""
        items = {item.name: item for menu, _ in self.menus for top in menu for item in top.sub_menu}
        self.actions[items[title].onclick_action]()

    def deregister(self, extension):
        for key in [key for key in self.actions if key[0] == extension]:
            del self.actions[key]


class FakeItem(SimpleNamespace):
    """Stands in for `MenuItemDescription`."""

    def __init__(self, name, onclick_action=None, sub_menu=None):
        super().__init__(name=name, onclick_action=onclick_action, sub_menu=sub_menu)


async def next_frame():
    await asyncio.sleep(0)


@pytest.fixture
def kit(monkeypatch, stage):
    kit = Kit(stage)
    registry = SimpleNamespace(
        register_action=lambda ext, name, run, **_: kit.actions.__setitem__((ext, name), run),
        deregister_all_actions_for_extension=kit.deregister,
    )
    menu_utils = {
        "MenuItemDescription": FakeItem,
        "add_menu_items": lambda items, name: kit.menus.append((items, name)),
        "remove_menu_items": lambda items, name: kit.menus.remove((items, name)),
    }
    post = {
        "NotificationStatus": SimpleNamespace(INFO="info", WARNING="warning"),
        "post_notification": lambda text, status: kit.messages.append((status, text)),
    }
    fakes = {
        "carb": {"log_info": lambda _: None, "log_warn": lambda _: None},
        "carb.settings": {"get_settings": lambda: SimpleNamespace(get=kit.settings.get)},
        "omni": {},
        "omni.ext": {"IExt": type("IExt", (), {})},
        "omni.kit": {},
        "omni.kit.actions": {},
        "omni.kit.actions.core": {"get_action_registry": lambda: registry},
        "omni.kit.app": {"get_app": lambda: SimpleNamespace(next_update_async=next_frame)},
        "omni.kit.menu": {},
        "omni.kit.menu.utils": menu_utils,
        "omni.kit.notification_manager": post,
        "omni.usd": {"get_context": lambda: SimpleNamespace(get_stage=lambda: kit.stage)},
    }
    for name, contents in fakes.items():
        module = ModuleType(name)
        vars(module).update(contents)
        monkeypatch.setitem(sys.modules, name, module)
        parent, _, child = name.rpartition(".")
        if parent:
            setattr(sys.modules[parent], child, module)
    return kit


@pytest.fixture
def extension(kit, _importable):
    extension = importlib.import_module("usd2kg_omni.extension").Usd2kgExtension()
    extension.on_startup("usd2kg.omni-0.1.0")
    return extension


def run(extension, kit, title="Ground this stage"):
    """Click a menu item, and wait for the task that it starts."""

    async def click():
        kit.click(title)
        await extension._task

    asyncio.run(click())


def test_startup_registers_and_shutdown_unregisters(extension, kit):
    ((menu, name),) = kit.menus
    assert (name, menu[0].name, [item.name for item in menu[0].sub_menu]) == (
        "Tools",
        "usd2kg",
        ["Ground this stage", "Remove the labels"],
    )
    assert kit.actions.keys() == {item.onclick_action for item in menu[0].sub_menu}
    extension.on_shutdown()
    assert (kit.menus, kit.actions) == ([], {})


def test_the_menu_labels_the_open_stage(extension, kit):
    before = kit.stage.GetRootLayer().ExportToString()
    run(extension, kit)
    assert class_labels(kit.stage, "/World/Mug") == ["Cup"]
    assert kit.stage.GetRootLayer().ExportToString() == before
    statuses, texts = zip(*kit.messages, strict=True)
    assert set(statuses) == {"info"}
    assert texts[:2] == ("usd2kg: reading the stage…", "usd2kg: finding the classes of 3 objects…")
    assert " labelled" in texts[2]
    kit.click("Remove the labels")
    kit.click("Remove the labels")
    assert class_labels(kit.stage, "/World/Mug") == []
    assert [text for _, text in kit.messages[-2:]] == [
        "usd2kg: the labels are removed",
        "usd2kg: the stage has no labels of usd2kg",
    ]


def test_settings_of_kit_are_read(extension, kit):
    kit.settings |= {"/exts/usd2kg.omni/encodings": "isaac", "/exts/usd2kg.omni/min_confidence": 0}
    run(extension, kit)
    mug = kit.stage.GetPrimAtPath("/World/Mug")
    assert mug.GetAttribute("semantic:Semantics:params:semanticData").Get() == "Cup"
    assert class_labels(kit.stage, "/World/Mug") == []


def test_errors_are_shown_not_raised(extension, kit):
    kit.settings["/exts/usd2kg.omni/mode"] = "all"
    run(extension, kit)
    kit.stage = None
    run(extension, kit)
    kit.click("Remove the labels")
    assert kit.messages == [
        ("warning", "usd2kg: mode all: expected one of new, overwrite, skip"),
        ("warning", "usd2kg: no stage is open"),
        ("warning", "usd2kg: no stage is open"),
    ]


def test_one_task_at_a_time_and_shutdown_stops_it(extension, kit):
    async def click_twice():
        kit.click("Ground this stage")
        task = extension._task
        kit.click("Ground this stage")
        assert kit.messages[-1] == ("warning", "usd2kg: the stage is being grounded already")
        extension.on_shutdown()
        with pytest.raises(asyncio.CancelledError):
            await task

    asyncio.run(click_twice())
    assert class_labels(kit.stage, "/World/Mug") == []


def test_a_stage_that_was_replaced_meanwhile_is_left_alone(extension, kit, monkeypatch):
    module = importlib.import_module("usd2kg_omni.extension")
    first, second = kit.stage, Usd.Stage.CreateInMemory()
    ground_objects = module.ground_objects

    def replace_stage(*arguments):
        kit.stage = second
        return ground_objects(*arguments)

    monkeypatch.setattr(module, "ground_objects", replace_stage)
    run(extension, kit)
    assert kit.messages[-1] == ("warning", "usd2kg: another stage was opened meanwhile; nothing is labelled")
    assert list(first.GetSessionLayer().subLayerPaths) == []


# Configuration


def test_the_configuration_names_what_is_used(kit, core):
    (module,) = CONFIG["python"]["module"]
    assert hasattr(importlib.import_module(module["name"]), "Usd2kgExtension")
    assert core.LabelSettings(**CONFIG["settings"]["exts"]["usd2kg.omni"]) == core.LabelSettings()
    assert len(CONFIG["python"]["pipapi"]["requirements"]) == len(CONFIG["python"]["pipapi"]["modules"])


def test_the_core_needs_only_the_packages_that_kit_installs(write_stage):
    program = (
        "import sys; from pxr import Usd; import usd2kg_omni.core as core\n"
        "core.ground_stage(Usd.Stage.Open(sys.argv[1]))\n"
        "files = {n: getattr(m, '__file__', None) or '' for n, m in sys.modules.items() if '.' not in n}\n"
        "print(*sorted(n for n, file in files.items() if 'site-packages' in file and not n.startswith('_')))"
    )
    env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(FOLDER), *filter(None, sys.path)])}
    command = [sys.executable, "-c", program, str(write_stage(SCENE))]
    loaded = subprocess.run(command, check=True, capture_output=True, text=True, env=env).stdout.split()
    # numpy and OpenUSD are Kit's own.
    assert set(loaded) - {"numpy", "pxr", "usd2kg"} <= set(CONFIG["python"]["pipapi"]["modules"])
