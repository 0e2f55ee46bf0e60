"""What a user can say about how a stage is to be read."""

from dataclasses import dataclass, field

from usd2kg.errors import SceneError

__all__ = ["ReadOptions", "SelectionOverrides"]


@dataclass(frozen=True, slots=True)
class SelectionOverrides:
    """Changes to which prims are objects; what is left empty changes nothing."""

    include: tuple[str, ...] = ()
    """Path patterns (`*` within a name, `**` across names): these prims are objects whatever the rules say."""
    exclude: tuple[str, ...] = ()
    """Path patterns: these prims, and all below them, are no objects."""
    kinds: tuple[str, ...] = ()
    """Model kinds whose prims are objects, instead of `component`."""
    only: tuple[str, ...] = ()
    """Paths: just these prims are objects."""
    is_every_prim: bool = False
    """Every prim that is or holds visible geometry is an object."""


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """How a stage is read; the defaults are what the stage itself says."""

    metres_per_unit: float | None = None
    """Length of a stage unit in metres, instead of the authored one."""
    up_axis: str | None = None
    """`Y` or `Z`, instead of the authored one."""
    time: float | None = None
    """Time code to read; by default the earliest sample of each attribute."""
    expand_instancers: bool = False
    """Make an object of each copy of a point instancer, instead of one for all."""
    selection: SelectionOverrides = field(default_factory=SelectionOverrides)

    def __post_init__(self) -> None:
        if self.metres_per_unit is not None and not 0 < self.metres_per_unit < float("inf"):
            raise SceneError(f"metres per unit is {self.metres_per_unit!r}; expected a positive number, like 0.01")
        if self.up_axis not in {None, "Y", "Z"}:
            raise SceneError(f"up axis is {self.up_axis!r}; expected Y or Z")
