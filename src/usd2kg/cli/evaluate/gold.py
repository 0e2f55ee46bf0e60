"""usd2kg eval annotate and eval agreement: gold labels, and the agreement of two annotators."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput, OntologyFile, SceneFile, TextFile
from usd2kg.cli.output import emit, format_optional, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.errors import EvaluationError

__all__ = ["agreement_command", "annotate_command"]


def annotate_command(
    scene: SceneFile,
    output: TextFile = None,
    force: Annotated[
        bool, Option("--force", help="Overwrite an existing file with its labels; default: refuse.")
    ] = False,
    suggest: Annotated[
        bool, Option("--suggest", help="Fill in the classes of the lexical grounder; default: leave them empty.")
    ] = False,
    ontology: OntologyFile = None,
) -> None:
    """Write a template for gold labels: a row for each object, with its evidence."""
    from usd2kg import grounding  # noqa: PLC0415
    from usd2kg.evaluation.template import gold_template  # noqa: PLC0415
    from usd2kg.files import check_apart  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    if output is not None and output.exists() and not force:
        raise EvaluationError(f"{output}: exists and may hold labels; choose another file, or overwrite with --force")
    check_apart([output], [scene, ontology])
    found = read_scene(scene)
    # The default of eval run, which reads the file.
    tbox = open_tbox(ontology)
    suggestions = grounding.ground(found, tbox, grounding.make_grounder("lexical")) if suggest else None
    emit(gold_template(found, suggestions, tbox), output)


def agreement_command(
    first: Annotated[Path, Argument(metavar="A", help="Gold file of one annotator.")],
    second: Annotated[Path, Argument(metavar="B", help="Gold file of another annotator for the same scene.")],
    ontology: OntologyFile = None,
    json: JsonOutput = False,
) -> None:
    """Measure the agreement of two gold files: exact, Cohen's kappa, with second labels accepted, and hierarchical."""
    from usd2kg.evaluation import read_gold  # noqa: PLC0415
    from usd2kg.evaluation.metrics import agreement as metric  # noqa: PLC0415
    from usd2kg.ontology import local_name  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    tbox = open_tbox(ontology)
    try:
        found = metric.agreement(read_gold(first, tbox), read_gold(second, tbox), tbox)
    except ValueError as error:
        raise EvaluationError(f"{first} and {second}: {error}; compare gold files of the same scene") from error
    rows = [(a.prim_path, local_name(a.target), local_name(b.target)) for a, b in found.disagreements]
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
        ("Cohen's kappa", format_optional(found.kappa, ".3f")),
        ("accepting second labels", f"{found.accepted:.3f}"),
        ("hierarchical F1", f"{found.hierarchical_f1:.3f}"),
    ]
    emit(format_table(("measure", "value"), measures))
    if rows:
        emit("\n" + format_table(("disagreement", "A", "B"), rows))
