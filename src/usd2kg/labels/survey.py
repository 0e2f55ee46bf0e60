"""survey_labels: all labels of a stage, what they stand on, and what is wrong with them one by one."""

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Usd, UsdGeom

from usd2kg.scene.bounds import BoxReader
from usd2kg.scene.evidence import own_nodes
from usd2kg.scene.label_encodings import CLASS_TAXONOMIES
from usd2kg.scene.label_lint import LabelProblem, find_problems, stage_prims
from usd2kg.scene.label_reader import LabelReader, read_labels
from usd2kg.scene.model import Label
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.outline import Node
from usd2kg.scene.selection import select_objects
from usd2kg.scene.stage import UNREADABLE, captured_diagnostics, open_stage, translated_errors
from usd2kg.scene.traversal import above_endless, outline_stage

__all__ = ["LabelSurvey", "LabelledPrim", "survey_labels"]


@dataclass(frozen=True, slots=True)
class LabelledPrim:
    """One prim that carries labels; of what instances share, the first."""

    prim_path: str
    labels: tuple[Label, ...]
    is_object: bool
    has_geometry: bool
    """Whether geometry stands at or below it."""
    same_as: str | None
    """Path of the nearest labelled prim above of which it is the whole geometry, within one object; else None."""


@dataclass(frozen=True)
class LabelSurvey:
    """The labels of a stage."""

    source: str
    prim_count: int
    """Prims that were looked at; what instances share once."""
    labelled: tuple[LabelledPrim, ...]
    """In traversal order."""
    problems: tuple[LabelProblem, ...]
    """What is wrong by what stands on each prim alone, in traversal order."""
    unlabelled: Mapping[str, tuple[str, ...]]
    """Path of a prim that tells a class → the objects below it that tell none themselves, and so inherit its class."""


def survey_labels(source: Path | str | Usd.Stage, options: ReadOptions | None = None) -> LabelSurvey:
    """Return all labels of a stage.

    Args:
        source: the stage's root layer, or a stage that is open already.
        options: how the stage is read, and which prims are objects.

    Raises:
        SceneError: the stage cannot be read.
    """
    options = options or ReadOptions()
    opened = open_stage(source, options)
    time = Usd.TimeCode.EarliestTime() if options.time is None else Usd.TimeCode(options.time)
    with translated_errors(opened.source), captured_diagnostics(), outline_stage(opened, time) as outline:
        boxes = BoxReader(opened.frame, time, above_endless(outline))
        selection = select_objects(outline, options.selection, boxes.read_below)
        nodes = {node.path: node for node in outline.nodes}
        prims = list(stage_prims(opened.stage))
        read = [(prim, labels) for prim in prims if (labels := _read(prim, time))]
        known = {str(prim.GetPath()): labels for prim, labels in read}
        return LabelSurvey(
            source=opened.source,
            prim_count=len(prims) - 1,
            labelled=tuple(_labelled(prim, labels, nodes, selection.chosen, known.keys()) for prim, labels in read),
            problems=tuple(problem for prim in prims for problem in find_problems(prim, time)),
            unlabelled=_unlabelled(outline.nodes, selection.chosen, LabelReader(time, known)) if read else {},
        )


def _read(prim: Any, time: Any) -> tuple[Label, ...]:
    try:
        return read_labels(prim, time)
    except UNREADABLE:
        # find_problems tells of it.
        return ()


def _labelled(
    prim: Any, labels: tuple[Label, ...], nodes: Mapping[str, Node], chosen: Mapping[str, str], paths: Set[str]
) -> LabelledPrim:
    path = str(prim.GetPath())
    node = nodes.get(path)
    return LabelledPrim(
        prim_path=path,
        labels=labels,
        is_object=path in chosen,
        has_geometry=(node is not None and _gprims(node) > 0) or _has_geometry(prim),
        same_as=_whole_of(node, chosen, paths) if node is not None and path not in chosen else None,
    )


def _has_geometry(prim: Any) -> bool:
    below = Usd.PrimRange(prim, Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate))
    kinds = (UsdGeom.Gprim, UsdGeom.PointInstancer, UsdGeom.Subset)
    return any(inside.IsA(kind) for inside in below for kind in kinds)


def _gprims(node: Node) -> int:
    return node.gprim_count + node.hidden_gprim_count


def _whole_of(node: Node, chosen: Mapping[str, str], paths: Set[str]) -> str | None:
    count = _gprims(node)
    above = node.parent
    while count and above is not None and _gprims(above) == count:
        if above.path in paths:
            return above.path
        if above.path in chosen:
            return None
        above = above.parent
    return None


def _unlabelled(nodes: list[Node], chosen: dict[str, str], reader: LabelReader) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, list[str]] = {}
    for node in nodes:
        if node.path in chosen:
            labels = reader.read(list(own_nodes(node, chosen)))
            if not any(_tells_class([*labels.own, *labels.of_parts])):
                for label in _tells_class(labels.inherited):
                    found.setdefault(label.prim_path, []).append(node.path)
                    break
    return {path: tuple(below) for path, below in found.items()}


def _tells_class(labels: Iterable[Label]) -> Iterator[Label]:
    return (label for label in labels if label.encoding != "Multiverse" and label.taxonomy in CLASS_TAXONOMIES)
