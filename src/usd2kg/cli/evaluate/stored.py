"""usd2kg eval calibrate and eval compare: calibration and comparison of stored runs."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.output import emit, format_optional, notify, print_json
from usd2kg.cli.text_table import format_table

if TYPE_CHECKING:
    from usd2kg.evaluation.score import Score
    from usd2kg.evaluation.stored import StoredRun

__all__ = ["calibrate_command", "compare_command"]

_SMALLEST_P = 0.0001
"""p-values below this are printed as an upper bound."""


def calibrate_command(
    runs: Annotated[
        list[Path],
        Argument(
            metavar="RUN...",
            help="Runs of one language model with the same options, without --cascade, written by usd2kg eval run "
            "--output.",
        ),
    ],
    output: Annotated[Path, Option("--output", "-o", help="Calibration to write, for --calibration.")],
) -> None:
    """Fit a calibration of a language model's confidence to its runs (Platt scaling).

    Use scenes other than those you evaluate on. Decisions of a person are left out.
    """
    from usd2kg import evaluation  # noqa: PLC0415
    from usd2kg.evaluation.calibrate import model_answers  # noqa: PLC0415
    from usd2kg.evaluation.metrics.calibration import calibration_error  # noqa: PLC0415
    from usd2kg.evaluation.stored import read_run  # noqa: PLC0415
    from usd2kg.files import check_apart  # noqa: PLC0415
    from usd2kg.grounding.platt_scaling import describe_settings  # noqa: PLC0415

    check_apart([output], runs)
    stored = [read_run(path) for path in runs]
    scores = model_answers(stored)
    scaling = evaluation.fit_scaling(scores, describe_settings(stored[0].settings))
    scaled = [
        replace(score, confidence=None if score.confidence is None else scaling(score.confidence)) for score in scores
    ]
    emit(scaling.as_json(), output)
    before, after = calibration_error(scores), calibration_error(scaled)
    notify(
        f"fitted on {scaling.answers} answers: calibration error {format_optional(before, '.3f')} before, "
        f"{format_optional(after, '.3f')} after, on the same answers"
    )
    if scaling.slope <= 0:
        notify(
            f"the slope is {scaling.slope:g}: answers of a higher confidence are not more often right, so that "
            f"--calibration {output} would reverse their order; do not use it, or fit it on more answers"
        )


def compare_command(
    first: Annotated[Path, Argument(metavar="A", help="Run written by usd2kg eval run --output.")],
    second: Annotated[Path, Argument(metavar="B", help="Another run on the same scene and ontology.")],
    json: JsonOutput = False,
) -> None:
    """Compare two runs object by object, with McNemar's exact test."""
    from usd2kg.evaluation.metrics.intervals import mcnemar  # noqa: PLC0415
    from usd2kg.evaluation.stored import check_comparable, describe_runs, read_run  # noqa: PLC0415
    from usd2kg.ontology import local_name  # noqa: PLC0415

    a, b = read_run(first), read_run(second)
    check_comparable(a, b)
    others = {score.id: score for score in b.scores}
    pairs = [(score, others[score.id]) for score in a.scores if score.id in others]
    unpaired = len(a.scores) - len(pairs), len(b.scores) - len(pairs)
    described = describe_runs((a, b))
    test = mcnemar(a.scores, b.scores)
    differing = [(x, y) for x, y in pairs if x.is_exact != y.is_exact]
    data: dict[str, Any] = {
        "n": len(pairs),
        "unpaired_first": unpaired[0],
        "unpaired_second": unpaired[1],
        "first": {"file": a.source, "run": described[0], **_ema_json(a, [x for x, _ in pairs])},
        "second": {"file": b.source, "run": described[1], **_ema_json(b, [y for _, y in pairs])},
        "only_first": test.only_first,
        "only_second": test.only_second,
        "p_value": test.p_value,
        "changed": [{"path": x.id, "target": x.target, "first": x.answer, "second": y.answer} for x, y in differing],
    }
    if json:
        print_json(data)
        return
    head = (
        f"A  {_ema_text(data['first'])}  {first}: {described[0]}\n"
        f"B  {_ema_text(data['second'])}  {second}: {described[1]}\n"
        f"{data['n']} objects; only A right: {test.only_first}, only B right: {test.only_second}; "
        f"McNemar's exact p {_p_value_text(test.p_value)}\n"
    )
    if any(unpaired):
        head += f"left out, since only one run has gold labels for them: {unpaired[0]} of A, {unpaired[1]} of B\n"
    names = [[local_name(iri) if iri else None for iri in (x.target, x.answer, y.answer)] for x, y in differing]
    rows = [(x.id, *row) for (x, _), row in zip(differing, names, strict=True)]
    emit(head + (format_table(("differs", "gold", "A", "B"), rows) if rows else ""))


def _ema_json(run: "StoredRun", scores: Sequence["Score"]) -> dict[str, Any]:
    """Return the exact matches in percent, also with the objects that the selection misses counted as wrong."""
    exact = [score.id for score in scores if score.is_exact]
    selected = [path for path in exact if path not in run.missed]
    share = 100 / len(scores)
    return {"ema": share * len(exact), "end_to_end_ema": share * len(selected)}


def _ema_text(data: Mapping[str, Any]) -> str:
    return f"{data['ema']:.1f} % ({data['end_to_end_ema']:.1f} % end to end)"


def _p_value_text(p: float) -> str:
    return f"< {_SMALLEST_P}" if p < _SMALLEST_P else f"= {p:.4f}"
