"""usd2kg eval annotate, eval agreement: making gold labels, and how far two people's agree."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.evaluate.texts import number_text, short_name
from usd2kg.cli.options import JsonOutput, OntologyFile, SceneFile
from usd2kg.cli.output import emit, format_table, print_json
from usd2kg.errors import EvaluationError

__all__ = ["agreement_command", "annotate_command"]


def annotate_command(
    scene: SceneFile,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="File to write.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Write over an existing file, labels and all.")] = False,
    suggest: Annotated[bool, typer.Option("--suggest", help="Fill in the default grounder's answers.")] = False,
    ontology: OntologyFile = None,
) -> None:
    """Make a gold file to fill in: a row for each object, with what helps to decide."""
    from usd2kg import grounding  # noqa: PLC0415
    from usd2kg.evaluation.template import gold_template  # noqa: PLC0415
    from usd2kg.files import check_apart  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    if output is not None and output.exists() and not force:
        raise EvaluationError(
            f"{output}: exists, and may hold labels that took a person hours; choose another or --force"
        )
    check_apart([output], [scene, ontology])
    found = read_scene(scene)
    tbox = open_tbox(ontology)
    suggestions = grounding.ground(found, tbox, grounding.make_grounder("lexical")) if suggest else None
    emit(gold_template(found, suggestions, tbox), output)


def agreement_command(
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
    rows = [(a.prim_path, short_name(a.target), short_name(b.target)) for a, b in found.disagreements]
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
        ("Cohen's kappa", number_text(found.kappa, ".3f")),
        ("accepting second labels", f"{found.accepted:.3f}"),
        ("hierarchical F1", f"{found.hierarchical_f1:.3f}"),
    ]
    emit(format_table(("measure", "value"), measures), None)
    if rows:
        emit("\n" + format_table(("disagreement", "A", "B"), rows), None)
