"""usd2kg eval calibrate and eval compare: calibration and comparison of stored runs."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.output import emit, format_optional, notify, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation.score import Score
    from usd2kg.evaluation.stored import StoredRun

__all__ = ["calibrate_command", "compare_command"]

_SMALLEST_P = 0.0001
"""p-values below this are printed as an upper bound."""


def calibrate_command(
    runs: Annotated[
        list[Path], Argument(metavar="RUN...", help="Runs of one grounder, written by usd2kg eval run --output.")
    ],
    output: Annotated[Path, Option("--output", "-o", help="Calibration to write, for --calibration.")],
) -> None:
    """Fit a calibration of a language model's confidence to its runs (Platt scaling).

    Use scenes other than those you evaluate on.
    """
    from usd2kg import evaluation  # noqa: PLC0415
    from usd2kg.evaluation.metrics.calibration import calibration_error  # noqa: PLC0415
    from usd2kg.evaluation.stored import read_run  # noqa: PLC0415
    from usd2kg.files import check_apart  # noqa: PLC0415

    check_apart([output], runs)
    stored = [read_run(path) for path in runs]
    grounders = {run.description for run in stored}
    if len(grounders) > 1:
        raise EvaluationError(f"runs of different grounders: {'; '.join(sorted(grounders))}; expected runs of one")
    scores = [score for run in stored for score in run.scores]
    scaling = evaluation.fit_scaling(scores, grounders.pop())
    scaled = [
        replace(score, confidence=None if score.confidence is None else scaling(score.confidence)) for score in scores
    ]
    emit(scaling.as_json(), output)
    before, after = calibration_error(scores), calibration_error(scaled)
    notify(
        f"fitted on {scaling.answers} answers: calibration error {format_optional(before, '.3f')} before, "
        f"{format_optional(after, '.3f')} after, on the same answers"
    )


def compare_command(
    first: Annotated[Path, Argument(metavar="A", help="Run written by usd2kg eval run --output.")],
    second: Annotated[Path, Argument(metavar="B", help="Another run on the same scene and ontology.")],
    json: JsonOutput = False,
) -> None:
    """Compare two runs object by object, with McNemar's exact test."""
    from usd2kg.evaluation.metrics.intervals import mcnemar  # noqa: PLC0415
    from usd2kg.evaluation.stored import read_run  # noqa: PLC0415
    from usd2kg.ontology import local_name  # noqa: PLC0415

    a, b = read_run(first), read_run(second)
    if a.ontology_hash != b.ontology_hash:
        raise EvaluationError(f"{first} and {second} used different ontologies; compare runs on the same one")
    others = {score.id: score for score in b.scores}
    pairs = [(score, others[score.id]) for score in a.scores if score.id in others]
    if not pairs:
        raise EvaluationError(f"{first} and {second} have no object in common; compare runs on the same scene")
    test = mcnemar(a.scores, b.scores)
    differing = [(x, y) for x, y in pairs if x.is_exact != y.is_exact]
    data: dict[str, Any] = {
        "n": len(pairs),
        "first": _ema_json(a, [x for x, _ in pairs]),
        "second": _ema_json(b, [y for _, y in pairs]),
        "only_first": test.only_first,
        "only_second": test.only_second,
        "p_value": test.p_value,
        "changed": [{"path": x.id, "target": x.target, "first": x.answer, "second": y.answer} for x, y in differing],
    }
    if json:
        print_json(data)
        return
    head = (
        f"A  {_ema_text(data['first'])}  {a.description}\nB  {_ema_text(data['second'])}  {b.description}\n"
        f"{data['n']} objects; only A right: {test.only_first}, only B right: {test.only_second}; "
        f"McNemar's exact p {_p_value_text(test.p_value)}\n"
    )
    names = [[local_name(iri) if iri else None for iri in (x.target, x.answer, y.answer)] for x, y in differing]
    rows = [(x.id, *row) for (x, _), row in zip(differing, names, strict=True)]
    emit(head + (format_table(("differs", "gold", "A", "B"), rows) if rows else ""))


def _ema_json(run: "StoredRun", scores: Sequence["Score"]) -> dict[str, Any]:
    """Return the exact matches in percent, also with the objects that the selection misses counted as wrong."""
    exact = [score.id for score in scores if score.is_exact]
    selected = [path for path in exact if path not in run.missed]
    share = 100 / len(scores)
    return {"run": run.description, "ema": share * len(exact), "end_to_end_ema": share * len(selected)}


def _ema_text(data: Mapping[str, Any]) -> str:
    return f"{data['ema']:.1f} % ({data['end_to_end_ema']:.1f} % end to end)"


def _p_value_text(p: float) -> str:
    return f"< {_SMALLEST_P}" if p < _SMALLEST_P else f"= {p:.4f}"
