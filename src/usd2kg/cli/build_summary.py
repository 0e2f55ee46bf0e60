"""The summary of a build, as data and as text."""

from collections import Counter
from typing import TYPE_CHECKING, Any

from usd2kg.cli.output import count_noun

if TYPE_CHECKING:
    from usd2kg.pipeline import BuildResult

__all__ = ["summarize_build", "summary_text"]

_CONFIDENCE_BANDS = ((0.8, "0.8 and more"), (0.5, "0.5 to 0.8"), (0.0, "below 0.5"))
"""Lower limit and name of each band, the highest first."""


def summarize_build(result: "BuildResult", output: str, seconds: float) -> dict[str, Any]:
    """Return the counts of a build as JSON data; `output` names the destination, `seconds` the duration."""
    from usd2kg.relations import ALL_KINDS  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    predictions = result.grounding.predictions
    kinds = Counter(relation.kind for relation in result.graph.relations)
    bands = dict.fromkeys((name for _, name in _CONFIDENCE_BANDS), 0)
    for prediction in predictions:
        if prediction.confidence is not None:
            bands[next(name for limit, name in _CONFIDENCE_BANDS if prediction.confidence >= limit)] += 1
    return {
        "scene": result.scene.source,
        "prims": result.scene.prim_count,
        "objects": len(result.scene.objects),
        "classes": len(result.graph.classes),
        "status": dict(Counter(prediction.status.value for prediction in predictions)),
        "confidence": bands,
        "is_calibrated": result.grounding.is_calibrated,
        "relations": {kind: kinds[kind] for kind in ALL_KINDS if kinds[kind]},
        "triples": len(result.graph.triples),
        "diagnostics": len(result.scene.diagnostics),
        "output": output,
        "seconds": round(seconds, 3),
    }


def summary_text(summary: dict[str, Any]) -> str:
    """Return the summary of a build as a few lines."""
    relations = ", ".join(f"{count} {kind}" for kind, count in summary["relations"].items()) or "none"
    bands = ", ".join(f"{count} at {band}" for band, count in summary["confidence"].items() if count) or "none"
    status = ", ".join(f"{count} {name}" for name, count in summary["status"].items())
    calibration = "" if summary["is_calibrated"] else " (uncalibrated: a score, not a probability)"
    objects, classes = count_noun(summary["objects"], "object"), count_noun(summary["classes"], "class")
    lines = [
        f"{summary['scene']}: {objects} of {classes} ({status})",
        f"  confidence: {bands}{calibration}",
        f"  relations: {relations}; {summary['triples']} triples in {summary['seconds']:.2f} s",
    ]
    if summary["diagnostics"]:
        lines.append(f"  {count_noun(summary['diagnostics'], 'diagnostic')}: usd2kg inspect {summary['scene']}")
    return "\n".join([*lines, f"  written to {summary['output']}"])
