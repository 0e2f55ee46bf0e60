"""The plugin container: the menu *usd2kg* of usdview."""

import os
from collections.abc import Callable
from typing import Any

from pxr.Usdviewq.plugin import PluginContainer

from usd2kg.errors import Usd2kgError
from usd2kg_usdview.core import GroundedStage, color_by_class, ground_stage, reset_colors
from usd2kg_usdview.pages import legend_page, object_page

__all__ = ["Usd2kgPluginContainer"]

_MENU = "usd2kg"


class Usd2kgPluginContainer(PluginContainer):  # type: ignore[misc]
    """Adds *Color by class*, *Reset colors* and *Object page*.

    The ontology is the OWL file in the environment variable USD2KG_ONTOLOGY, else the built-in one that suits the
    stage.
    """

    def registerPlugins(self, plugRegistry: Any, usdviewApi: Any) -> None:  # noqa: N802, N803 - names of usdview
        """Register the commands."""
        self._grounded: tuple[Any, GroundedStage] | None = None
        self._had_materials: bool | None = None
        self._dialogs: list[Any] = []
        commands = (
            ("color_by_class", "Color by class", self._color_by_class, "Ground the objects and colour them by class"),
            ("reset_colors", "Reset colors", self._reset_colors, "Remove the colours"),
            ("object_page", "Object page", self._show_object, "Show what is known about the selected object"),
        )
        self._commands = [
            plugRegistry.registerCommandPlugin(f"Usd2kg.{name}", title, _with_messages(run), help_text)
            for name, title, run, help_text in commands
        ]

    def configureView(self, plugRegistry: Any, plugUIBuilder: Any) -> None:  # noqa: N802, N803 - names of usdview
        """Add the commands to the menu."""
        menu = plugUIBuilder.findOrCreateMenu(_MENU)
        for command in self._commands:
            menu.addItem(command)

    def _color_by_class(self, api: Any) -> None:
        grounded = self._ground(api)
        coloring = color_by_class(api.stage, grounded)
        view = api.dataModel.viewSettings
        if self._had_materials is None:
            self._had_materials = view.enableSceneMaterials
        # A material hides the display colour.
        view.enableSceneMaterials = False
        api.UpdateViewport()
        self._show(api, "usd2kg: classes", legend_page(coloring))

    def _reset_colors(self, api: Any) -> None:
        was_colored = reset_colors(api.stage)
        if self._had_materials is not None:
            api.dataModel.viewSettings.enableSceneMaterials = self._had_materials
            self._had_materials = None
        api.UpdateViewport()
        api.PrintStatus("usd2kg: the colours are reset" if was_colored else "usd2kg: the stage has no colours to reset")

    def _show_object(self, api: Any) -> None:
        prim = api.prim
        if prim is None or not prim or prim.IsPseudoRoot():
            api.PrintStatus("usd2kg: select a prim first")
            return
        if self._grounded is None or self._grounded[0] != api.stage:
            self._ground(api)
        assert self._grounded is not None, "just grounded"
        self._show(api, "usd2kg: object", object_page(self._grounded[1], str(prim.GetPath())))

    def _ground(self, api: Any) -> GroundedStage:
        api.PrintStatus("usd2kg: grounding the objects…")
        grounded = ground_stage(api.stage, os.environ.get("USD2KG_ONTOLOGY") or None)
        self._grounded = api.stage, grounded
        return grounded

    def _show(self, api: Any, title: str, html: str) -> None:
        from usd2kg_usdview.dialog import open_dialog  # noqa: PLC0415 - loads Qt

        # Without a reference, Python would collect an open dialog.
        self._dialogs = [dialog for dialog in self._dialogs if dialog.isVisible()]
        self._dialogs.append(open_dialog(api.qMainWindow, title, html))


def _with_messages(run: Callable[[Any], None]) -> Callable[[Any], None]:
    """Return a command that reports errors of usd2kg in the status line."""

    def command(api: Any) -> None:
        try:
            run(api)
        except Usd2kgError as error:
            api.PrintStatus(f"usd2kg: {error}")

    return command
