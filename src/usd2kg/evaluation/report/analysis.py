"""What the wrong and the right answers have in common: pure functions of results."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

from usd2kg.evaluation.metrics.accuracy import exact_match
from usd2kg.evaluation.metrics.intervals import McNemar, mcnemar
from usd2kg.evaluation.reproduce import CellResult, SceneResult
from usd2kg.evaluation.sample import Score, distinct_name
from usd2kg.grounding import NamingRegime
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.ontology.model import local_name
from usd2kg.words import words_of

__all__ = [
    "REGIMES",
    "Agreed",
    "NameQuality",
    "SizeDistinctive",
    "agreed_objects",
    "compare_methods",
    "ema_by_name_quality",
    "head_word",
    "hierarchy_order",
    "methods_of",
    "name_counts",
    "names_its_class",
    "runs_of",
    "scores_under",
    "size_distinctive",
]

REGIMES = tuple(regime.value for regime in NamingRegime)
"""The naming regimes, each the name of the condition that uses it with all evidence."""
_GEOMETRY_ONLY = "geometry only"
_NO_EVIDENCE = "hierarchy only, anonymised"
_VOLUME = "volume"


def runs_of(result: SceneResult) -> Mapping[tuple[str, str], tuple[CellResult, ...]]:
    """Return (method, condition) → its repeats, in the order of the matrix."""
    found: dict[tuple[str, str], list[CellResult]] = {}
    for done in result.cells:
        found.setdefault((done.cell.grounder, done.cell.condition), []).append(done)
    return {key: tuple(cells) for key, cells in found.items()}


def methods_of(result: SceneResult) -> tuple[str, ...]:
    """Return the grounders that were run, in the order of the matrix; the first is the default one."""
    return tuple(dict.fromkeys(done.cell.grounder for done in result.cells))


def scores_under(result: SceneResult, condition: str) -> Mapping[str, tuple[Score, ...]]:
    """Return method → scores of its first repeat under a condition; methods that were not run under it are absent."""
    return {
        method: repeats[0].evaluation.scores for (method, name), repeats in runs_of(result).items() if name == condition
    }


class Agreed(NamedTuple):
    """The objects on which all methods fare alike."""

    right: tuple[Score, ...]
    """The first method's scores of the objects that every method has right."""
    wrong: tuple[Score, ...]
    """Likewise of those that every method has wrong, in whatever way."""


def agreed_objects(by_method: Mapping[str, Sequence[Score]]) -> Agreed:
    """Return the objects that all methods have right, and those that all have wrong, in the order of the gold."""
    right_by: Counter[str] = Counter()
    for scores in by_method.values():
        right_by.update(score.id for score in scores if score.is_exact)
    first = next(iter(by_method.values()), ())
    return Agreed(
        right=tuple(score for score in first if right_by[score.id] == len(by_method)),
        wrong=tuple(score for score in first if right_by[score.id] == 0),
    )


def name_counts(scores: Iterable[Score]) -> tuple[tuple[str, int], ...]:
    """Return (distinct name, objects that bear it), the most frequent first."""
    counts = Counter(distinct_name(score.name) for score in scores)
    return tuple(sorted(counts.items(), key=lambda item: (-item[1], item[0])))


class SizeDistinctive(NamedTuple):
    """The objects whose box alone gives them away."""

    found: tuple[Score, ...]
    """Right from geometry alone, and not right without any evidence; in the order of the gold."""
    by_default: int
    """Objects right from geometry alone that the same method also has right without evidence: its standing answer
    happens to be their class, and their size says nothing."""


def size_distinctive(result: SceneResult) -> SizeDistinctive:
    """Return the objects that a method limited to geometry, or the volume method, has right under opaque names.

    Without evidence means the condition `hierarchy only, anonymised`; where it was not run, nothing is taken off.
    """
    limited = dict(scores_under(result, _GEOMETRY_ONLY))
    by_volume = scores_under(result, NamingRegime.OPAQUE.value).get(_VOLUME)
    if by_volume is not None:
        limited[_VOLUME] = by_volume
    blind = scores_under(result, _NO_EVIDENCE)
    found: dict[str, Score] = {}
    by_default: set[str] = set()
    for method, scores in limited.items():
        default = {score.id for score in blind.get(method, ()) if score.is_exact}
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


def head_word(iri: ClassIRI) -> str:
    """Return the last word of a class's local name, lower case: what the class is, apart from of what sort.

    >>> head_word("http://www.ease-crc.org/ont/SOMA.owl#DesignedContainer")
    'container'
    """
    name = local_name(iri)
    return (words_of(name) or (name.lower(),))[-1]


def names_its_class(name: str, target: ClassIRI) -> bool:
    """Return whether an authored name contains the head word of its class.

    >>> names_its_class("CupCBlue_1", "#Cup"), names_its_class("FlowerPot_2", "#DesignedContainer")
    (True, False)
    """
    return head_word(target) in words_of(name)


class NameQuality(NamedTuple):
    """Exact match where names are good and where they are not."""

    named: int
    """Objects whose name contains the head word of their class."""
    ema_named: float | None
    """Exact match of those, percent; None where there are none."""
    other: int
    ema_other: float | None


def ema_by_name_quality(scores: Sequence[Score]) -> NameQuality:
    """Return exact match apart for objects whose authored name names their class and for the others."""
    named = [score for score in scores if names_its_class(score.name, score.target)]
    other = [score for score in scores if not names_its_class(score.name, score.target)]
    return NameQuality(len(named), _percent(named), len(other), _percent(other))


def _percent(scores: Sequence[Score]) -> float | None:
    return 100 * exact_match(scores) if scores else None


def compare_methods(by_method: Mapping[str, Sequence[Score]]) -> tuple[tuple[str, str, McNemar], ...]:
    """Return (first method, second method, McNemar's test) for each pair."""
    return tuple((a, b, mcnemar(by_method[a], by_method[b])) for a, b in combinations(by_method, 2))


def hierarchy_order(classes: Iterable[ClassIRI], tbox: TBox) -> tuple[ClassIRI, ...]:
    """Return classes as a walk down the hierarchy meets them: each below its superclass and beside its siblings."""
    wanted = set(classes)
    met: dict[ClassIRI, None] = {}

    def walk(iri: ClassIRI) -> None:
        if iri in met:
            return
        met[iri] = None
        for child in tbox.children[iri]:
            walk(child)

    for root in tbox.roots:
        walk(root)
    return tuple(iri for iri in met if iri in wanted)
