"""Select the prims that are objects: what a person would point at and name.

In order of precedence: the authored model hierarchy, rigid bodies, asset boundaries (references, payloads, instances),
and for all other geometry its nearest ancestor that is not a mere grouping. The rules only see the outline, and boxes
and labels where names do not tell a group from an object.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from usd2kg.knowledge import word_set
from usd2kg.scene.fixtures import find_fixtures
from usd2kg.scene.options import SelectionOverrides
from usd2kg.scene.outline import Outline, PrimRecord
from usd2kg.scene.piece_boxes import Measure
from usd2kg.scene.robots import merge_robots
from usd2kg.scene.sets_of_objects import ReadClasses, SetFinder, is_room_name
from usd2kg.scene.unnamed_pieces import is_unnamed, merge_unnamed_pieces
from usd2kg.words import split_identifier

__all__ = ["ASKED_FOR", "Selection", "explain", "path_pattern", "select_objects"]

ASKED_FOR = "asked for by path"
"""The reason of an object that was requested by path, and not selected by the rules."""
_ASSET = "asset boundary (reference, payload or instance)"
_BODY = "rigid body"
_COMPONENT = "component"
_STRUCTURE_KINDS = frozenset({"assembly", "group"})
_GROUPING_WORDS = word_set("scene", "grouping_words")
_MIN_NESTED = 2
"""Least number of nested assets or models that make a referenced prim a set of objects."""
_MAX_LISTED = 3
"""Objects that an explanation lists."""


@dataclass(frozen=True)
class Selection:
    """The prims that are objects, and the reasons of the others."""

    chosen: dict[str, str]
    """Prim path → reason, in traversal order."""
    left_out: Counter[str]
    """Reason → number of prims that are not objects."""
    missing: tuple[str, ...]
    """Requested paths that are not in the outline."""


def select_objects(
    outline: Outline,
    overrides: SelectionOverrides,
    measure: Measure,
    read_classes: ReadClasses,
    wanted: tuple[str, ...] = (),
) -> Selection:
    """Return the prims of `outline` that are objects, each with the reason.

    Args:
        outline: the prims of the stage.
        overrides: changes to the rules.
        measure: returns the box of a prim.
        read_classes: returns the labels of a prim that state its class.
        wanted: paths of prims that are objects regardless of rules and overrides.
    """
    candidates = _apply_overrides(outline, overrides, measure, read_classes)
    known = {record.path for record in outline.records}
    for path in wanted:
        if path in known:
            candidates.setdefault(path, ASKED_FOR)
    chosen = {record.path: candidates[record.path] for record in outline.records if record.path in candidates}
    missing = tuple(path for path in wanted if path not in known)
    return Selection(chosen, _count_left_out(outline, chosen), missing)


def _apply_overrides(
    outline: Outline, overrides: SelectionOverrides, measure: Measure, read_classes: ReadClasses
) -> dict[str, str]:
    records = outline.records
    if overrides.only:
        only = frozenset(overrides.only)
        return {record.path: "listed by the user" for record in records if record.path in only}
    if overrides.is_every_prim:
        candidates = {record.path: "every prim with geometry was asked for" for record in records if record.gprim_count}
    else:
        candidates = _by_rules(outline, frozenset(overrides.kinds or {_COMPONENT}), measure, read_classes)
    included = [path_pattern(pattern) for pattern in overrides.include]
    for record in records if included else ():
        if any(pattern.fullmatch(record.path) for pattern in included):
            candidates[record.path] = "included by a pattern of the user"
    if overrides.exclude:
        _exclude(outline, candidates, [path_pattern(pattern) for pattern in overrides.exclude])
    return candidates


def _exclude(outline: Outline, candidates: dict[str, str], excluded: list[re.Pattern[str]]) -> None:
    # (record, below an excluded one)
    pending = [(child, False) for child in outline.root.children]
    while pending:
        record, is_excluded = pending.pop()
        is_excluded = is_excluded or any(pattern.fullmatch(record.path) for pattern in excluded)
        if is_excluded:
            candidates.pop(record.path, None)
        pending.extend((child, is_excluded) for child in record.children)


def path_pattern(pattern: str) -> re.Pattern[str]:
    """Return the regular expression of a path pattern: `*` and `?` match within a name, `**` across names.

    >>> bool(path_pattern("/World/**/Cup_*").fullmatch("/World/Table/Cup_1"))
    True
    >>> bool(path_pattern("/World/Cup_*").fullmatch("/World/Cup_1/mesh"))
    False
    """
    pieces = {"**/": "(?:[^/]+/)*", "**": ".*", "*": "[^/]*", "?": "[^/]"}
    parts = re.split(r"(\*\*/|\*\*|\*|\?)", pattern)
    return re.compile("".join(pieces.get(part, re.escape(part)) for part in parts))


def _by_rules(outline: Outline, kinds: frozenset[str], measure: Measure, read_classes: ReadClasses) -> dict[str, str]:
    sets = SetFinder(measure, read_classes)
    candidates = _model_candidates(outline, kinds, sets)
    _drop_whole_scene(outline.root, candidates)
    merge_robots(outline, candidates)
    _merge_wrappers(outline, candidates, sets)
    _raise_to_named_ancestors(outline, candidates)
    owners = _geometry_owners(outline.root, candidates, sets)
    merge_unnamed_pieces(outline, candidates, owners, measure)
    candidates.update(owners)
    for body in [record for record in outline.records if candidates.get(record.path) == _BODY]:
        candidates.update(find_fixtures(body, candidates))
    return candidates


def _model_candidates(outline: Outline, kinds: frozenset[str], sets: SetFinder) -> dict[str, str]:
    found: dict[str, str] = {}
    # (record, below a component or body, below an asset)
    pending = [(outline.root, False, False)]
    while pending:
        record, in_model, in_asset = pending.pop()
        has_geometry = record.gprim_count > 0 or _has_unresolved(record) or _has_missing_mesh(record)
        if record.kind in kinds:
            found[record.path] = f"authored kind: {record.kind}"
            in_model = True
        elif record.is_body and has_geometry and not record.kind:
            found[record.path] = _BODY
            in_model = True
        elif record.is_instancer:
            found[record.path] = "point instancer"
        elif (
            has_geometry
            and not (in_model or in_asset or record.is_gprim)
            and record.is_asset
            and _is_one_asset(record, kinds)
            and not sets.is_set_of_objects(record)
        ):
            found[record.path] = _ASSET
            in_asset = True
        pending.extend((child, in_model, in_asset) for child in record.children)
    return found


def _has_unresolved(record: PrimRecord) -> bool:
    return record.gprim_count == 0 and any(below.is_unresolved for below in record.walk())


def _has_missing_mesh(record: PrimRecord) -> bool:
    """Return whether an importer left an empty Xform in place of the visible mesh."""
    return record.gprim_count == 0 and any(
        child.type_name == "Xform" and not child.is_hidden and not child.children for child in record.children
    )


def _is_one_asset(record: PrimRecord, kinds: frozenset[str]) -> bool:
    """Return whether a referenced prim is one object, and not a set of several assets or models."""
    if record.kind in _STRUCTURE_KINDS:
        return False
    below = [prim for prim in record.walk() if prim is not record and not prim.is_gprim]
    assets, models = sum(prim.is_asset for prim in below), sum(prim.kind in kinds for prim in below)
    return max(assets, models) < _MIN_NESTED


def _drop_whole_scene(root: PrimRecord, candidates: dict[str, str]) -> None:
    """Remove a root prim that contains all geometry and several objects: some converters make it a component."""
    for record in root.children:
        is_all = record.gprim_count == root.gprim_count
        if is_all and record.path in candidates and len(_nearest_below(record, candidates)) > 1:
            del candidates[record.path]


def _nearest_below(record: PrimRecord, candidates: dict[str, str]) -> list[PrimRecord]:
    """Return the outermost candidates below a prim."""
    found: list[PrimRecord] = []
    pending = list(reversed(record.children))
    while pending:
        below = pending.pop()
        if below.path in candidates:
            found.append(below)
        else:
            pending.extend(reversed(below.children))
    return found


def _merge_wrappers(outline: Outline, candidates: dict[str, str], sets: SetFinder) -> None:
    """Resolve candidates that wrap nested ones.

    One without geometry of its own replaces a single nested candidate. Several nested candidates replace a wrapper
    without geometry and authored kind, and one that is a furnished room.
    """
    for record in reversed(outline.records):
        if record.path not in candidates or record.is_instancer or record.is_gprim:
            continue
        nested = _nearest_below(record, candidates)
        own_gprims = record.gprim_count - sum(below.gprim_count for below in nested)
        if len(nested) == 1 and not own_gprims:
            del candidates[nested[0].path]
        elif len(nested) > 1:
            is_mere_wrapper = not own_gprims and not candidates[record.path].startswith("authored kind")
            if is_mere_wrapper or sets.is_furnished_room(nested):
                del candidates[record.path]


def _raise_to_named_ancestors(outline: Outline, candidates: dict[str, str]) -> None:
    """Replace an unnamed asset, such as `visual`, by the nearest named ancestor with the same geometry."""
    assets = [record for record in outline.records if candidates.get(record.path) == _ASSET and is_unnamed(record.name)]
    for asset in assets:
        top = asset
        while is_unnamed(top.name) and (above := top.parent) is not None and above.path not in candidates:
            if above.gprim_count > asset.gprim_count or _is_grouping(above, holds_objects=False):
                break
            top = above
        del candidates[asset.path]
        candidates[top.path] = _ASSET


@dataclass(slots=True)
class _Cover:
    """The gprims at and below a prim that no candidate contains."""

    uncovered: int = 0
    """Their number."""
    holds_objects: bool = False
    """Whether there are candidates at or below the prim."""
    owners: list[PrimRecord] = field(default_factory=list)
    """The prims that own them."""


def _geometry_owners(root: PrimRecord, candidates: dict[str, str], sets: SetFinder) -> dict[str, str]:
    covers: dict[str, _Cover] = {}
    # Bottom-up without recursion: a stage may be nested deeper than Python's stack.
    for record in reversed(list(_open_records(root, candidates))):
        covers[record.path] = _cover(record, candidates, covers, sets)
    return {record.path: "geometry without a model above it" for record in covers[root.path].owners}


def _open_records(root: PrimRecord, candidates: dict[str, str]) -> Iterator[PrimRecord]:
    """Yield the prims without a candidate above them, parents first."""
    pending = [root]
    while pending:
        record = pending.pop()
        yield record
        if record.children and record.path not in candidates:
            pending.extend(reversed(record.children))


def _cover(record: PrimRecord, candidates: dict[str, str], covers: dict[str, _Cover], sets: SetFinder) -> _Cover:
    if record.path in candidates:
        return _Cover(holds_objects=True)
    below = [covers.pop(child.path) for child in record.children]
    cover = _Cover(holds_objects=any(c.holds_objects for c in below))
    is_own = record.is_gprim and not record.is_hidden
    cover.uncovered = is_own + sum(c.uncovered for c in below)
    if is_own:
        cover.owners = [record]
    elif cover.uncovered:
        cover.owners = _owners_at(record, cover, below, sets)
    return cover


def _owners_at(record: PrimRecord, cover: _Cover, below: list[_Cover], sets: SetFinder) -> list[PrimRecord]:
    found = [owner for c in below for owner in c.owners]
    has_gprims = any(child.is_gprim and c.uncovered for child, c in zip(record.children, below, strict=True))
    is_grouping = _is_grouping(record, cover.holds_objects)
    if has_gprims and not is_grouping:
        return found if sets.is_set(record, found) else [record]
    is_lone_root = _is_lone_root(record) and not cover.holds_objects
    # A name is kept below wrappers without one (Xform_2/ControlPanel/mesh) and in rooms (Office/Desk/mesh).
    says_less = len(found) == 1 and not is_unnamed(found[0].name) and _says_less(record.name, found[0])
    if len(found) == 1 and (is_lone_root or not is_grouping) and not says_less:
        return [record]
    # A named prim with unnamed pieces: Chair/group_1/mesh_7.
    if not is_grouping and not is_unnamed(record.name) and all(is_unnamed(owner.name) for owner in found):
        return [record]
    return found


def _says_less(name: str, owner: PrimRecord) -> bool:
    """Return whether the name of a prim says less of what it is than that of the only owner below it."""
    return is_unnamed(name) or _is_group_name(name) or (is_room_name(name) and not owner.is_gprim)


def _is_grouping(record: PrimRecord, holds_objects: bool) -> bool:
    is_top = record.parent is None or record.parent.parent is None
    is_structure = record.is_scope or record.kind in _STRUCTURE_KINDS or _is_group_name(record.name)
    return is_top or is_structure or holds_objects


def _is_group_name(name: str) -> bool:
    last_words = [word.lower() for word in split_identifier(name) if word.isalpha()][-1:]
    return not _GROUPING_WORDS.isdisjoint(last_words)


def _is_lone_root(record: PrimRecord) -> bool:
    """Return whether a prim is the only root prim with geometry, so that the file is one asset."""
    above = record.parent
    return (
        above is not None and above.parent is None and not record.is_scope and record.gprim_count == above.gprim_count
    )


def _count_left_out(outline: Outline, chosen: dict[str, str]) -> Counter[str]:
    counts = Counter(outline.left_out)
    # (record, below an object)
    pending = [(child, False) for child in outline.root.children]
    while pending:
        record, in_object = pending.pop()
        is_object = record.path in chosen
        if not is_object:
            counts[_reason(record, in_object, chosen)] += 1
        pending.extend((child, in_object or is_object) for child in record.children)
    return counts


def _reason(record: PrimRecord, in_object: bool, chosen: dict[str, str]) -> str:
    if record.gprim_count == 0:
        return "guide or proxy geometry" if record.hidden_gprim_count else "no geometry"
    return "part of an object" if in_object else "grouping of objects"


def explain(path: str, outline: Outline, selection: Selection) -> str:
    """Return a sentence on why the prim at `path` is or is not an object."""
    if path in selection.chosen:
        return f"{path} is an object: {selection.chosen[path]}"
    pruned = outline.pruned
    for above in _paths_up(path):
        if above in pruned:
            subject = "it is" if above == path else f"it is below {above}, which is"
            return f"{path} is not an object: {subject} left out ({pruned[above]})"
    record = next((record for record in (outline.root, *outline.records) if record.path == path), None)
    if record is None:
        return f"{path} is not an object: it belongs to the prototypes of a point instancer"
    owner = next((above for above in _paths_up(path) if above in selection.chosen), None)
    reason = _reason(record, owner is not None, selection.chosen)
    if owner is not None:
        return f"{path} is not an object: {reason}, {owner} ({selection.chosen[owner]})"
    below = [found.path for found in _nearest_below(record, selection.chosen)]
    listed = ", ".join(below[:_MAX_LISTED])
    if len(below) > _MAX_LISTED:
        listed += f" and {len(below) - _MAX_LISTED} more"
    return f"{path} is not an object: {reason}" + (f"; the objects are {listed}" if below else "")


def _paths_up(path: str) -> Iterator[str]:
    """Yield a prim path and those of its ancestors, nearest first."""
    while path and path != "/":
        yield path
        path = path.rpartition("/")[0]
