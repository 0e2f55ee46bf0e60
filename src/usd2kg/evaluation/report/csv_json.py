"""Machine-readable results of a report, with one CSV row and one JSON entry per run."""

import csv
import io
import json
from collections.abc import Iterator, Sequence
from typing import Any

from usd2kg.evaluation.metrics.intervals import Interval
from usd2kg.evaluation.report.analysis import (
    REGIMES,
    ema_by_name_quality,
    find_size_distinctive,
    find_unanimous,
    name_counts,
    scores_by_method,
)
from usd2kg.evaluation.run import evaluation_json
from usd2kg.evaluation.run_matrix import CellResult, SceneResult
from usd2kg.spreadsheet import guard_formula

__all__ = ["format_csv", "format_json"]


def format_csv(results: Sequence[SceneResult]) -> str:
    """Return one CSV row per run: EMA in percent, HF1 from 0 to 1, not rounded; unknown values are empty.

    An apostrophe precedes text that a spreadsheet would interpret as a formula.
    """
    text = io.StringIO()
    rows = [dict(_csv_row(result, done)) for result in results for done in result.cells]
    writer = csv.DictWriter(text, list(dict.fromkeys(key for row in rows for key in row)), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _csv_row(result: SceneResult, done: CellResult) -> Iterator[tuple[str, Any]]:
    cell, summary = done.cell, done.evaluation.summary
    yield "scene", guard_formula(result.spec.name)
    yield "method", guard_formula(cell.method)
    yield "condition", guard_formula(cell.condition)
    yield "regime", cell.regime.value
    yield "evidence", _evidence(done)
    yield "repeat", cell.repeat
    for key, value in vars(summary).items():
        if isinstance(value, Interval):
            yield f"{key}_lower", value.lower
            yield f"{key}_upper", value.upper
        elif isinstance(value, dict):
            yield from ((f"{key}: {kind}", count) for kind, count in value.items())
        else:
            yield key, value
    yield "seconds", done.evaluation.seconds
    yield "seconds_per_object", done.evaluation.seconds / summary.n
    end_to_end = done.evaluation.end_to_end
    yield "end_to_end_ema", end_to_end.ema
    yield "end_to_end_ema_name_interval_lower", end_to_end.ema_name_interval.lower
    yield "end_to_end_ema_name_interval_upper", end_to_end.ema_name_interval.upper
    yield "end_to_end_hf1", end_to_end.hf1
    yield "failures", len(done.failures)
    yield from (_cost(done) or {}).items()


def _evidence(done: CellResult) -> str:
    return "all" if done.cell.evidence is None else ",".join(sorted(done.cell.evidence))


def format_json(title: str, results: Sequence[SceneResult]) -> str:
    """Return scenes, object selection, analysis, and the settings and scores of each run as JSON."""
    data = {"title": title, "scenes": [_scene(result) for result in results]}
    return json.dumps(data, indent=1, ensure_ascii=True, allow_nan=False) + "\n"


def _cost(done: CellResult) -> dict[str, Any] | None:
    if done.cost is None:
        return None
    return {key: value for key, value in done.cost.as_json().items() if key != "keys"}


def _scene(result: SceneResult) -> dict[str, Any]:
    return {
        "name": result.spec.name,
        "note": result.spec.note,
        "file": result.spec.path.name,
        "scene_hash": result.scene.content_hash,
        "ontology": result.tbox.ontology_iri,
        "ontology_hash": result.tbox.content_hash,
        "objects": len(result.gold),
        "selection": result.selection._asdict(),
        "analysis": _analysis(result),
        "runs": [_run(result, done) for done in result.cells],
    }


def _analysis(result: SceneResult) -> dict[str, Any]:
    size = find_size_distinctive(result)
    agreed = {}
    for regime in REGIMES:
        if by_method := scores_by_method(result, regime):
            found = find_unanimous(by_method)
            agreed[regime] = {"all_right": dict(name_counts(found.right)), "all_wrong": dict(name_counts(found.wrong))}
    return {
        "distinct_names_agreed_on": agreed,
        "size_distinctive": [score.id for score in size.found],
        "ema_by_name_quality": {
            regime: {
                method: ema_by_name_quality(scores)._asdict()
                for method, scores in scores_by_method(result, regime).items()
            }
            for regime in agreed
        },
    }


def _run(result: SceneResult, done: CellResult) -> dict[str, Any]:
    return {
        "method": done.cell.method,
        "condition": done.cell.condition,
        "repeat": done.cell.repeat,
        **evaluation_json(done.evaluation),
        "failures": len(done.failures),
        "model_cost": _cost(done),
        # Folders of this machine are meaningless elsewhere.
        "scene": result.spec.path.name,
    }
