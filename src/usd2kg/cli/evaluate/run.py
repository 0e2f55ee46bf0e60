"""usd2kg eval run: evaluation of one grounder on one scene."""

import json as jsonlib
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.grounder_session import open_grounder_session, show_progress
from usd2kg.cli.options.bundles import check_files, expand_bundles
from usd2kg.cli.options.common import JsonOutput, OntologyFile, SceneFile
from usd2kg.cli.options.grounding import AbbreviatedLength, GroundingOptions
from usd2kg.cli.output import emit, format_optional, notify, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation import Evaluation, GoldLabel, Score
    from usd2kg.evaluation.metrics.selection_scores import SelectionScore
    from usd2kg.grounding import Grounding
    from usd2kg.ontology import TBox

__all__ = ["run_command"]


@expand_bundles
def run_command(
    scene: SceneFile,
    gold: Annotated[Path, Option("--gold", help="Gold labels: CSV path,class,also.")],
    grounding: GroundingOptions,
    ontology: OntologyFile = None,
    abbreviated_length: AbbreviatedLength = 4,
    predictions: Annotated[
        Path | None,
        Option(
            "--predictions",
            help="Answers to score instead of a grounder's: CSV path,class,confidence, or the JSON or SSSOM (.tsv) of "
            "usd2kg ground; default: ask the grounder.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        Option("--output", "-o", help="JSON file of the run, for eval compare and eval calibrate; default: none."),
    ] = None,
    json: JsonOutput = False,
) -> None:
    """Evaluate one grounder, or the answers in a file, on one scene."""
    from usd2kg import evaluation  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.evaluation.gold import check_gold  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import ReadOptions, read_scene  # noqa: PLC0415

    if grounding.model.requests.dry_run:
        raise EvaluationError("--dry-run prints the prompts of one scene; use it with usd2kg ground")
    if output is not None:
        check_writable(output)
    if predictions is not None:
        for option in grounding.changed_options():
            raise EvaluationError(f"{predictions}: the answers exist and no grounder is asked; leave out {option}")
    check_files([output], [scene, gold, ontology, predictions], grounding)
    evidence, regime = grounding.evidence_groups, grounding.naming_regime
    tbox = open_tbox(ontology)
    labels = evaluation.read_gold(gold, tbox)
    found = read_scene(scene, paths=[label.prim_path for label in labels])
    check_gold(gold, labels, found)
    selection = evaluation.score_scene_selection(found, labels)
    if predictions is not None:
        answers = evaluation.read_predictions(predictions, found, tbox)
        _check_answered(predictions, answers, labels)
        result = evaluation.score_grounding(answers, labels, tbox, missed=selection.missed)
        _emit_evaluation(result, selection, tbox, output, json)
        return
    with (
        show_progress(grounding, "ground", is_wanted=not json),
        open_grounder_session(grounding, found, tbox, scene, ReadOptions()) as session,
    ):
        result = evaluation.evaluate(
            found,
            labels,
            tbox,
            session.grounder,
            regime=regime,
            evidence=evidence,
            decisions=session.decisions,
            abbreviated_length=abbreviated_length,
        )
    _emit_evaluation(result, selection, tbox, output, json)
    session.report(result.grounding, tbox)


def _check_answered(file: Path, answers: "Grounding", labels: "Sequence[GoldLabel]") -> None:
    """Check that a file of answers has rows for gold paths, and print to stderr for how many it has none.

    Raises:
        EvaluationError: it has none for all of them.
    """
    absent = [label.prim_path for label in labels if label.prim_path not in answers.by_path]
    count = len(labels)
    if len(absent) == count:
        raise EvaluationError(f"{file}: has no row for the {count} gold paths; expected the answers for this scene")
    if absent:
        notify(f"{file}: no row for {len(absent)} of {count} gold paths, {absent[0]} for one; they count as wrong")


def _emit_evaluation(
    result: "Evaluation", selection: "SelectionScore", tbox: "TBox", output: Path | None, is_json: bool
) -> None:
    """Print an evaluation, and write it to the output file if there is one."""
    from usd2kg.evaluation import evaluation_json  # noqa: PLC0415

    data = evaluation_json(result, selection)
    if output is not None:
        emit(jsonlib.dumps(data, indent=1, ensure_ascii=False) + "\n", output)
    if is_json:
        print_json(data)
    else:
        emit(_evaluation_text(result, selection, tbox) + _tiers_text(result))


def _evaluation_text(result: "Evaluation", selection: "SelectionScore", tbox: "TBox") -> str:
    """Return the figures of an evaluation and its wrong answers as tables."""
    s, e = result.summary, result.end_to_end
    confident = sum(score.confidence is not None for score in result.scores)
    too_few = (
        f"only {confident} of {s.n} objects have an answer with a confidence" if s.accuracy_at_80 is None else None
    )
    rows = [
        ("objects (distinct names)", f"{s.n} ({s.names})", None),
        ("answered", str(s.answered), None),
        ("exact match (EMA) %", f"{s.ema:.1f}", _interval_text(s.ema_interval)),
        ("  resampled by distinct name", None, _interval_text(s.ema_name_interval)),
        ("  mean over distinct names %", f"{s.ema_by_name:.1f}", _interval_text(s.ema_by_name_interval)),
        ("  accepting a second label %", f"{s.ema_also:.1f}", _interval_text(s.ema_also_interval)),
        ("exact match end to end %", f"{e.ema:.1f}", _interval_text(e.ema_interval)),
        ("  resampled by distinct name", None, _interval_text(e.ema_name_interval)),
        ("hierarchical F1 (HF1)", f"{s.hf1:.3f}", f"{s.hf1_interval.lower:.3f} to {s.hf1_interval.upper:.3f}"),
        ("  end to end", f"{e.hf1:.3f}", f"{e.hf1_interval.lower:.3f} to {e.hf1_interval.upper:.3f}"),
        ("calibration error", format_optional(s.calibration_error, ".3f"), None),
        ("  if the confidences were true", format_optional(s.chance_calibration_error, ".3f"), None),
        ("EMA of the most confident 80 %", format_optional(s.accuracy_at_80, ".1f") or "none", too_few),
        ("  accepting a second label %", format_optional(s.accepted_at_80, ".1f") or "none", too_few),
        ("object selection recall", f"{selection.recall:.3f}", None),
        ("object selection precision", format_optional(selection.precision, ".3f"), "if the gold labels are complete"),
        *([] if math.isnan(result.seconds) else [("seconds", f"{result.seconds:.3f}", None)]),
    ]
    misses = [(kind, str(count), None) for kind, count in s.misses.items() if count]
    wrong = [
        (
            score.id,
            tbox.by_iri[score.answer].readable_name if score.answer else score.status.value,
            tbox.by_iri[score.target].readable_name,
            score.explanation,
        )
        for score in result.scores
        if not score.is_exact
    ]
    text = format_table(("measure", "value", "95 % interval"), [*rows, *misses])
    return text + ("\n" + format_table(("wrong", "answer", "gold", "explanation"), wrong) if wrong else "")


def _interval_text(interval: tuple[float, float]) -> str:
    return f"{interval[0]:.1f} to {interval[1]:.1f}"


def _tiers_text(result: "Evaluation") -> str:
    """Return the accuracy of each tier of a cascade; empty for a single grounder."""
    by_tier: dict[str, list[Score]] = {}
    for score in result.scores:
        prediction = result.grounding.by_path.get(score.id)
        by_tier.setdefault(prediction.chosen_by if prediction else "", []).append(score)
    if len(by_tier) < 2:
        return ""
    rows = [
        (
            tier,
            str(len(scores)),
            f"{100 * sum(score.is_exact for score in scores) / len(scores):.1f}",
            f"{100 * sum(score.is_accepted for score in scores) / len(scores):.1f}",
        )
        for tier, scores in by_tier.items()
    ]
    return "\n" + format_table(("tier", "objects", "exact %", "accepting a second label %"), rows)
