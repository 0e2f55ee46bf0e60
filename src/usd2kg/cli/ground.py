"""usd2kg ground: the mapping of prims to classes, without a graph."""

from contextlib import ExitStack
from decimal import Decimal
from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.model_run import show_plan, tell_cost
from usd2kg.cli.options import (
    AbbreviatedLength,
    Abstains,
    Budget,
    Cascade,
    ClassSizes,
    ClassTree,
    CompletionsFile,
    Concurrency,
    Dictionary,
    DryRun,
    EachObject,
    EveryPrim,
    Evidence,
    Exclude,
    ExpandInstancers,
    GrounderName,
    Include,
    Kinds,
    MetresPerUnit,
    MoreEvidence,
    ObjectList,
    ObjectsPerPrompt,
    OntologyFile,
    Price,
    Refresh,
    Regime,
    Replay,
    RequestsPerMinute,
    SceneFile,
    Shortlist,
    Shuffle,
    Thinking,
    TimeCode,
    TokenBudget,
    UpAxis,
    read_options,
)
from usd2kg.cli.output import emit, talk
from usd2kg.errors import GroundingError

__all__ = ["ground_command"]


def ground_command(
    scene: SceneFile,
    ontology: OntologyFile = None,
    grounder: GrounderName = "embedded",
    objects_per_prompt: ObjectsPerPrompt = 1,
    class_tree: ClassTree = False,
    thinking: Thinking = False,
    each_object: EachObject = False,
    more_evidence: MoreEvidence = False,
    shuffle: Shuffle = None,
    shortlist: Shortlist = None,
    cascade: Cascade = None,
    token_budget: TokenBudget = None,
    budget: Budget = None,
    price: Price = None,
    concurrency: Concurrency = 4,
    requests_per_minute: RequestsPerMinute = None,
    completions: CompletionsFile = None,
    refresh: Refresh = False,
    replay: Replay = False,
    dry_run: DryRun = False,
    dictionary: Dictionary = None,
    abstain: Abstains = False,
    class_sizes: ClassSizes = None,
    regime: Regime = "semantic",
    abbreviated_length: AbbreviatedLength = 4,
    evidence: Evidence = None,
    paths: Annotated[
        Path | None, typer.Option("--paths", help="Answer only for the prims in the column 'path' of this CSV file.")
    ] = None,
    metres_per_unit: MetresPerUnit = None,
    up_axis: UpAxis = None,
    time_code: TimeCode = None,
    expand_instancers: ExpandInstancers = False,
    include: Include = None,
    exclude: Exclude = None,
    kind: Kinds = None,
    objects: ObjectList = None,
    every_prim: EveryPrim = False,
    file_format: Annotated[str, typer.Option("--format", help="csv (default) or json.")] = "csv",
    output: Annotated[Path | None, typer.Option("--output", "-o", help="File to write; default: stdout.")] = None,
) -> None:
    """Ground the objects of a scene: print path, class, label, confidence, status and grounder of each."""
    from usd2kg import grounding  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene, view_objects  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    groups = grounding.parse_evidence(evidence) if evidence is not None else None
    naming_regime = grounding.parse_regime(regime)
    grounding.check_format(file_format)
    if output is not None:
        check_writable(output)
    with ExitStack() as stack:
        asker = None
        if grounding.is_llm_name(grounder):
            from usd2kg.grounding.llm.settings import LLMSettings, open_llm_grounder, parse_llm_name  # noqa: PLC0415

            settings = LLMSettings(
                *parse_llm_name(grounder),
                objects_per_prompt=objects_per_prompt,
                is_tree=class_tree,
                is_thinking=thinking,
                is_each_object=each_object,
                has_more_evidence=more_evidence,
                shuffle_seed=shuffle,
                shortlist=shortlist,
                token_budget=token_budget,
                budget=None if budget is None else Decimal(str(budget)),
                price=price,
                concurrency=concurrency,
                requests_per_minute=requests_per_minute,
                completions=completions,
                is_refreshed=refresh,
                is_replayed=replay,
            )
            asker = stack.enter_context(open_llm_grounder(settings, is_dry=dry_run))
        else:
            _refuse({"--dry-run": dry_run or None, "--cascade": cascade, "--budget": budget, "--price": price})
        own = grounding.make_grounder(
            "embedded" if asker else grounder, dictionary=dictionary, class_sizes=class_sizes, abstains=abstain
        )
        tiers = grounding.CascadeGrounder(own, asker, cascade) if asker and cascade is not None else None
        wanted = grounding.read_paths(paths) if paths is not None else None
        tbox = open_tbox(ontology)
        options = read_options(
            metres_per_unit, up_axis, time_code, expand_instancers, include, exclude, kind, objects, every_prim
        )
        found = read_scene(scene, paths=wanted, options=options)
        if asker is not None and dry_run:
            views = view_objects(found, naming_regime, groups, abbreviated_length)
            shown = [view for obj, view in views if wanted is None or obj.prim_path in wanted]
            if tiers is not None:
                answers = own.ground_views([("", view) for view in shown], tbox)
                shown = [shown[index] for index in tiers.unsure(answers)]
            show_plan(asker.plan(shown, tbox), len(shown), asker.tariff, output)
            return
        result = grounding.ground(
            found,
            tbox,
            tiers or asker or own,
            regime=naming_regime,
            evidence=groups,
            paths=wanted,
            abbreviated_length=abbreviated_length,
        )
    emit(grounding.format_mapping(result, tbox, file_format), output)
    for path in found.missing_paths:
        talk(f"{scene}: there is no prim {path}; its row has the status missing")
    if tiers is not None:
        told = tiers.report
        talk(f"{told.sure} objects sure by themselves, {told.decided} decided by the model, {told.kept} left as it was")
    if asker is not None:
        tell_cost(asker.report, result)


def _refuse(options: dict[str, object]) -> None:
    """Raise an error for the first of the options that was given."""
    for option, value in options.items():
        if value is not None:
            raise GroundingError(f"{option} is about asking a model; say which one with --grounder llm-B:MODEL")
