"""Arguments and options that several commands share."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from usd2kg.graph import RelationOptions
    from usd2kg.scene import ReadOptions

__all__ = [
    "AbbreviatedLength",
    "Abstains",
    "Cascade",
    "ClassSizes",
    "ClassTree",
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
    "MetresPerUnit",
    "MoreEvidence",
    "ObjectList",
    "ObjectsPerPrompt",
    "OntologyFile",
    "Refresh",
    "Regime",
    "RelationKinds",
    "RelationRules",
    "Replay",
    "SceneFile",
    "Shapes",
    "Shortlist",
    "Shuffle",
    "Thinking",
    "TimeCode",
    "TokenBudget",
    "UpAxis",
    "ViewpointOption",
    "read_options",
    "relation_options",
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
EveryPrim = Annotated[bool, typer.Option("--every-prim", help="Every prim that is or holds geometry is an object.")]

RelationKinds = Annotated[
    str | None,
    typer.Option(
        "--relation-kinds",
        help="Spatial relations to find, comma-separated: on, inside, above, below, touching, next-to, near, room, "
        "part-of (these by default), between, or all.",
    ),
]
RelationRules = Annotated[
    Path | None,
    typer.Option(
        "--relations", help="TOML file of thresholds and class lists in place of our own, see docs/relations.md."
    ),
]
ViewpointOption = Annotated[
    str | None,
    typer.Option(
        "--viewpoint",
        help="x,y,z in metres, z up: from there left, right, front and behind are told, within 40 degrees; "
        "x,y,z,dx,dy,dz to look in one direction. Default: none, and no such relations.",
    ),
]


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


def relation_options(kinds: str | None, rules: Path | None, viewpoint: str | None) -> "RelationOptions":
    """Return which relations are to be found, and how, as the user says it on the command line."""
    from usd2kg.graph.relations import (  # noqa: PLC0415 - opens OpenUSD, too slow for --help
        RelationOptions,
        load_rules,
        parse_kinds,
        parse_viewpoint,
    )

    seen_from = parse_viewpoint(viewpoint) if viewpoint is not None else None
    return RelationOptions(
        kinds=parse_kinds(kinds, seen_from) if kinds is not None else None,
        viewpoint=seen_from,
        rules=load_rules(rules),
    )
