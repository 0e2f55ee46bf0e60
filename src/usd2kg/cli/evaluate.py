"""usd2kg eval: measure grounding against gold labels."""

import json as jsonlib
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from usd2kg.cli.grounding_run import GroundingOptions, open_run
from usd2kg.cli.groups import with_groups
from usd2kg.cli.model_options import ModelOptions
from usd2kg.cli.options import AbbreviatedLength, JsonOutput, OntologyFile, SceneFile
from usd2kg.cli.output import emit, format_table, print_json, talk
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation import Evaluation, Score
    from usd2kg.evaluation.metrics.selection import SelectionScore
    from usd2kg.ontology import TBox

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="Measure grounding against gold labels.")

_GoldFile = Annotated[Path, typer.Option("--gold", help="Gold labels: CSV path,class,also.")]
_Output = Annotated[Path | None, typer.Option("--output", "-o", help="File to write.")]


@app.command("run")
@with_groups
def run(
    scene: SceneFile,
    gold: _GoldFile,
    chosen: GroundingOptions,
    asked: ModelOptions,
    ontology: OntologyFile = None,
    abbreviated_length: AbbreviatedLength = 4,
    output: _Output = None,
    json: JsonOutput = False,
) -> None:
    """Score one grounder on one scene; --output keeps every score for eval compare and eval calibrate."""
    from usd2kg import evaluation  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import ReadOptions, read_scene  # noqa: PLC0415

    if asked.dry_run:
        raise EvaluationError("--dry-run shows the prompts of one scene; expected it with usd2kg ground")
    if output is not None:
        check_writable(output)
    groups, naming_regime = chosen.groups, chosen.naming_regime
    tbox = open_tbox(ontology)
    labels = evaluation.read_gold(gold, tbox)
    found = read_scene(scene, paths=[label.prim_path for label in labels])
    if len(found.missing_paths) == len(labels):
        raise EvaluationError(
            f"{gold}: none of its {len(labels)} paths is on {scene}; is it the gold of another scene?"
        )
    with open_run(chosen, asked, found, tbox, scene, ReadOptions()) as opened:
        result = evaluation.evaluate(
            found,
            labels,
            tbox,
            opened.grounder,
            regime=naming_regime,
            evidence=groups,
            decisions=opened.decisions,
            abbreviated_length=abbreviated_length,
        )
    opened.tell(result.grounding, asked, tbox)
    selection = evaluation.selection_of(found, labels)
    data = evaluation.evaluation_json(result, selection)
    if output is not None:
        emit(jsonlib.dumps(data, indent=1, ensure_ascii=False) + "\n", output)
    if json:
        print_json(data)
    else:
        emit(_run_text(result, selection, tbox) + _tiers_text(result), None)


def _tiers_text(result: "Evaluation") -> str:
    """Return how right each tier of a cascade was; nothing for a single grounder."""
    by_tier: dict[str, list[Score]] = {}
    for score in result.scores:
        found = result.grounding.by_path.get(score.id)
        by_tier.setdefault(found.grounder if found else "", []).append(score)
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


