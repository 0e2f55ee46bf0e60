"""Thresholds and class lists of the relation rules, one class per section of `knowledge/spatial.toml`."""

from typing import NamedTuple

__all__ = [
    "AboveRule",
    "AttachedRule",
    "BetweenRule",
    "BlockingRule",
    "ClassLists",
    "ConnectsRule",
    "HoveringRule",
    "InsideRule",
    "NearRule",
    "NextToRule",
    "ObjectGeometry",
    "OnRule",
    "OnSeveralRule",
    "PartOfRule",
    "RelationRules",
    "RoomPlanRule",
    "RoomRule",
    "SideRule",
    "StandingInRule",
    "TouchingRule",
]

# knowledge/spatial.toml documents each field beside its value: unit, meaning and origin.


class ObjectGeometry(NamedTuple):
    """Feet, sheets and broad tops of objects."""

    foot_height: float
    sheet_thickness: float
    min_broad_ratio: float


class BlockingRule(NamedTuple):
    """When a third object is between two others."""

    min_distance: float
    min_fill_ratio: float
    most: int


class OnRule(NamedTuple):
    """`on` one anchor."""

    rule: str
    min_overlap_ratio: float
    max_area_ratio: float
    gap_share: float
    min_gap: float
    max_gap: float
    sink_share: float
    cover_ratio: float
    max_sink: float


class OnSeveralRule(NamedTuple):
    """`on` several anchors."""

    rule: str
    min_anchors: int
    min_anchor_ratio: float


class HoveringRule(NamedTuple):
    """`on` an anchor below a small gap."""

    rule: str
    max_gap: float
    min_overlap_ratio: float
    min_touching_ratio: float


class InsideRule(NamedTuple):
    """`inside` an enclosing anchor."""

    rule: str
    surrounded_rule: str
    min_volume_ratio: float
    max_floor_share: float
    min_below: float
    min_beside: float
    min_caged: float
    min_surrounded: float
    min_walled: float
    min_cavity_depth: float
    max_front_share: float
    max_buried: float


class StandingInRule(NamedTuple):
    """`inside` an open container, protruding at its top."""

    rule: str
    min_depth_share: float
    min_beside: float
    min_rooted_share: float
    max_root_ratio: float
    min_overlap_ratio: float
    min_level_overlap_ratio: float
    same_level: float
    max_area_ratio: float


class AttachedRule(NamedTuple):
    """`attached-to`."""

    rule: str
    max_gap: float
    max_contact: float
    max_touch: float
    min_interlock: float
    min_hold: float
    max_hanging_gap: float
    mount_preference: float
    min_bearing_ratio: float
    min_backed: float
    min_weak_share: float
    min_borne: float
    min_clearance: float
    max_plinth: float
    ground_reach: float
    max_loose_floor: float
    max_wall_thickness: float
    min_lead_slenderness: float


class AboveRule(NamedTuple):
    """`above` and `below`."""

    rule: str
    min_gap: float
    min_overlap_ratio: float
    most: int


class TouchingRule(NamedTuple):
    """`touching`."""

    rule: str
    max_gap: float
    max_sink: float
    min_face_share: float
    most: int


class NextToRule(NamedTuple):
    """`next-to`."""

    rule: str
    gap_share: float
    min_gap: float
    max_gap: float
    min_height_share: float
    max_overlap_ratio: float
    most: int


class NearRule(NamedTuple):
    """`near`."""

    rule: str
    gap_share: float
    min_gap: float
    max_gap: float
    most: int


class BetweenRule(NamedTuple):
    """`between`."""

    rule: str
    gap_share: float
    min_gap: float
    max_gap: float
    min_hull_ratio: float
    min_height_share: float
    max_overlap_ratio: float
    most: int


class SideRule(NamedTuple):
    """`left`, `right`, `front` and `behind`."""

    rule: str
    tolerance_deg: float
    min_height_share: float
    most: int


class RoomRule(NamedTuple):
    """`room`."""

    rule: str
    group_rule: str
    min_side: float
    min_height: float
    clear_margin: float
    words: tuple[str, ...]


class RoomPlanRule(NamedTuple):
    """Rooms where no prim is a room, from walls and floors."""

    rule: str
    floor_rule: str
    cell: float
    max_cells: int
    cut_height: float
    sill_height: float
    lintel_height: float
    top_margin: float
    max_thickness: float
    max_opening: float
    max_gap: float
    min_jamb_wall: float
    min_storey: float
    min_side: float
    min_area: float
    min_door_height: float
    min_window_height: float
    samples: int
    reach: float
    min_share: float


class ConnectsRule(NamedTuple):
    """`connects`."""

    rule: str
    reach: float
    samples: int
    min_share: float
    max_gap: float


class PartOfRule(NamedTuple):
    """`part-of`."""

    stated_rule: str
    tree_rule: str
    fitted_rule: str
    max_gap: float
    min_slid_in: float
    min_covered: float
    min_shut: float
    max_shelf_gap: float
    min_hinge: float
    max_hinge_gap: float
    min_raised: float
    max_leaning: float
    min_beneath: float
    min_upright: float
    directions: tuple[str, ...]
    faces: tuple[str, ...]
    forms: tuple[str, ...]
    skeletons: tuple[str, ...]
    prepositions: tuple[str, ...]


class ClassLists(NamedTuple):
    """Lists of class IRIs or CURIEs; a leading `=` excludes subclasses."""

    not_placed: tuple[str, ...]
    not_laid: tuple[str, ...]
    cases: tuple[str, ...]
    tools: tuple[str, ...]
    not_supporting: tuple[str, ...]
    not_bearing: tuple[str, ...]
    covers: tuple[str, ...]
    grounds: tuple[str, ...]
    walls: tuple[str, ...]
    mounts: tuple[str, ...]
    not_mounts: tuple[str, ...]
    not_attached: tuple[str, ...]
    standing: tuple[str, ...]
    hanging: tuple[str, ...]
    not_contained: tuple[str, ...]
    containers: tuple[str, ...]
    not_containers: tuple[str, ...]
    closed: tuple[str, ...]
    not_neighbours: tuple[str, ...]
    rooms: tuple[str, ...]
    spaces: tuple[str, ...]
    room_walls: tuple[str, ...]
    doors: tuple[str, ...]
    windows: tuple[str, ...]
    components: tuple[str, ...]
    not_wholes: tuple[str, ...]
    fronts: tuple[str, ...]
    bodies: tuple[str, ...]
    front_concepts: tuple[str, ...]
    handle_concepts: tuple[str, ...]
    front_fittings: tuple[str, ...]
    shelves: tuple[str, ...]
    lids: tuple[str, ...]
    casters: tuple[str, ...]
    fittings: tuple[str, ...]
    lamp_parts: tuple[str, ...]
    lamps: tuple[str, ...]
    frames: tuple[str, ...]
    fasteners: tuple[str, ...]
    handles: tuple[str, ...]
    containment_disposition: str


class RelationRules(NamedTuple):
    """All thresholds and class lists, one field per section of `knowledge/spatial.toml`."""

    geometry: ObjectGeometry
    blocking: BlockingRule
    on: OnRule
    on_several: OnSeveralRule
    hovering: HoveringRule
    inside: InsideRule
    standing_in: StandingInRule
    attached: AttachedRule
    above: AboveRule
    touching: TouchingRule
    next_to: NextToRule
    near: NearRule
    between: BetweenRule
    side: SideRule
    room: RoomRule
    room_plan: RoomPlanRule
    connects: ConnectsRule
    part_of: PartOfRule
    classes: ClassLists
