"""The thresholds and class lists of the rules, section by section as in `data/spatial.toml`."""

from dataclasses import dataclass, field

__all__ = [
    "AboveRule",
    "BetweenRule",
    "ClassLists",
    "HoveringRule",
    "InsideRule",
    "NearRule",
    "NextToRule",
    "OnRule",
    "OnSeveralRule",
    "PartOfRule",
    "RelationRules",
    "RoomRule",
    "SideRule",
    "StandingInRule",
    "TouchingRule",
]

# The fields are described in data/spatial.toml, beside the values.


@dataclass(frozen=True, slots=True)
class OnRule:
    """Resting on one thing."""

    rule: str
    min_overlap_ratio: float
    max_area_ratio: float
    gap_share: float
    min_gap: float
    max_gap: float
    sink_share: float
    max_sink: float


@dataclass(frozen=True, slots=True)
class OnSeveralRule:
    """Resting on several things."""

    rule: str
    min_anchors: int
    min_anchor_ratio: float


@dataclass(frozen=True, slots=True)
class HoveringRule:
    """Resting on nothing, but close over something."""

    rule: str
    max_gap: float
    min_overlap_ratio: float
    max_wall_gap: float
    max_wall_thickness: float


@dataclass(frozen=True, slots=True)
class InsideRule:
    """Being enclosed."""

    rule: str
    min_volume_ratio: float
    max_floor_share: float


@dataclass(frozen=True, slots=True)
class StandingInRule:
    """Being in something open and sticking out."""

    rule: str
    min_depth_share: float
    min_overlap_ratio: float
    min_level_overlap_ratio: float
    same_level: float
    max_area_ratio: float


@dataclass(frozen=True, slots=True)
class AboveRule:
    """Being above something."""

    rule: str
    min_gap: float
    min_overlap_ratio: float
    most: int


@dataclass(frozen=True, slots=True)
class TouchingRule:
    """Meeting in a face."""

    rule: str
    max_gap: float
    max_sink: float
    min_face_share: float
    most: int


@dataclass(frozen=True, slots=True)
class NextToRule:
    """Being side by side."""

    rule: str
    gap_share: float
    min_gap: float
    max_gap: float
    min_height_share: float
    most: int


@dataclass(frozen=True, slots=True)
class NearRule:
    """Being close in any direction."""

    rule: str
    gap_share: float
    min_gap: float
    max_gap: float
    most: int


@dataclass(frozen=True, slots=True)
class BetweenRule:
    """Being between two things."""

    rule: str
    gap_share: float
    min_gap: float
    max_gap: float
    min_hull_ratio: float
    min_height_share: float
    max_overlap_ratio: float
    most: int


@dataclass(frozen=True, slots=True)
class SideRule:
    """Left, right, front and behind."""

    rule: str
    tolerance_deg: float
    min_height_share: float
    most: int


@dataclass(frozen=True, slots=True)
class RoomRule:
    """Which room a thing is in."""

    rule: str
    group_rule: str
    min_side: float
    min_height: float
    clear_margin: float
    words: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class PartOfRule:
    """Being a part."""

    stated_rule: str
    tree_rule: str
    fitted_rule: str
    max_gap: float


@dataclass(frozen=True, slots=True)
class ClassLists:
    """Lists of IRIs or CURIEs of classes; `=` before one leaves its subclasses out."""

    not_placed: tuple[str, ...]
    not_laid: tuple[str, ...]
    not_supporting: tuple[str, ...]
    not_bearing: tuple[str, ...]
    walls: tuple[str, ...]
    not_contained: tuple[str, ...]
    containers: tuple[str, ...]
    not_containers: tuple[str, ...]
    closed: tuple[str, ...]
    not_neighbours: tuple[str, ...]
    rooms: tuple[str, ...]
    components: tuple[str, ...]
    not_wholes: tuple[str, ...]
    fronts: tuple[str, ...]
    bodies: tuple[str, ...]
    handles: tuple[str, ...]
    containment_disposition: str


@dataclass(frozen=True, slots=True)
class RelationRules:
    """All thresholds and lists, a section of `data/spatial.toml` each."""

    on: OnRule
    on_several: OnSeveralRule
    hovering: HoveringRule
    inside: InsideRule
    standing_in: StandingInRule
    above: AboveRule
    touching: TouchingRule
    next_to: NextToRule
    near: NearRule
    between: BetweenRule
    side: SideRule
    room: RoomRule
    part_of: PartOfRule
    classes: ClassLists = field(repr=False)
