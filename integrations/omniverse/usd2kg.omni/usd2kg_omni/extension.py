"""The extension: menu items, messages, and a task that does not block the window while it grounds."""

import asyncio
from typing import Any

import carb
import carb.settings
import omni.ext
import omni.kit.actions.core
import omni.kit.app
import omni.kit.menu.utils
import omni.usd
from omni.kit.menu.utils import MenuItemDescription
from omni.kit.notification_manager import NotificationStatus, post_notification

from usd2kg.errors import Usd2kgError
from usd2kg_omni.core import LabelSettings, ground_objects, label_objects, read_objects, remove_labels

__all__ = ["Usd2kgExtension"]

_NAME = "usd2kg.omni"
_MENU = "Tools"


class Usd2kgExtension(omni.ext.IExt):  # type: ignore[misc]
    """Adds *Tools/usd2kg* with the items *Ground this stage* and *Remove the labels*."""

    def on_startup(self, ext_id: str) -> None:
        """Register the actions and the menu."""
        self._task: asyncio.Task[None] | None = None
        actions = omni.kit.actions.core.get_action_registry()
        items = []
        for action, title, run in (
            ("ground_stage", "Ground this stage", self._start_grounding),
            ("remove_labels", "Remove the labels", self._remove_labels),
        ):
            actions.register_action(_NAME, action, run, display_name=f"usd2kg->{title}", description=title)
            items.append(MenuItemDescription(name=title, onclick_action=(_NAME, action)))
        # Kit keeps no reference to the items.
        self._menu: list[Any] | None = [MenuItemDescription(name="usd2kg", sub_menu=items)]
        omni.kit.menu.utils.add_menu_items(self._menu, _MENU)

    def on_shutdown(self) -> None:
        """Stop a task in progress, and remove the menu and the actions. Labels stay on the stage."""
        if self._task is not None:
            self._task.cancel()
            self._task = None
        if self._menu is not None:
            omni.kit.menu.utils.remove_menu_items(self._menu, _MENU)
            self._menu = None
        omni.kit.actions.core.get_action_registry().deregister_all_actions_for_extension(_NAME)

    def _start_grounding(self) -> None:
        if self._task is not None and not self._task.done():
            _warn("the stage is being grounded already")
            return
        self._task = asyncio.ensure_future(_ground_open_stage())

    def _remove_labels(self) -> None:
        stage = omni.usd.get_context().get_stage()
        if stage is None:
            _warn("no stage is open")
        elif remove_labels(stage):
            _inform("the labels are removed")
        else:
            _inform("the stage has no labels of usd2kg")


async def _ground_open_stage() -> None:
    """Ground the open stage and report the result or the error."""
    context = omni.usd.get_context()
    stage = context.get_stage()
    if stage is None:
        _warn("no stage is open")
        return
    settings = _read_settings()
    try:
        # An invalid setting is reported before the work.
        _ = settings.label_options
        _inform("reading the stage…")
        # The message appears with the next frame.
        await omni.kit.app.get_app().next_update_async()
        scene = read_objects(stage)
        _inform(f"finding the classes of {len(scene.objects)} objects…")
        # The stage may be read and edited in this thread only; the records need no stage.
        loop = asyncio.get_running_loop()
        objects = await loop.run_in_executor(None, ground_objects, scene, settings.ontology or None)
        if context.get_stage() != stage:
            _warn("another stage was opened meanwhile; nothing is labelled")
            return
        _inform(label_objects(stage, objects, settings).summary)
    except Usd2kgError as error:
        _warn(str(error))


def _read_settings() -> LabelSettings:
    settings = carb.settings.get_settings()
    default = LabelSettings()

    def value(name: str) -> Any:
        found = settings.get(f"/exts/{_NAME}/{name}")
        return getattr(default, name) if found is None else found

    return LabelSettings(value("ontology"), value("encodings"), value("mode"), float(value("min_confidence")))


def _inform(message: str) -> None:
    carb.log_info(f"usd2kg: {message}")
    post_notification(f"usd2kg: {message}", status=NotificationStatus.INFO)


def _warn(message: str) -> None:
    carb.log_warn(f"usd2kg: {message}")
    post_notification(f"usd2kg: {message}", status=NotificationStatus.WARNING)
