"""Options of reading a stage."""

from dataclasses import dataclass, field

from usd2kg.errors import SceneError

__all__ = ["ReadOptions", "SelectionOverrides"]


@dataclass(frozen=True, slots=True)
class SelectionOverrides:
    """Overrides of the rules that select objects."""

    include: tuple[str, ...] = ()
    """Path patterns (`*` within a name, `**` across names) of prims that are objects regardless of the rules."""
    exclude: tuple[str, ...] = ()
    """Path patterns of prims that, with all prims below them, are not objects."""
    kinds: tuple[str, ...] = ()
    """Model kinds of objects, instead of `component`."""
    only: tuple[str, ...] = ()
    """Paths of the objects; if given, the rules and the other overrides are ignored."""
    is_every_prim: bool = False
    """Whether every prim that is or contains visible geometry is an object."""


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """How a stage is read; by default as authored."""

    metres_per_unit: float | None = None
    """Length of a stage unit in metres; overrides the authored one."""
    up_axis: str | None = None
    """`Y` or `Z`; overrides the authored one."""
    time: float | None = None
    """Time code to read; by default the earliest sample of each attribute."""
    expand_instancers: bool = False
    """Whether each copy of a point instancer is an object, instead of one object for all copies."""
    selection: SelectionOverrides = field(default_factory=SelectionOverrides)

    def __post_init__(self) -> None:
        if self.metres_per_unit is not None and not 0 < self.metres_per_unit < float("inf"):
            raise SceneError(f"metres per unit is {self.metres_per_unit!r}; expected a positive number, like 0.01")
        if self.up_axis not in {None, "Y", "Z"}:
            raise SceneError(f"up axis is {self.up_axis!r}; expected Y or Z")
