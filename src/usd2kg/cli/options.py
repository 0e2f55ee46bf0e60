"""Arguments and options that several commands share."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from usd2kg.graph import GraphOptions
    from usd2kg.scene import ReadOptions

__all__ = [
    "AbbreviatedLength",
    "Abstains",
    "Annotations",
    "Cascade",
    "ClassSizes",
    "ClassTree",
    "Colors",
    "CompletionsFile",
    "Dictionary",
    "DryRun",
    "EachObject",
    "EveryPrim",
    "Evidence",
    "Exclude",
    "ExpandInstancers",
    "GrounderName",
    "Include",
    "JsonOutput",
    "Kinds",
    "MergeImports",
    "MetresPerUnit",
    "MoreEvidence",
    "ObjectList",
    "ObjectsPerPrompt",
    "OntologyFile",
    "Refresh",
    "Regime",
    "Replay",
    "SceneFile",
    "Shapes",
    "Shortlist",
    "Shuffle",
    "Thinking",
    "TimeCode",
    "TimeOfRun",
    "TokenBudget",
    "UpAxis",
    "graph_options",
    "read_options",
]

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="A USD stage: .usd, .usda, .usdc or .usdz.")]
OntologyFile = Annotated[
    Path | None,
    typer.Option("--ontology", help="An OWL file whose classes to use; default: the built-in home ontology."),
]
GrounderName = Annotated[
    str,
    typer.Option(
        "--grounder",
        help="Who chooses the classes: embedded (default), dictionary, embedding, volume, or a language model: "
        "llm-A:MODEL is shown names, llm-B:MODEL the context too, llm-C:MODEL reasons first. MODEL is google:NAME, "
        "anthropic:NAME, openai:NAME, or openai:NAME@URL for a server that speaks OpenAI's protocol.",
    ),
]
ObjectsPerPrompt = Annotated[
    int, typer.Option("--objects-per-prompt", min=1, help="Objects that one prompt asks about; default: 1.")
]
ClassTree = Annotated[bool, typer.Option("--class-tree", help="Show a model the classes as a tree instead of a list.")]
Thinking = Annotated[bool, typer.Option("--thinking", help="Let a model reason by itself before it answers.")]
EachObject = Annotated[
    bool, typer.Option("--each-object", help="Ask about each object, alike ones too; default: once for alike ones.")
]
TokenBudget = Annotated[
    int | None, typer.Option("--token-budget", min=1, help="Tokens after which a model is asked no more.")
]
CompletionsFile = Annotated[
    Path | None,
    typer.Option("--completions", help="File that keeps what models said; default: $USD2KG_CACHE or the user's cache."),
]
Refresh = Annotated[bool, typer.Option("--refresh", help="Ask a model again for what it has said before.")]
MoreEvidence = Annotated[
    bool, typer.Option("--more-evidence", help="Show a model asset, labels, materials, parts and documentation too.")
]
Shuffle = Annotated[
    int | None, typer.Option("--shuffle", help="Show a model the classes in a random order with this seed.")
]
Shortlist = Annotated[
    int | None,
    typer.Option(
        "--shortlist", min=1, help="Offer a model only so many classes that the embedded grounder likes best."
    ),
]
Cascade = Annotated[
    float | None,
    typer.Option(
        "--cascade", min=0, max=1, help="Ask a model only where the embedded grounder is less confident than this."
    ),
]
Replay = Annotated[
    bool, typer.Option("--replay", help="Take from a model only what it has said before; ask nobody, no key needed.")
]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Print the prompts for a model and their tokens; ask nobody.")]
Abstains = Annotated[
    bool,
    typer.Option(
        "--abstain", help="For the embedded grounder: where candidates are split, take the class above; default: not."
    ),
]
Dictionary = Annotated[
    Path | None,
    typer.Option("--dictionary", help="For the dictionary grounder: a CSV file name,class; default: Multiverse's."),
]
Regime = Annotated[
    str,
    typer.Option("--regime", help="How names are masked: semantic (default), abbreviated, opaque, opaque-anonymous."),
]
Evidence = Annotated[
    str | None,
    typer.Option(
        "--evidence",
        help="Evidence that may be used, comma-separated: name, geometry, position, hierarchy, asset, materials, "
        "parts; default: all.",
    ),
]
AbbreviatedLength = Annotated[
    int, typer.Option("--abbreviated-length", min=1, help="Letters kept of each word in the abbreviated regime.")
]
ClassSizes = Annotated[
    Path | None,
    typer.Option("--class-sizes", help="For the volume grounder: a CSV file of usual sizes; default: our own."),
]
JsonOutput = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]
Shapes = Annotated[
    bool, typer.Option("--shapes", help="Measure the form of each object, too: true size, volume, what it holds.")
]
MetresPerUnit = Annotated[
    float | None, typer.Option("--metres-per-unit", help="Length of a stage unit; default: what the stage says.")
]
UpAxis = Annotated[str | None, typer.Option("--up-axis", help="Y or Z; default: what the stage says.")]
TimeCode = Annotated[
    float | None, typer.Option("--time", help="Time code to read; default: the earliest sample of each attribute.")
]
ExpandInstancers = Annotated[
    bool, typer.Option("--expand-instancers", help="Make an object of each copy of a point instancer.")
]
Include = Annotated[
    list[str] | None,
    typer.Option(
        "--include", help="Path pattern (* in a name, ** across): objects whatever the rules say. Repeatable."
    ),
]
Exclude = Annotated[
    list[str] | None,
    typer.Option("--exclude", help="Path pattern: no objects, nor anything below. Repeatable."),
]
Kinds = Annotated[
    list[str] | None, typer.Option("--kind", help="Model kind that makes an object, instead of component. Repeatable.")
]
ObjectList = Annotated[
    Path | None, typer.Option("--objects", help="CSV file with a column path: just these prims are objects.")
]
Annotations = Annotated[
    str,
    typer.Option(
        "--annotations",
        help="How statements are annotated with confidence and reasons: owl (default), or rdf12, the triple terms of "
        "RDF 1.2, which OWL tools do not read.",
    ),
]
Colors = Annotated[
    str,
    typer.Option(
        "--colors",
        help="How the soma profile writes colours: usd (default), or knowrob, as KnowRob asks for them, which makes "
        "the graph inconsistent with SOMA.",
    ),
]
TimeOfRun = Annotated[
    str | None,
    typer.Option(
        "--time-of-run",
        help="When the graph was made: now, or ISO 8601 with a time zone; default: SOURCE_DATE_EPOCH if that is set, "
        "else no time, so that the same input gives the same bytes.",
    ),
]
MergeImports = Annotated[
    bool,
    typer.Option(
        "--merge-imports",
        help="Put the ontology, all that it imports and usd2kg's vocabulary into the graph, so that it needs no other "
        "file.",
    ),
]
EveryPrim = Annotated[bool, typer.Option("--every-prim", help="Every prim that is or holds geometry is an object.")]


def graph_options(annotations: str, colors: str, time_of_run: str | None) -> "GraphOptions":
    """Return how the graph is to be written, as the user says it on the command line and in SOURCE_DATE_EPOCH."""
    from usd2kg.graph import GraphOptions, read_epoch, read_time  # noqa: PLC0415

    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    time = read_time(time_of_run) if time_of_run else read_epoch(epoch) if epoch else None
    return GraphOptions(annotations, colors, time)


def read_options(
    metres_per_unit: float | None,
    up_axis: str | None,
    time: float | None,
    expand_instancers: bool,
    include: list[str] | None,
    exclude: list[str] | None,
    kinds: list[str] | None,
    objects: Path | None,
    every_prim: bool,
) -> "ReadOptions":
    """Return how the stage is to be read, as the user says it on the command line."""
    from usd2kg.grounding import read_paths  # noqa: PLC0415
    from usd2kg.scene import ReadOptions, SelectionOverrides  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    return ReadOptions(
        metres_per_unit=metres_per_unit,
        up_axis=up_axis,
        time=time,
        expand_instancers=expand_instancers,
        selection=SelectionOverrides(
            include=tuple(include or ()),
            exclude=tuple(exclude or ()),
            kinds=tuple(kinds or ()),
            only=tuple(read_paths(objects)) if objects is not None else (),
            is_every_prim=every_prim,
        ),
    )
