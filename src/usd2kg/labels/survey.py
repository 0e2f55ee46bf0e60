"""survey_labels: all labels of a stage, with the facts about labelled prims that the linter needs."""

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Usd, UsdGeom

from usd2kg.scene.bounds import BoxReader
from usd2kg.scene.evidence import own_records
from usd2kg.scene.label_encodings import CLASS_TAXONOMIES
from usd2kg.scene.label_lint import LabelProblem, find_problems, stage_prims
from usd2kg.scene.label_reader import LabelReader, class_reader, read_labels
from usd2kg.scene.model import Label
from usd2kg.scene.object_selection import select_objects
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import UNREADABLE, captured_diagnostics, open_stage, translated_errors
from usd2kg.scene.traversal import outline_stage, paths_above_endless

__all__ = ["LabelSurvey", "LabelledPrim", "survey_labels"]


@dataclass(frozen=True, slots=True)
class LabelledPrim:
    """A prim with labels; prims shared by instances appear once, under the first instance."""

    prim_path: str
    labels: tuple[Label, ...]
    is_object: bool
    has_geometry: bool
    """Whether the prim or a descendant has geometry."""
    same_as: str | None
    """Path of the nearest labelled ancestor with the same geometry, within one object; None if there is none."""


@dataclass(frozen=True)
class LabelSurvey:
    """The labels of a stage."""

    source: str
    labelled: tuple[LabelledPrim, ...]
    """In traversal order."""
    problems: tuple[LabelProblem, ...]
    """Problems that concern a single prim, in traversal order."""
    inheriting: Mapping[str, tuple[str, ...]]
    """Path of a prim with a class label → the objects below it that have no class label and inherit this one."""


def survey_labels(source: Path | str | Usd.Stage, options: ReadOptions | None = None) -> LabelSurvey:
    """Return all labels of a stage.

    Args:
        source: the stage's root layer, or an open stage.
        options: how to read the stage and select objects.

    Raises:
        SceneError: the stage cannot be read.
    """
    options = options or ReadOptions()
    opened = open_stage(source, options)
    time = Usd.TimeCode.EarliestTime() if options.time is None else Usd.TimeCode(options.time)
    with translated_errors(opened.source), captured_diagnostics(), outline_stage(opened, time) as outline:
        boxes = BoxReader(opened.frame, time, paths_above_endless(outline))
        selection = select_objects(outline, options.selection, boxes.read_below, class_reader(time))
        nodes = {node.path: node for node in outline.records}
        prims = list(stage_prims(opened.stage))
        read = [(prim, labels) for prim in prims if (labels := _read_labels(prim, time))]
        known = {str(prim.GetPath()): labels for prim, labels in read}
        return LabelSurvey(
            source=opened.source,
            labelled=tuple(_labelled(prim, labels, nodes, selection.chosen, known.keys()) for prim, labels in read),
            problems=tuple(problem for prim in prims for problem in find_problems(prim, time)),
            inheriting=_inheriting(outline.records, selection.chosen, LabelReader(time, known)) if read else {},
        )


def _read_labels(prim: Any, time: Any) -> tuple[Label, ...]:
    try:
        return read_labels(prim, time)
    except UNREADABLE:
        # `find_problems` reports this prim.
        return ()


def _labelled(
    prim: Any, labels: tuple[Label, ...], nodes: Mapping[str, PrimRecord], chosen: Mapping[str, str], paths: Set[str]
) -> LabelledPrim:
    path = str(prim.GetPath())
    node = nodes.get(path)
    return LabelledPrim(
        prim_path=path,
        labels=labels,
        is_object=path in chosen,
        has_geometry=(node is not None and _gprims(node) > 0) or _has_geometry(prim),
        same_as=_find_same_geometry(node, chosen, paths) if node is not None and path not in chosen else None,
    )


def _has_geometry(prim: Any) -> bool:
    descendants = Usd.PrimRange(prim, Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate))
    kinds = (UsdGeom.Gprim, UsdGeom.PointInstancer, UsdGeom.Subset)
    return any(descendant.IsA(kind) for descendant in descendants for kind in kinds)


def _gprims(node: PrimRecord) -> int:
    return node.gprim_count + node.hidden_gprim_count


def _find_same_geometry(node: PrimRecord, chosen: Mapping[str, str], paths: Set[str]) -> str | None:
    """Return the nearest of `paths` above a prim that has the same gprims, up to the object's prim; None if none."""
    count = _gprims(node)
    above = node.parent
    while count and above is not None and _gprims(above) == count:
        if above.path in paths:
            return above.path
        if above.path in chosen:
            return None
        above = above.parent
    return None


def _inheriting(nodes: list[PrimRecord], chosen: dict[str, str], reader: LabelReader) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, list[str]] = {}
    for node in nodes:
        if node.path not in chosen:
            continue
        labels = reader.read(list(own_records(node, chosen)))
        if any(_class_labels([*labels.own, *labels.of_parts])):
            continue
        inherited = next(_class_labels(labels.inherited), None)
        if inherited is not None:
            found.setdefault(inherited.prim_path, []).append(node.path)
    return {path: tuple(below) for path, below in found.items()}


def _class_labels(labels: Iterable[Label]) -> Iterator[Label]:
    return (label for label in labels if label.encoding != "Multiverse" and label.taxonomy in CLASS_TAXONOMIES)