@app.command("calibrate")
def calibrate(
    runs: Annotated[list[Path], typer.Argument(metavar="RUN...", help="Files by eval run --output, of one grounder.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="File to write, for --calibration.")],
) -> None:
    """Fit how likely a grounder's answers are right, by its confidences; for language models.

    Fit on scenes that you do not measure on.
    """
    from usd2kg import evaluation  # noqa: PLC0415
    from usd2kg.evaluation.metrics.calibration import calibration_error  # noqa: PLC0415
    from usd2kg.evaluation.stored import read_run  # noqa: PLC0415

    stored = [read_run(path) for path in runs]
    described = {run.description for run in stored}
    if len(described) > 1:
        raise EvaluationError(f"runs of different grounders: {'; '.join(sorted(described))}; expected those of one")
    scores = [score for run in stored for score in run.scores]
    scaling = evaluation.fit_scaling(scores, described.pop())
    scaled = [
        replace(score, confidence=None if score.confidence is None else scaling(score.confidence)) for score in scores
    ]
    emit(scaling.as_json(), output)
    before, after = calibration_error(scores), calibration_error(scaled)
    talk(
        f"fitted on {scaling.answers} answers: calibration error {_number(before, '.3f')} before, "
        f"{_number(after, '.3f')} after, on the same answers"
    )


def _run_text(result: "Evaluation", selection: "SelectionScore", tbox: "TBox") -> str:
    s = result.summary
    rows = [
        ("objects (distinct names)", f"{s.n} ({s.names})", None),
        ("answered", str(s.answered), None),
        ("exact match (EMA) %", f"{s.ema:.1f}", _interval(s.ema_interval)),
        ("  copies drawn together", None, _interval(s.ema_name_interval)),
        ("  each distinct name once %", f"{s.ema_by_name:.1f}", _interval(s.ema_by_name_interval)),
        ("  accepting a second label %", f"{s.ema_also:.1f}", _interval(s.ema_also_interval)),
        ("hierarchical F1 (HF1)", f"{s.hf1:.3f}", f"{s.hf1_interval.lower:.3f} to {s.hf1_interval.upper:.3f}"),
        ("calibration error", _number(s.calibration_error, ".3f"), None),
        ("EMA of the surest 80 %", _number(s.accuracy_at_80, ".1f"), None),
        ("object selection recall", f"{selection.recall:.3f}", None),
        ("object selection precision", _number(selection.precision, ".3f"), "against gold that may be incomplete"),
        ("seconds", f"{result.seconds:.3f}", None),
    ]
    misses = [(kind, str(count), None) for kind, count in s.misses.items() if count]
    wrong = [
        (
            score.id,
            tbox.by_iri[score.answer].local_name if score.answer else score.status.value,
            tbox.by_iri[score.target].local_name,
            score.explanation,
        )
        for score in result.scores
        if not score.is_exact
    ]
    text = format_table(("measure", "value", "95 % interval"), [*rows, *misses])
    return text + ("\n" + format_table(("wrong", "answer", "gold", "because"), wrong) if wrong else "")


def _interval(interval: tuple[float, float]) -> str:
    return f"{interval[0]:.1f} to {interval[1]:.1f}"


def _number(value: float | None, form: str) -> str | None:
    return None if value is None else format(value, form)


@app.command("reproduce")
def reproduce(
    matrix: Annotated[Path, typer.Argument(metavar="MATRIX", help="A TOML file; see docs/evaluation.md.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder for answers and reports.")] = Path("results"),
    refresh: Annotated[bool, typer.Option("--refresh", help="Ask again, whatever is stored.")] = False,
) -> None:
    """Run scenes × grounders × regimes × ablations and write tables, plots and a report.

    It resumes after an interruption and asks for no answer twice.
    """
    from usd2kg import evaluation  # noqa: PLC0415
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415

    plan = evaluation.read_matrix(matrix)
    total = sum(1 for cell in plan.cells() if cell.scene.missing is None)
    for scene in plan.scenes:
        if scene.missing is not None:
            talk(f"{scene.name} is left out: {scene.missing} does not exist")
    done = 0

    def tell(result: "evaluation.CellResult") -> None:
        nonlocal done
        done += 1
        cell, summary = result.cell, result.evaluation.summary
        stored = " (stored)" if result.was_stored else ""
        figures = f"EMA {summary.ema:.1f} HF1 {summary.hf1:.2f}"
        talk(f"[{done}/{total}] {cell.scene.name}, {cell.grounder}, {cell.condition}: {figures}{stored}")

    results = evaluation.run_matrix(plan, output, refresh=refresh, progress=tell)
    if not results:
        raise EvaluationError(f"{matrix}: no scene of it is here; mend the paths")
    for path in write_report(results, plan.title, output):
        emit(f"{path}\n", None)


@app.command("compare")
def compare(
    first: Annotated[Path, typer.Argument(metavar="A", help="A run kept by eval run --output.")],
    second: Annotated[Path, typer.Argument(metavar="B", help="Another run on the same scene and ontology.")],
    json: JsonOutput = False,
) -> None:
    """Compare two runs object by object, with McNemar's test."""
    from usd2kg.evaluation.metrics.intervals import mcnemar  # noqa: PLC0415
    from usd2kg.evaluation.stored import read_run  # noqa: PLC0415

    a, b = read_run(first), read_run(second)
    if a.ontology_hash != b.ontology_hash:
        raise EvaluationError(f"{first} and {second} used different ontologies; compare runs on the same one")
    others = {score.id: score for score in b.scores}
    pairs = [(score, others[score.id]) for score in a.scores if score.id in others]
    if not pairs:
        raise EvaluationError(f"{first} and {second} have no object in common; compare runs on the same scene")
    test = mcnemar(a.scores, b.scores)
    changed = [(x, y) for x, y in pairs if x.is_exact != y.is_exact]
    data: dict[str, Any] = {
        "n": len(pairs),
        "first": {"run": a.description, "ema": 100 * sum(x.is_exact for x, _ in pairs) / len(pairs)},
        "second": {"run": b.description, "ema": 100 * sum(y.is_exact for _, y in pairs) / len(pairs)},
        "only_first": test.only_first,
        "only_second": test.only_second,
        "p_value": test.p_value,
        "changed": [{"path": x.id, "target": x.target, "first": x.answer, "second": y.answer} for x, y in changed],
    }
    if json:
        print_json(data)
        return
    head = (
        f"A  {data['first']['ema']:.1f} %  {a.description}\nB  {data['second']['ema']:.1f} %  {b.description}\n"
        f"{data['n']} objects; only A right: {test.only_first}, only B right: {test.only_second}; "
        f"McNemar's exact p {_p_value(test.p_value)}\n"
    )
    rows = [(x.id, _short(x.target), _short(x.answer), _short(y.answer)) for x, y in changed]
    emit(head + (format_table(("differs", "gold", "A", "B"), rows) if rows else ""), None)


def _p_value(p: float) -> str:
    return "< 0.0001" if p < 0.0001 else f"= {p:.4f}"


def _short(iri: str | None) -> str | None:
    return iri.replace("#", "/").rpartition("/")[2] if iri else None


@app.command("annotate")
def annotate(
    scene: SceneFile,
    output: _Output = None,
    force: Annotated[bool, typer.Option("--force", help="Write over an existing file, labels and all.")] = False,
    suggest: Annotated[bool, typer.Option("--suggest", help="Fill in the default grounder's answers.")] = False,
    ontology: OntologyFile = None,
) -> None:
    """Make a gold file to fill in: a row for each object, with what helps to decide."""
    from usd2kg import grounding  # noqa: PLC0415
    from usd2kg.evaluation.template import gold_template  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    if output is not None and output.exists() and not force:
        raise EvaluationError(
            f"{output}: exists, and may hold labels that took a person hours; choose another or --force"
        )
    found = read_scene(scene)
    tbox = open_tbox(ontology)
    suggestions = grounding.ground(found, tbox, grounding.make_grounder("embedded")) if suggest else None
    emit(gold_template(found, suggestions, tbox), output)


@app.command("agreement")
def agreement(
    first: Annotated[Path, typer.Argument(metavar="A", help="A gold file.")],
    second: Annotated[Path, typer.Argument(metavar="B", help="Another person's gold file for the same scene.")],
    ontology: OntologyFile = None,
    json: JsonOutput = False,
) -> None:
    """Say how far two gold files agree: exactly, beyond chance, accepting second labels, hierarchically."""
    from usd2kg.evaluation import read_gold  # noqa: PLC0415
    from usd2kg.evaluation.metrics import agreement as measure  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    tbox = open_tbox(ontology)
    try:
        found = measure.agreement(read_gold(first, tbox), read_gold(second, tbox), tbox)
    except ValueError as error:
        raise EvaluationError(f"{first} and {second}: {error}; compare files for the same scene") from error
    rows = [(a.prim_path, _short(a.target), _short(b.target)) for a, b in found.disagreements]
    if json:
        print_json(
            {
                "n": found.n,
                "exact": found.exact,
                "kappa": found.kappa,
                "accepted": found.accepted,
                "hierarchical_f1": found.hierarchical_f1,
                "disagreements": [{"path": path, "first": a, "second": b} for path, a, b in rows],
                "only_first": list(found.only_first),
                "only_second": list(found.only_second),
            }
        )
        return
    measures = [
        ("labelled by both", str(found.n)),
        ("only in A, only in B", f"{len(found.only_first)}, {len(found.only_second)}"),
        ("same class", f"{found.exact:.3f}"),
        ("Cohen's kappa", _number(found.kappa, ".3f")),
        ("accepting second labels", f"{found.accepted:.3f}"),
        ("hierarchical F1", f"{found.hierarchical_f1:.3f}"),
    ]
    emit(format_table(("measure", "value"), measures), None)
    if rows:
        emit("\n" + format_table(("disagreement", "A", "B"), rows), None)


@app.command("kitchen-set")
def kitchen_set(
    folder: Annotated[Path, typer.Argument(metavar="PATH", help="Where your download of the Kitchen Set is unpacked.")],
    gold: Annotated[
        Path | None, typer.Option("--gold", help="Your gold labels; without them, only check and list the objects.")
    ] = None,
    ontology: OntologyFile = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder for answers and reports.")] = Path(
        "kitchen_set_results"
    ),
) -> None:
    """Check your download of Pixar's Kitchen Set, and run the study's matrix on it with your gold labels."""
    from usd2kg.evaluation import run_matrix  # noqa: PLC0415
    from usd2kg.evaluation.kitchen_set import check_kitchen_set, kitchen_matrix  # noqa: PLC0415
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    found = check_kitchen_set(folder)
    scene = read_scene(found.root)
    talk(f"{found.root}: {found.layer_count} layers, {len(scene.objects)} objects (the study has 125)")
    if gold is None:
        emit("".join(f"{obj.prim_path}\n" for obj in scene.objects), None)
        talk("label them with usd2kg eval annotate, then come back with --gold")
        return
    plan = kitchen_matrix(found, gold, ontology)
    for path in write_report(run_matrix(plan, output), plan.title, output):
        emit(f"{path}\n", None)
