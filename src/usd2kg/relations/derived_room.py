"""A room without a prim, derived from walls or floors."""

from dataclasses import dataclass

__all__ = ["DerivedRoom"]

Ring = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class DerivedRoom:
    """A room without a prim."""

    name: str
    """Unique in the scene: `room 1`, or `kitchen` after a floor that is named so."""
    rule: str
    """Id of the rule in `knowledge/spatial.toml`: from walls, or from floors."""
    outline: tuple[Ring, ...]
    """The outer ring, counter-clockwise, then holes, clockwise; metres, world frame, first corner not repeated."""
    area: float
    """Square metres of free floor between the walls."""
    height: float
    """Metres, z of the floor."""
    confidence: float
    """Share of its border that is wall, door, window or the end of a floor; the rest is openings taken to be closed."""
