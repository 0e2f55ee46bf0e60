"""usd2kg label: the classes of a run as semantic labels on the stage, and a linter for labels."""

from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer import Argument, Option
from typer.core import TyperGroup

from usd2kg.cli.finding_text import findings_text
from usd2kg.cli.limits import PATHS_PER_REASON
from usd2kg.cli.options.bundles import expand_bundles
from usd2kg.cli.options.common import AllFindings, JsonOutput, OntologyFile, SceneFile
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.output import count_noun, emit, notify, print_json
from usd2kg.errors import GroundingError, OutputError
from usd2kg.files import check_apart, check_writable, stem_of

if TYPE_CHECKING:
    from usd2kg.labels import LabelOptions, LabelReport

__all__ = ["app"]


class _DefaultsToWrite(TyperGroup):
    """A command group whose default command is `write`: `usd2kg label SCENE RUN`."""

    default_command = "write"

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Insert the default command unless the first argument is a command or asks for help."""
        if args and args[0] not in {*self.commands, *ctx.help_option_names}:
            args = [self.default_command, *args]
        return super().parse_args(ctx, args)


app = typer.Typer(
    cls=_DefaultsToWrite,
    no_args_is_help=True,
    help="Write classes to the stage as semantic labels, and check existing labels.",
)


@app.command("write")
def write_command(
    scene: SceneFile,
    run: Annotated[
        Path,
        Argument(
            metavar="RUN",
            help="Mapping of usd2kg ground, review queue with decisions, or graph (.csv, .json, .tsv, .ttl, …).",
        ),
    ],
    output: Annotated[
        Path | None,
        Option(
            "--output",
            "-o",
            help="Layer to write: .usda, .usdc or .usd; default: SCENE.labels.usda in the current folder.",
        ),
    ] = None,
    ontology: OntologyFile = None,
    encoding: Annotated[
        str,
        Option(
            "--encoding",
            help="Comma-separated encodings: semantics (UsdSemantics), isaac (legacy attributes of Isaac and "
            "Replicator), multiverse (tags that target class prims).",
        ),
    ] = "semantics",
    mode: Annotated[
        str,
        Option(
            "--mode",
            help="new: label only prims without labels; overwrite: replace class labels in all encodings; skip: keep "
            "all labels, add missing encodings and taxonomies.",
        ),
    ] = "new",
    at_least: Annotated[
        float, Option("--at-least", min=0, max=1, help="Confidence from which a class is written.")
    ] = 0.0,
    names: Annotated[
        str,
        Option("--names", help="Class names: local (last part of the IRI), label, or snake (the label in snake_case)."),
    ] = "local",
    ancestors: Annotated[
        bool, Option("--ancestors", help="Write the superclasses, too, the most general first.")
    ] = False,
    bare: Annotated[
        bool, Option("--bare", help="Write a layer of labels only; default: a root layer with the scene as sublayer.")
    ] = False,
    de_instance: Annotated[
        bool,
        Option(
            "--de-instance", help="Turn off instancing where prims inside an instance get labels; default: skip them."
        ),
    ] = False,
    json: JsonOutput = False,
) -> None:
    """Write a layer over a scene that labels prims with their classes. This is the default command."""
    from usd2kg.grounding.built_in_choice import stated_places  # noqa: PLC0415
    from usd2kg.labels import label_stage, read_prim_classes  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415

    target = output or Path(f"{stem_of(scene)}.labels.usda")
    check_writable(target)
    check_apart([target], [scene, run, ontology])
    with show_steps("ontology", "parse", "label", is_wanted=not json):
        tbox = open_tbox(ontology, stated=stated_places(run))
        options = _label_options(encoding, mode, bare, de_instance, {"ontology": tbox.ontology_iri, "run": run.name})
        report = label_stage(
            scene,
            read_prim_classes(run, tbox),
            tbox,
            target,
            options=options,
            style=names,
            has_ancestors=ancestors,
            min_confidence=at_least,
        )
    if json:
        print_json(
            {
                "scene": str(scene),
                "output": str(target),
                "counts": dict(report.counts),
                "de_instanced": report.de_instanced,
                "prims": [asdict(entry) for entry in report.outcomes],
            }
        )
        return
    for line in _report_lines(report):
        notify(line)
    notify(f"written to {target}")


def _label_options(
    encoding: str, mode: str, is_bare: bool, de_instances: bool, provenance: dict[str, str]
) -> "LabelOptions":
    from usd2kg.labels import LABEL_MODES, LabelOptions, parse_encodings  # noqa: PLC0415

    encodings = parse_encodings(encoding, "--encoding")
    chosen = next((known for known in LABEL_MODES if known == mode), None)
    if chosen is None:
        raise OutputError(f"--mode {mode}: expected one of {', '.join(LABEL_MODES)}")
    return LabelOptions(encodings, chosen, is_bare, de_instances, provenance)


def _report_lines(report: "LabelReport") -> Iterator[str]:
    """Yield the counts of outcomes and, for each reason, the number of prims and the first of them."""
    from usd2kg.labels import OUTCOMES  # noqa: PLC0415

    counts = ", ".join(f"{report.counts[outcome]} {outcome}" for outcome in OUTCOMES if outcome in report.counts)
    yield f"{count_noun(len(report.outcomes), 'prim')}: {counts or 'none'}"
    paths: dict[tuple[str, str], list[str]] = {}
    for entry in report.outcomes:
        if entry.reason:
            paths.setdefault((entry.outcome, _reason_kind(entry.reason)), []).append(entry.prim_path)
    for (outcome, reason), found in sorted(paths.items(), key=lambda item: -len(item[1])):
        more = "…" if len(found) > PATHS_PER_REASON else ""
        yield f"  {len(found)} {outcome}, {reason}: {', '.join(found[:PATHS_PER_REASON])}{more}"
    if report.de_instanced:
        instances = ", ".join(report.de_instanced[:PATHS_PER_REASON])
        yield f"  {len(report.de_instanced)} instances no longer instanced: {instances}"


def _reason_kind(reason: str) -> str:
    """Return a reason without the labels or instance named after its colon, to group similar reasons."""
    return reason if reason.startswith("the run has") else reason.partition(": ")[0]


@app.command("lint")
@expand_bundles
def lint_command(
    scene: SceneFile,
    reading: StageOptions,
    ontology: OntologyFile = None,
    run: Annotated[
        Path | None, Option("--run", help="Mapping or graph of the scene, to find stale labels; default: none.")
    ] = None,
    every: AllFindings = False,
    json: JsonOutput = False,
) -> None:
    """Find labels that are wrong, stale or contradictory. Exit code 1 if there are any."""
    # Loads OpenUSD, too slow for --help.
    from usd2kg.labels import lint_stage, ontologies_of_labels, read_prim_classes  # noqa: PLC0415
    from usd2kg.ontology import PLACES_IRI, SOMA_HOME  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415

    with show_steps("ontology", "parse", "lint", is_wanted=not json):
        others = ontologies_of_labels(scene) - {SOMA_HOME, PLACES_IRI} if ontology is None else set()
        if others:
            raise GroundingError(
                f"{scene}: the labels are classes of <{min(others)}>; give the file of that ontology with --ontology"
            )
        # The built-in TBox of places has the classes of both.
        tbox = open_tbox(ontology, stated=(PLACES_IRI,))
        classes = read_prim_classes(run, tbox) if run is not None else None
        lint = lint_stage(scene, tbox, classes, reading.read_options())
    if json:
        findings = [asdict(finding) for finding in lint.findings]
        print_json({"scene": str(scene), "prims": lint.prims, "counts": lint.counts(), "findings": findings})
    else:
        emit(findings_text(lint.findings, lint.prims, "labelled prim", is_complete=every))
    if lint.findings:
        raise typer.Exit(1)
