"""The options for reading a stage."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle

if TYPE_CHECKING:
    from usd2kg.scene import ReadOptions

__all__ = ["MetresPerUnit", "StageOptions", "TimeCode", "UpAxis"]

MetresPerUnit = Annotated[
    float | None, Option("--metres-per-unit", help="Metres per stage unit; default: as authored.")
]
UpAxis = Annotated[str | None, Option("--up-axis", help="Up axis, Y or Z; default: as authored.")]
TimeCode = Annotated[
    float | None, Option("--time", help="Time code to read; default: the earliest sample of each attribute.")
]


@dataclass(frozen=True)
class StageOptions(OptionBundle):
    """Units, time code and object selection."""

    metres_per_unit: MetresPerUnit = None
    up_axis: UpAxis = None
    time_code: TimeCode = None
    expand_instancers: Annotated[
        bool, Option("--expand-instancers", help="Make every instance of a point instancer an object.")
    ] = False
    include: Annotated[
        list[str] | None,
        Option(
            "--include", help="Path pattern (* within a name, ** across names): matching prims are objects. Repeatable."
        ),
    ] = None
    exclude: Annotated[
        list[str] | None,
        Option("--exclude", help="Path pattern: matching prims and their descendants are not objects. Repeatable."),
    ] = None
    kind: Annotated[
        list[str] | None,
        Option("--kind", help="Model kind of the prims that are objects; default: component. Repeatable."),
    ] = None
    objects: Annotated[
        Path | None,
        Option(
            "--objects", help="CSV file with a column path: exactly these prims are objects; default: by the rules."
        ),
    ] = None
    every_prim: Annotated[
        bool, Option("--every-prim", help="Make every prim with geometry, its own or below it, an object.")
    ] = False

    def read_options(self) -> "ReadOptions":
        """Return the options of `read_scene`.

        Raises:
            GroundingError: the list of objects cannot be read.
        """
        from usd2kg.grounding import read_paths  # noqa: PLC0415
        from usd2kg.scene import ReadOptions, SelectionOverrides  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        return ReadOptions(
            metres_per_unit=self.metres_per_unit,
            up_axis=self.up_axis,
            time=self.time_code,
            expand_instancers=self.expand_instancers,
            selection=SelectionOverrides(
                include=tuple(self.include or ()),
                exclude=tuple(self.exclude or ()),
                kinds=tuple(self.kind or ()),
                only=tuple(read_paths(self.objects)) if self.objects is not None else (),
                is_every_prim=self.every_prim,
            ),
        )
