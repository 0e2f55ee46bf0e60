"""Arguments and options that several commands share."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from usd2kg.graph import GraphOptions
    from usd2kg.relations import RelationOptions
    from usd2kg.scene import ReadOptions

__all__ = [
    "AbbreviatedLength",
    "Abstains",
    "ClassSizes",
    "DataAddress",
    "Dictionary",
    "EveryPrim",
    "Evidence",
    "Exclude",
    "ExpandInstancers",
    "GraphPlace",
    "GrounderName",
    "Include",
    "JsonOutput",
    "Kinds",
    "MergeImports",
    "MetresPerUnit",
    "ObjectList",
    "OntologyFile",
    "ReadingOptions",
    "Regime",
    "RelatingOptions",
    "SceneFile",
    "SceneName",
    "Shapes",
    "StorePlace",
    "TimeCode",
    "UpAxis",
    "UpdateAddress",
    "WritingOptions",
]

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="A USD stage: .usd, .usda, .usdc or .usdz.")]
StorePlace = Annotated[
    str | None,
    typer.Option(
        "--store",
        metavar="FOLDER|URL",
        help="Where graphs are kept: a folder, or the address of a SPARQL 1.1 server; its credentials come from the "
        "environment: USD2KG_STORE_USER and USD2KG_STORE_PASSWORD, or USD2KG_STORE_TOKEN.",
    ),
]
GraphPlace = Annotated[
    str,
    typer.Argument(
        metavar="GRAPH",
        help="A graph that usd2kg build wrote, the folder of a store, or the address of a server.",
    ),
]
SceneName = Annotated[
    str | None,
    typer.Option(
        "--scene",
        metavar="NAME",
        help="Of a store, the scene to ask, by the last part of its IRI, its label or its IRI; default: all scenes.",
    ),
]
UpdateAddress = Annotated[
    str | None,
    typer.Option("--store-update", metavar="URL", help="Where the server takes updates; default: found by asking it."),
]
DataAddress = Annotated[
    str | None,
    typer.Option(
        "--store-data",
        metavar="URL",
        help="Where the server speaks the Graph Store Protocol; default: found by asking it.",
    ),
]
OntologyFile = Annotated[
    Path | None,
    typer.Option("--ontology", help="An OWL file whose classes to use; default: the built-in home ontology."),
]
GrounderName = Annotated[
    str,
    typer.Option(
        "--grounder",
        help="Who chooses the classes: lexical (default), dictionary, embedding, volume, or a language model: "
        "llm-A:MODEL is shown names, llm-B:MODEL the context too, llm-C:MODEL reasons first, llm-auto:MODEL goes by "
        "the name. MODEL is google:NAME, anthropic:NAME, openai:NAME, openai:NAME@URL for a server that speaks "
        "OpenAI's protocol, or gguf:FILE for weights in this process.",
    ),
]
Abstains = Annotated[
    bool,
    typer.Option(
        "--abstain", help="For the lexical grounder: where candidates are split, take the class above; default: not."
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

RelationKinds = Annotated[
    str | None,
    typer.Option(
        "--relation-kinds",
        help="Spatial relations to find, comma-separated: on, inside, above, below, touching, next-to, near, room, "
        "part-of (these by default), between, or all.",
    ),
]
RelationRulesOption = Annotated[
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


@dataclass(frozen=True)
class WritingOptions:
    """How the graph is to be written."""

    annotations: Annotations = "owl"
    colors: Colors = "usd"
    time_of_run: TimeOfRun = None

    def graph_options(self) -> "GraphOptions":
        """Return the same for the writer; SOURCE_DATE_EPOCH is a time, too."""
        from usd2kg.graph import GraphOptions, read_epoch, read_time  # noqa: PLC0415

        epoch = os.environ.get("SOURCE_DATE_EPOCH")
        time = read_time(self.time_of_run) if self.time_of_run else read_epoch(epoch) if epoch else None
        return GraphOptions(self.annotations, self.colors, time)


@dataclass(frozen=True)
class RelatingOptions:
    """Which spatial relations are found, and how."""

    relation_kinds: RelationKinds = None
    relation_rules: RelationRulesOption = None
    viewpoint: ViewpointOption = None

    def relation_options(self) -> "RelationOptions":
        """Return the same for the finder."""
        from usd2kg.relations import RelationOptions, load_rules, parse_kinds, parse_viewpoint  # noqa: PLC0415 - opens OpenUSD, too slow for --help

        seen_from = parse_viewpoint(self.viewpoint) if self.viewpoint is not None else None
        return RelationOptions(
            kinds=parse_kinds(self.relation_kinds, seen_from) if self.relation_kinds is not None else None,
            viewpoint=seen_from,
            rules=load_rules(self.relation_rules),
        )


@dataclass(frozen=True)
class ReadingOptions:
    """How the stage is to be read."""

    metres_per_unit: MetresPerUnit = None
    up_axis: UpAxis = None
    time_code: TimeCode = None
    expand_instancers: ExpandInstancers = False
    include: Include = None
    exclude: Exclude = None
    kind: Kinds = None
    objects: ObjectList = None
    every_prim: EveryPrim = False

    def read_options(self) -> "ReadOptions":
        """Return the same for the reader."""
        from usd2kg.grounding import read_paths  # noqa: PLC0415
        from usd2kg.scene import ReadOptions, SelectionOverrides  # noqa: PLC0415 - opens OpenUSD, too slow for --help

        return ReadOptions(
            metres_per_unit=self.metres_per_unit,
            up_axis=self.up_axis,
            time=self.time_code,
            expand_instancers=self.expand_instancers,
            selection=SelectionOverrides(
                include=tuple(self.include or ()),
                exclude=tuple(self.exclude or ()),
                kinds=tuple(self.kind or ()),
                only=tuple(read_paths(self.objects)) if self.objects is not None else (),
                is_every_prim=self.every_prim,
            ),
        )
