"""Report tables of the error analysis."""

from collections.abc import Iterable

from usd2kg.evaluation.metrics.confusion import class_reports, confusion
from usd2kg.evaluation.metrics.misses import Miss
from usd2kg.evaluation.report.analysis import (
    REGIMES,
    compare_methods,
    contains_head_noun,
    ema_by_name_quality,
    find_size_distinctive,
    find_unanimous,
    group_repeats,
    has_geometry_runs,
    list_methods,
    name_counts,
    scores_by_method,
    sort_by_hierarchy,
)
from usd2kg.evaluation.report.blocks import Table
from usd2kg.evaluation.report.cell_text import ABSENT, class_text, number_text, p_value_text
from usd2kg.evaluation.report.result_tables import size_title
from usd2kg.evaluation.run_matrix import SceneResult
from usd2kg.evaluation.score import Score, distinct_name
from usd2kg.evaluation.settings import REPORT
from usd2kg.grounding import NamingRegime
from usd2kg.scene import Scene

__all__ = [
    "classes_table",
    "confusions_table",
    "mcnemar_table",
    "misses_table",
    "name_quality_table",
    "name_quality_text",
    "size_table",
    "size_text",
    "unanimous_table",
]

_SEMANTIC = NamingRegime.SEMANTIC.value


def unanimous_table(result: SceneResult) -> Table:
    """Return the objects that all methods get right and those that all get wrong, by regime."""
    rows = []
    for regime in REGIMES:
        if by_method := scores_by_method(result, regime):
            found = find_unanimous(by_method)
            rows.append((regime, "all right", str(len(found.right)), _names(found.right)))
            rows.append((regime, "all wrong", str(len(found.wrong)), _names(found.wrong)))
    columns = ("regime", "methods", "objects", "distinct names (copies)")
    note = "" if len(list_methods(result)) > 1 else "Only one method was run."
    return Table(f"{result.spec.name}: objects that all methods get right or wrong", columns, tuple(rows), note)


def size_table(result: SceneResult) -> Table | None:
    """Return the objects that are recognised by size alone; None if there are none."""
    found = find_size_distinctive(result).found
    each = [(distinct_name(s.name), class_text(s.target, result.tbox), _size(s, result.scene)) for s in found]
    rows = tuple(dict.fromkeys(each))
    if not rows:
        return None
    title = f"{result.spec.name}: objects recognised by size alone, opaque names"
    return Table(
        title, ("name", "class", "width × depth × height, m"), rows, is_long=len(rows) > REPORT.max_unfolded_rows
    )


def size_text(result: SceneResult) -> str | None:
    """Return the counts of `size_table` as text; None if no method was limited to geometry."""
    if not has_geometry_runs(result):
        return None
    found = find_size_distinctive(result)
    text = f"{result.spec.name}: {len(found.found)} of {len(result.gold)} objects are recognised by size alone."
    if not found.by_default:
        return text
    return f"{text} {found.by_default} more are right only because the method's answer without evidence happens to be."


def misses_table(result: SceneResult) -> Table:
    """Return the counts of each kind of miss, by method and regime."""
    runs = group_repeats(result)
    rows = []
    for method in list_methods(result):
        for regime in REGIMES:
            for done in runs.get((method, regime), ())[:1]:
                summary = done.evaluation.summary
                right = sum(score.is_exact for score in done.evaluation.scores)
                rows.append((method, regime, str(right), *(str(summary.misses.get(kind.value, 0)) for kind in Miss)))
    columns = ("method", "regime", "right", *(kind.value for kind in Miss))
    return Table(f"{size_title(result)}: kinds of misses", columns, tuple(rows))


def classes_table(result: SceneResult) -> Table:
    """Return precision and recall of each class under authored names, in hierarchy order."""
    by_method = scores_by_method(result, _SEMANTIC)
    reports = {method: {r.class_iri: r for r in class_reports(scores)} for method, scores in by_method.items()}
    targets = sort_by_hierarchy({iri for found in reports.values() for iri in found}, result.tbox)
    rows = []
    for iri in targets:
        found = [reports[method].get(iri) for method in reports]
        support = next((r.support for r in found if r is not None), 0)
        figures = [number_text(value, 2) for r in found for value in ((r.precision, r.recall) if r else (None, None))]
        rows.append((class_text(iri, result.tbox), str(support), *figures))
    columns = ("class", "objects", *(f"{method} {what}" for method in reports for what in ("precision", "recall")))
    return Table(f"{result.spec.name}: classes, authored names", columns, tuple(rows), is_long=True)


def confusions_table(result: SceneResult) -> Table:
    """Return the most frequent confusions of each method under authored names."""
    rows = [
        (method, class_text(target, result.tbox), class_text(answer, result.tbox), str(count))
        for method, scores in scores_by_method(result, _SEMANTIC).items()
        for target, answer, count in confusion(scores)[: REPORT.max_confusions]
    ]
    columns = ("method", "gold", "answer", "objects")
    return Table(f"{result.spec.name}: most frequent confusions, authored names", columns, tuple(rows))


def name_quality_text(result: SceneResult) -> str:
    """Return the number of names that contain the head noun of their class, as text."""
    names = [(label.prim_path.rpartition("/")[2], label.target) for label in result.gold]
    named = [(distinct_name(name), contains_head_noun(name, target)) for name, target in names]
    objects, share = sum(good for _, good in named), 100 * sum(good for _, good in named) / len(named)
    distinct = {name for name, _ in named}
    return (
        f"{result.spec.name}: {objects} of {len(named)} names ({share:.0f} %) contain the head noun of their class; "
        f"{len({name for name, good in named if good})} of {len(distinct)} distinct names."
    )


def name_quality_table(result: SceneResult) -> Table:
    """Return exact match by whether the authored name contains the head noun, by method and regime."""
    runs = group_repeats(result)
    rows = []
    for method in list_methods(result):
        for regime in REGIMES:
            for done in runs.get((method, regime), ())[:1]:
                quality = ema_by_name_quality(done.evaluation.scores)
                rows.append((method, regime, number_text(quality.ema_named, 1), number_text(quality.ema_other, 1)))
    named = sum(contains_head_noun(label.prim_path.rpartition("/")[2], label.target) for label in result.gold)
    columns = (
        "method",
        "regime",
        f"EMA % with head noun in name (n = {named})",
        f"EMA % without (n = {len(result.gold) - named})",
    )
    return Table(f"{result.spec.name}: EMA by name quality", columns, tuple(rows))


def mcnemar_table(result: SceneResult) -> Table | None:
    """Return McNemar's test for each pair of methods under authored names; None if there is only one."""
    pairs = compare_methods(scores_by_method(result, _SEMANTIC))
    if not pairs:
        return None
    rows = tuple(
        (a, b, str(test.only_first), str(test.only_second), p_value_text(test.p_value)) for a, b, test in pairs
    )
    columns = ("first", "second", "only first right", "only second right", "p")
    note = "Objects are treated as independent, so copies make p too small."
    return Table(f"{result.spec.name}: McNemar's exact test, authored names", columns, rows, note)


def _names(scores: Iterable[Score]) -> str:
    counts = name_counts(scores)
    listed = [name if count == 1 else f"{name} ×{count}" for name, count in counts[: REPORT.max_names]]
    more = [f"and {len(counts) - REPORT.max_names} more"] if len(counts) > REPORT.max_names else []
    return ", ".join(listed + more) or ABSENT


def _size(score: Score, scene: Scene) -> str:
    obj = scene.by_path.get(score.id)
    return " × ".join(f"{side:.2f}" for side in obj.box.size) if obj and obj.box else ABSENT
