"""The tables of the error analysis."""

from collections.abc import Iterable

from usd2kg.evaluation.metrics.confusion import class_reports, confusion
from usd2kg.evaluation.metrics.misses import Miss
from usd2kg.evaluation.report.analysis import (
    REGIMES,
    agreed_objects,
    compare_methods,
    ema_by_name_quality,
    hierarchy_order,
    methods_of,
    name_counts,
    names_its_class,
    runs_of,
    scores_under,
    size_distinctive,
)
from usd2kg.evaluation.report.document import ABSENT, Table, class_text, number_text, p_value_text
from usd2kg.evaluation.report.tables import size_title
from usd2kg.evaluation.reproduce import SceneResult
from usd2kg.evaluation.sample import Score, distinct_name
from usd2kg.grounding import NamingRegime
from usd2kg.scene import Scene

__all__ = [
    "agreed_table",
    "classes_table",
    "confusions_table",
    "mcnemar_table",
    "misses_table",
    "name_quality_table",
    "name_quality_text",
    "size_table",
    "size_text",
]

_SEMANTIC = NamingRegime.SEMANTIC.value
_MOST_NAMES = 30
_MOST_CONFUSIONS = 10


def agreed_table(result: SceneResult) -> Table:
    """Return what all methods have right and what all have wrong, for each regime."""
    rows = []
    for regime in REGIMES:
        by_method = scores_under(result, regime)
        if by_method:
            agreed = agreed_objects(by_method)
            rows.append((regime, "all right", str(len(agreed.right)), _names(agreed.right)))
            rows.append((regime, "all wrong", str(len(agreed.wrong)), _names(agreed.wrong)))
    columns = ("regime", "methods", "objects", "distinct names (copies)")
    note = "" if len(methods_of(result)) > 1 else "Only one method was run."
    return Table(f"{result.spec.name}: objects that all methods have right or wrong", columns, tuple(rows), note)


def size_table(result: SceneResult) -> Table | None:
    """Return the objects that their box gives away; None if there are none."""
    found = size_distinctive(result).found
    each = [(distinct_name(s.name), class_text(s.target, result.tbox), _size(s, result.scene)) for s in found]
    rows = tuple(dict.fromkeys(each))
    if not rows:
        return None
    title = f"{result.spec.name}: objects found by their size alone, under opaque names"
    return Table(title, ("name", "class", "width × depth × height, m"), rows, is_long=len(rows) > 20)


def size_text(result: SceneResult) -> str | None:
    """Return the count behind `size_table` in a sentence; None where no method was limited to geometry."""
    if not scores_under(result, "geometry only") and not scores_under(result, "opaque").get("volume"):
        return None
    found = size_distinctive(result)
    text = f"{result.spec.name}: {len(found.found)} of {len(result.gold)} objects are found by their size alone."
    if not found.by_default:
        return text
    return f"{text} {found.by_default} more are right too, but only because the method's answer without evidence is."


def misses_table(result: SceneResult) -> Table:
    """Return how often each kind of miss occurs, for each method and regime."""
    runs = runs_of(result)
    rows = []
    for method in methods_of(result):
        for regime in REGIMES:
            for done in runs.get((method, regime), ())[:1]:
                summary = done.evaluation.summary
                right = sum(score.is_exact for score in done.evaluation.scores)
                rows.append((method, regime, str(right), *(str(summary.misses.get(kind.value, 0)) for kind in Miss)))
    columns = ("method", "regime", "right", *(kind.value for kind in Miss))
    return Table(f"{size_title(result)}: kinds of misses", columns, tuple(rows))


def classes_table(result: SceneResult) -> Table:
    """Return precision and recall of each class under authored names, in the order of the hierarchy."""
    by_method = scores_under(result, _SEMANTIC)
    reports = {method: {r.class_iri: r for r in class_reports(scores)} for method, scores in by_method.items()}
    targets = hierarchy_order({iri for found in reports.values() for iri in found}, result.tbox)
    rows = []
    for iri in targets:
        found = [reports[method].get(iri) for method in reports]
        support = next((r.support for r in found if r is not None), 0)
        figures = [number_text(value, 2) for r in found for value in ((r.precision, r.recall) if r else (None, None))]
        rows.append((class_text(iri, result.tbox), str(support), *figures))
    columns = ("class", "objects", *(f"{method} {what}" for method in reports for what in ("precision", "recall")))
    return Table(f"{result.spec.name}: classes, authored names", columns, tuple(rows), is_long=True)


def confusions_table(result: SceneResult) -> Table:
    """Return the ten commonest confusions of each method under authored names."""
    rows = [
        (method, class_text(target, result.tbox), class_text(answer, result.tbox), str(count))
        for method, scores in scores_under(result, _SEMANTIC).items()
        for target, answer, count in confusion(scores)[:_MOST_CONFUSIONS]
    ]
    columns = ("method", "gold", "answer", "objects")
    return Table(f"{result.spec.name}: commonest confusions, authored names", columns, tuple(rows))


def name_quality_text(result: SceneResult) -> str:
    """Return how many names contain their class's head word, in a sentence."""
    names = [(label.prim_path.rpartition("/")[2], label.target) for label in result.gold]
    named = [(distinct_name(name), names_its_class(name, target)) for name, target in names]
    objects, share = sum(good for _, good in named), 100 * sum(good for _, good in named) / len(named)
    distinct = {name for name, _ in named}
    return (
        f"{result.spec.name}: {objects} of {len(named)} names ({share:.0f} %) contain the head word of their class; "
        f"{len({name for name, good in named if good})} of {len(distinct)} distinct names."
    )


def name_quality_table(result: SceneResult) -> Table:
    """Return exact match by whether the authored name names the class, for each method and regime."""
    runs = runs_of(result)
    rows = []
    for method in methods_of(result):
        for regime in REGIMES:
            for done in runs.get((method, regime), ())[:1]:
                quality = ema_by_name_quality(done.evaluation.scores)
                rows.append((method, regime, number_text(quality.ema_named, 1), number_text(quality.ema_other, 1)))
    named = sum(names_its_class(label.prim_path.rpartition("/")[2], label.target) for label in result.gold)
    columns = (
        "method",
        "regime",
        f"EMA % where the name names its class (n = {named})",
        f"EMA % where it does not (n = {len(result.gold) - named})",
    )
    return Table(f"{result.spec.name}: EMA by quality of name", columns, tuple(rows))


def mcnemar_table(result: SceneResult) -> Table | None:
    """Return McNemar's test between each two methods under authored names; None if there is only one."""
    pairs = compare_methods(scores_under(result, _SEMANTIC))
    if not pairs:
        return None
    rows = tuple(
        (a, b, str(test.only_first), str(test.only_second), p_value_text(test.p_value)) for a, b, test in pairs
    )
    columns = ("first", "second", "only first right", "only second right", "p")
    note = "Objects count one by one: copies of one thing make p smaller than it should be."
    return Table(f"{result.spec.name}: McNemar's exact test, authored names", columns, rows, note)


def _names(scores: Iterable[Score]) -> str:
    counts = name_counts(scores)
    listed = [name if count == 1 else f"{name} ×{count}" for name, count in counts[:_MOST_NAMES]]
    more = [f"and {len(counts) - _MOST_NAMES} more"] if len(counts) > _MOST_NAMES else []
    return ", ".join(listed + more) or ABSENT


def _size(score: Score, scene: Scene) -> str:
    obj = scene.by_path.get(score.id)
    return " × ".join(f"{side:.2f}" for side in obj.box.size) if obj and obj.box else ABSENT
