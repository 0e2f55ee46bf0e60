"""Analysis of right and wrong answers across methods: pure functions of results."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

from usd2kg.evaluation.metrics.accuracy import exact_match
from usd2kg.evaluation.metrics.intervals import McNemar, mcnemar
from usd2kg.evaluation.run_matrix import CellResult, SceneResult
from usd2kg.evaluation.score import Score, distinct_name
from usd2kg.grounding import NamingRegime
from usd2kg.ontology import ClassIRI, TBox, local_name
from usd2kg.words import words_of

__all__ = [
    "REGIMES",
    "NameQuality",
    "SizeDistinctive",
    "UnanimousObjects",
    "compare_methods",
    "contains_head_noun",
    "ema_by_name_quality",
    "find_size_distinctive",
    "find_unanimous",
    "group_cascades",
    "group_repeats",
    "has_geometry_runs",
    "head_noun",
    "list_methods",
    "name_counts",
    "scores_by_method",
    "sort_by_hierarchy",
]

REGIMES = tuple(regime.value for regime in NamingRegime)
"""The naming regimes, which are also the names of the conditions with all evidence."""
_GEOMETRY_ONLY = "geometry only"
_NO_EVIDENCE = "hierarchy only, anonymised"
_VOLUME = "volume"


def group_repeats(result: SceneResult) -> Mapping[tuple[str, str], tuple[CellResult, ...]]:
    """Return (method, condition) → its repeats, in the order of the matrix, without cascades."""
    return _group(done for done in result.cells if done.cell.cascade is None)


def group_cascades(result: SceneResult) -> Mapping[tuple[str, str], tuple[CellResult, ...]]:
    """Return (language model, condition) → first repeat at each threshold of its cascades, in ascending order."""
    cascades = [done for done in result.cells if done.cell.cascade is not None and done.cell.repeat == 1]
    return _group(sorted(cascades, key=lambda done: done.cell.cascade or 0.0))


def _group(results: Iterable[CellResult]) -> Mapping[tuple[str, str], tuple[CellResult, ...]]:
    found: dict[tuple[str, str], list[CellResult]] = {}
    for done in results:
        found.setdefault((done.cell.grounder, done.cell.condition), []).append(done)
    return {key: tuple(cells) for key, cells in found.items()}


def list_methods(result: SceneResult) -> tuple[str, ...]:
    """Return the grounders that were run, in the order of the matrix, without cascades."""
    return tuple(dict.fromkeys(done.cell.grounder for done in result.cells if done.cell.cascade is None))


def scores_by_method(result: SceneResult, condition: str) -> Mapping[str, tuple[Score, ...]]:
    """Return method → scores of the first repeat under a condition, for the methods that were run under it."""
    return {
        method: repeats[0].evaluation.scores
        for (method, name), repeats in group_repeats(result).items()
        if name == condition
    }


class UnanimousObjects(NamedTuple):
    """The objects that all methods get right, or all get wrong."""

    right: tuple[Score, ...]
    """Scores of the first method for the objects that all methods get right."""
    wrong: tuple[Score, ...]
    """Scores of the first method for the objects that all methods get wrong, even if their answers differ."""


def find_unanimous(by_method: Mapping[str, Sequence[Score]]) -> UnanimousObjects:
    """Return the objects that all methods get right, and those that all get wrong, in gold order."""
    right_by: Counter[str] = Counter()
    for scores in by_method.values():
        right_by.update(score.id for score in scores if score.is_exact)
    first = next(iter(by_method.values()), ())
    return UnanimousObjects(
        right=tuple(score for score in first if right_by[score.id] == len(by_method)),
        wrong=tuple(score for score in first if right_by[score.id] == 0),
    )


def name_counts(scores: Iterable[Score]) -> tuple[tuple[str, int], ...]:
    """Return (distinct name, number of objects), most frequent first."""
    counts = Counter(distinct_name(score.name) for score in scores)
    return tuple(sorted(counts.items(), key=lambda item: (-item[1], item[0])))


class SizeDistinctive(NamedTuple):
    """The objects that are grounded correctly by the size of their box alone."""

    found: tuple[Score, ...]
    """Right from geometry alone, but not without evidence; in gold order."""
    by_default: int
    """Number of objects that are right from geometry alone but also without evidence, because the method's default
    answer happens to be their class."""


def find_size_distinctive(result: SceneResult) -> SizeDistinctive:
    """Return the objects that a method limited to geometry, or the volume method, gets right under opaque names.

    The condition without evidence is `hierarchy only, anonymised`; if it was not run, no object is discounted.
    """
    without_evidence = scores_by_method(result, _NO_EVIDENCE)
    found: dict[str, Score] = {}
    by_default: set[str] = set()
    for method, scores in _geometry_runs(result).items():
        default = {score.id for score in without_evidence.get(method, ()) if score.is_exact}
        for score in scores:
            if score.is_exact and score.id in default:
                by_default.add(score.id)
            elif score.is_exact:
                found.setdefault(score.id, score)
    order = [label.prim_path for label in result.gold]
    return SizeDistinctive(
        found=tuple(found[path] for path in order if path in found),
        by_default=len(by_default - found.keys()),
    )


def has_geometry_runs(result: SceneResult) -> bool:
    """Return whether any method was limited to geometry."""
    return bool(_geometry_runs(result))


def _geometry_runs(result: SceneResult) -> Mapping[str, Sequence[Score]]:
    by_volume = scores_by_method(result, NamingRegime.OPAQUE.value).get(_VOLUME)
    volume = {} if by_volume is None else {_VOLUME: by_volume}
    return {**scores_by_method(result, _GEOMETRY_ONLY), **volume}


def head_noun(iri: ClassIRI) -> str:
    """Return the head noun of a class: the last word of its local name, lower case.

    >>> head_noun("http://www.ease-crc.org/ont/SOMA.owl#DesignedContainer")
    'container'
    """
    name = local_name(iri)
    return (words_of(name) or (name.lower(),))[-1]


def contains_head_noun(name: str, target: ClassIRI) -> bool:
    """Return whether the head noun of the class is a word of an authored name.

    >>> contains_head_noun("CupCBlue_1", "#Cup"), contains_head_noun("FlowerPot_2", "#DesignedContainer")
    (True, False)
    """
    return head_noun(target) in words_of(name)


class NameQuality(NamedTuple):
    """Exact match by whether the authored name contains the head noun of the class."""

    named: int
    """Number of objects whose name contains the head noun."""
    ema_named: float | None
    """Exact match of these objects, percent; None if there are none."""
    other: int
    """Number of the other objects."""
    ema_other: float | None


def ema_by_name_quality(scores: Sequence[Score]) -> NameQuality:
    """Return exact match separately for good names, which contain the head noun of the class, and for others."""
    named = [score for score in scores if contains_head_noun(score.name, score.target)]
    other = [score for score in scores if not contains_head_noun(score.name, score.target)]
    return NameQuality(len(named), _percent(named), len(other), _percent(other))


def _percent(scores: Sequence[Score]) -> float | None:
    return 100 * exact_match(scores) if scores else None


def compare_methods(by_method: Mapping[str, Sequence[Score]]) -> tuple[tuple[str, str, McNemar], ...]:
    """Return (first method, second method, McNemar's test) for each pair."""
    return tuple((a, b, mcnemar(by_method[a], by_method[b])) for a, b in combinations(by_method, 2))


def sort_by_hierarchy(classes: Iterable[ClassIRI], tbox: TBox) -> tuple[ClassIRI, ...]:
    """Return classes in depth-first order of the hierarchy, so that superclasses and siblings are neighbours."""
    wanted = set(classes)
    visited: dict[ClassIRI, None] = {}

    def visit(iri: ClassIRI) -> None:
        if iri in visited:
            return
        visited[iri] = None
        for child in tbox.children[iri]:
            visit(child)

    for root in tbox.roots:
        visit(root)
    return tuple(iri for iri in visited if iri in wanted)
