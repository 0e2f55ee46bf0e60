"""usd2kg label: the classes of a run as labels on the stage, and what is wrong with the labels of a stage."""

from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from usd2kg.cli.findings import MOST_OF_A_RULE, findings_text
from usd2kg.cli.groups import with_groups
from usd2kg.cli.options import JsonOutput, OntologyFile, ReadingOptions, SceneFile
from usd2kg.cli.output import emit, print_json, talk
from usd2kg.errors import OutputError

if TYPE_CHECKING:
    from usd2kg.labels import LabelOptions, LabelReport

__all__ = ["app"]

_ENCODINGS = {"semantics": "UsdSemantics", "isaac": "Isaac", "multiverse": "Multiverse"}
_MOST_PATHS = 3


class _WritesByDefault(TyperGroup):
    """A group whose command `write` may be left away: `usd2kg label SCENE RUN`."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Put the command in front where no command, and no call for help, stands there."""
        if args and args[0] not in {*self.commands, *ctx.help_option_names}:
            args = ["write", *args]
        return super().parse_args(ctx, args)


app = typer.Typer(
    cls=_WritesByDefault,
    no_args_is_help=True,
    help="Write classes back onto the stage as semantic labels, and check labels that are there.",
)

RunFile = Annotated[
    Path,
    typer.Argument(
        metavar="RUN",
        help="What usd2kg ground wrote (.csv, .json), a queue with decisions (.csv), or a graph (.ttl…).",
    ),
]


@app.command("write")
def write_command(
    scene: SceneFile,
    run: RunFile,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Layer to write: .usda, .usdc or .usd; default: SCENE.labels.usda here."),
    ] = None,
    ontology: OntologyFile = None,
    encoding: Annotated[
        str,
        typer.Option(
            "--encoding",
            help="How labels are written, comma-separated: semantics (OpenUSD's own, default), isaac (the older "
            "attributes of Isaac and Replicator), multiverse (tags that point to class prims).",
        ),
    ] = "semantics",
    mode: Annotated[
        str,
        typer.Option(
            "--mode",
            help="new (default): label only prims that have no label; overwrite: replace what says a prim's class, in "
            "all encodings; skip: keep all labels, add the encodings and taxonomies that are missing.",
        ),
    ] = "new",
    at_least: Annotated[
        float, typer.Option("--at-least", min=0, max=1, help="Label only what is this sure; default: all.")
    ] = 0.0,
    names: Annotated[
        str,
        typer.Option(
            "--names",
            help="How a class is written: local (the end of its IRI, default), label, or snake (its label in lower "
            "case, with underscores).",
        ),
    ] = "local",
    ancestors: Annotated[
        bool, typer.Option("--ancestors", help="Write the classes above, too, the most general first.")
    ] = False,
    bare: Annotated[
        bool, typer.Option("--bare", help="Write the labels alone; default: a root layer over the scene.")
    ] = False,
    de_instance: Annotated[
        bool, typer.Option("--de-instance", help="Break up instances inside which parts are to be labelled.")
    ] = False,
    json: JsonOutput = False,
) -> None:
    """Write a layer over a scene in which prims carry their classes as labels. `write` may be left away."""
    from usd2kg.files import check_apart, check_writable  # noqa: PLC0415
    from usd2kg.labels import label_stage, read_prim_classes  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    target = output or Path(f"{scene.stem}.labels.usda")
    check_writable(target)
    check_apart([target], [scene, run, ontology])
    tbox = open_tbox(ontology)
    options = _options(encoding, mode, bare, de_instance, {"ontology": tbox.ontology_iri, "run": run.name})
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
    for line in _told(report):
        talk(line)
    talk(f"written to {target}")


def _options(encoding: str, mode: str, is_bare: bool, de_instances: bool, provenance: dict[str, str]) -> "LabelOptions":
    from usd2kg.labels import LABEL_MODES, LabelOptions  # noqa: PLC0415

    wanted = [name.strip().lower() for name in encoding.split(",") if name.strip()]
    unknown = [name for name in wanted if name not in _ENCODINGS]
    if unknown or not wanted:
        raise OutputError(f"--encoding {encoding}: expected some of {', '.join(_ENCODINGS)}, comma-separated")
    chosen = next((known for known in LABEL_MODES if known == mode), None)
    if chosen is None:
        raise OutputError(f"--mode {mode}: expected one of {', '.join(LABEL_MODES)}")
    encodings: Any = tuple(_ENCODINGS[name] for name in dict.fromkeys(wanted))
    return LabelOptions(encodings, chosen, is_bare, de_instances, provenance)


def _told(report: "LabelReport") -> list[str]:
    """Return what became of the prims: counts, and for each reason how many prims and the first of them."""
    from usd2kg.labels import OUTCOMES  # noqa: PLC0415

    total = len(report.outcomes)
    parts = ", ".join(f"{report.counts[outcome]} {outcome}" for outcome in OUTCOMES if outcome in report.counts)
    lines = [f"{total} {'prim' if total == 1 else 'prims'}: {parts or 'none'}"]
    reasons = Counter((entry.outcome, _general(entry.reason)) for entry in report.outcomes if entry.reason)
    for (outcome, reason), count in reasons.most_common():
        paths = [e.prim_path for e in report.outcomes if (e.outcome, _general(e.reason)) == (outcome, reason)]
        shown = ", ".join(paths[:_MOST_PATHS]) + ("…" if count > _MOST_PATHS else "")
        lines.append(f"  {count} {outcome}, {reason}: {shown}")
    if report.de_instanced:
        shown = ", ".join(report.de_instanced[:_MOST_PATHS])
        lines.append(f"  {len(report.de_instanced)} instances broken up: {shown}")
    return lines


def _general(reason: str) -> str:
    """Return a reason without the labels and instances that it names, so that alike ones are told together."""
    return reason.partition(": ")[0] if not reason.startswith("the run has") else reason


@app.command("lint")
@with_groups
def lint_command(
    scene: SceneFile,
    reading: ReadingOptions,
    ontology: OntologyFile = None,
    run: Annotated[
        Path | None,
        typer.Option("--run", help="A mapping or graph of this scene: labels that say another class are stale."),
    ] = None,
    every: Annotated[
        bool, typer.Option("--all", help=f"Show every finding; default: the first {MOST_OF_A_RULE} of each rule.")
    ] = False,
    json: JsonOutput = False,
) -> None:
    """Find labels that are wrong, stale or contradict each other. Exit code 1 if there are any."""
    from usd2kg.labels import lint_stage, read_prim_classes  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    tbox = open_tbox(ontology)
    lint = lint_stage(scene, tbox, read_prim_classes(run, tbox) if run is not None else None, reading.read_options())
    if json:
        findings = [asdict(finding) for finding in lint.findings]
        print_json({"scene": str(scene), "prims": lint.prims, "counts": lint.counts(), "findings": findings})
    else:
        most = None if every else MOST_OF_A_RULE
        emit(findings_text(lint.findings, lint.prims, "labelled prim", most), None)
    if lint.findings:
        raise typer.Exit(1)
