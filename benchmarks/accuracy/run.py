"""Measure the offline grounders on every scene with gold labels, and keep or check the figures.

Usage: python benchmarks/accuracy/run.py [--check]

Writes the figures to `results.json` and `README.md` beside this file and the report to `build/accuracy`. With --check,
compares the figures with `results.json` instead. Lists the scenes that cannot be measured because a file is missing.
"""

import json
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))

from benchmarks.labelled_scenes import read_accuracy_matrix
from usd2kg.evaluation import SceneResult, run_matrix
from usd2kg.evaluation.matrix import SceneSpec
from usd2kg.evaluation.report import write_report

HERE = Path(__file__).parent
RESULTS = HERE / "results.json"
TABLE = HERE / "README.md"
BUILD = HERE.parents[1] / "build" / "accuracy"
KEPT = (
    "n",
    "names",
    "answered",
    "ema",
    "ema_also",
    "ema_by_name",
    "hf1",
    "calibration_error",
    "accuracy_at_80",
    "accepted_at_80",
)
REGIMES = ("semantic", "abbreviated", "opaque", "opaque-anonymous")
INTERVALS = ("ema_interval", "ema_name_interval", "hf1_interval")


def figures(results: list[SceneResult]) -> dict[str, Any]:
    """Return scene → grounder → condition → figures; also the object selection of each scene, and EMA end to end."""
    table: dict[str, Any] = {}
    for result in results:
        scene = table.setdefault(
            result.spec.name,
            {
                "note": result.spec.note,
                "selection": {"recall": result.selection.recall, "precision": result.selection.precision},
                "grounders": {},
                "end_to_end": {},
            },
        )
        for cell in result.cells:
            data = cell.evaluation.summary.as_json()
            kept = {key: round_off(data[key]) for key in (*KEPT, *INTERVALS)}
            scene["grounders"].setdefault(cell.cell.grounder, {})[cell.cell.condition] = kept
            ema = round_off(cell.evaluation.end_to_end.ema)
            scene["end_to_end"].setdefault(cell.cell.grounder, {})[cell.cell.condition] = ema
    return table


def round_off(value: Any) -> Any:
    """Return figures with six significant digits, so that the file is the same on all platforms."""
    if isinstance(value, list):
        return [round_off(item) for item in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def table(now: dict[str, Any]) -> str:
    """Return the figures by naming regime as Markdown."""
    lines = [
        "# Accuracy of the offline grounders",
        "",
        "Written by `make accuracy` from `matrix.toml`; `make accuracy-check` compares `results.json` with the code.",
        "EMA % (95 % interval, bootstrap over distinct names) / HF1; `also` accepts the gold's second labels. End to",
        "end, labelled objects that the object selection misses count as wrong.",
        "",
    ]
    for scene, data in now.items():
        first = next(iter(data["grounders"].values()))["semantic"]
        selection = data["selection"]
        precision = "–" if selection["precision"] is None else f"{selection['precision']:.2f}"
        lines += [
            f"## {scene}: {first['n']} objects, {first['names']} distinct names",
            "",
            f"Labels: {data['note']}. Object selection: recall {selection['recall']:.2f}, precision {precision}.",
            "",
            "| method | " + " | ".join([*REGIMES, "semantic, also", "semantic, end to end"]) + " |",
            "| --- |" + " --- |" * (len(REGIMES) + 2),
        ]
        for grounder, conditions in data["grounders"].items():
            cells = [cell(conditions[regime]) for regime in REGIMES]
            end_to_end = data["end_to_end"][grounder]["semantic"]
            cells += [f"{conditions['semantic']['ema_also']:.1f}", f"{end_to_end:.1f}"]
            lines.append(f"| {grounder} | {' | '.join(cells)} |")
        lines.append("")
    return "\n".join(lines)


def cell(values: dict[str, Any]) -> str:
    """Return one cell of the table."""
    lower, upper = values["ema_name_interval"]
    return f"{values['ema']:.1f} ({lower:.0f}–{upper:.0f}) / {values['hf1']:.2f}"


def find_differences(kept: dict[str, Any], now: dict[str, Any]) -> list[str]:
    """Return one line per figure that differs from the kept one, for the scenes that were measured."""
    found = []
    for scene, data in now.items():
        old = kept.get(scene, {}).get("grounders", {})
        for grounder, conditions in data["grounders"].items():
            for condition, values in conditions.items():
                before = old.get(grounder, {}).get(condition)
                if before != values:
                    found.append(f"{scene}, {grounder}, {condition}: kept {before}, now {values}")
    return found


def describe_unmeasured(scenes: Iterable[SceneSpec]) -> list[str]:
    """Return one line per scene with a missing file; empty if all can be measured."""
    return [f"not measured: {spec.name}, {spec.missing} is missing" for spec in scenes if spec.missing]


def main() -> None:
    """Write or check the figures."""
    plan = read_accuracy_matrix()
    if unmeasured := describe_unmeasured(plan.scenes):
        lines = "\n".join([*unmeasured, "Set USD2KG_SHARED to the folder that holds these files."])
        if "--check" not in sys.argv:
            raise SystemExit(f"{lines}\nNothing was written: the kept figures of these scenes would be lost.")
        print(lines, flush=True)
    results = run_matrix(plan, BUILD)
    now = figures(results)
    if "--check" in sys.argv:
        if found := find_differences(json.loads(RESULTS.read_text("utf-8")), now):
            raise SystemExit("\n".join([*found, "The kept figures differ from those of the code; run make accuracy."]))
        print(f"{len(now)} of {len(plan.scenes)} scenes measured; the kept figures are those of the code")
        return
    RESULTS.write_text(json.dumps(now, indent=1) + "\n", encoding="utf-8")
    TABLE.write_text(table(now), encoding="utf-8")
    for path in write_report(results, plan.title, BUILD):
        print(path)


if __name__ == "__main__":
    main()
