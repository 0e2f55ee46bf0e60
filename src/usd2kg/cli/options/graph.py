"""The options for the relations and the modelling of a graph."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle

if TYPE_CHECKING:
    from usd2kg.graph import GraphOptions
    from usd2kg.relations import RelationOptions

__all__ = ["AnnotationOptions", "MergedImports", "Profile", "SpatialOptions"]

Profile = Annotated[
    str, Option("--profile", help="Modelling pattern: soma, plain, or auto (soma if the ontology uses SOMA).")
]
MergedImports = Annotated[
    bool,
    Option(
        "--merge-imports",
        help="Add the ontology, its imports and the usd2kg vocabulary, so the graph needs no other file.",
    ),
]


@dataclass(frozen=True)
class SpatialOptions(OptionBundle):
    """Kinds, rules and viewpoint of the spatial relations."""

    relation_kinds: Annotated[
        str | None,
        Option(
            "--relation-kinds",
            help="Comma-separated spatial relations to find: on, inside, attached-to, above, below, touching, next-to, "
            "near, room, connects, part-of, between, and with --viewpoint left, right, front, behind, or all; default: "
            "all but between.",
        ),
    ] = None
    relation_rules: Annotated[
        Path | None,
        Option(
            "--relations",
            help="TOML file that overrides thresholds and class lists; default: the built-in rules, see "
            "docs/relations.md.",
        ),
    ] = None
    viewpoint: Annotated[
        str | None,
        Option(
            "--viewpoint",
            help="Point x,y,z in metres, z up, from which left, right, front and behind are found, within 40 degrees; "
            "x,y,z,dx,dy,dz sets the viewing direction. Default: none, without these relations.",
        ),
    ] = None

    def relation_options(self) -> "RelationOptions":
        """Return the options of `find_relations`.

        Raises:
            GraphError: a kind is unknown, or the viewpoint or the file of rules cannot be read.
        """
        # Loads OpenUSD, too slow for --help.
        from usd2kg.relations import RelationOptions, load_rules, parse_kinds, parse_viewpoint  # noqa: PLC0415

        viewpoint = parse_viewpoint(self.viewpoint) if self.viewpoint is not None else None
        return RelationOptions(
            kinds=parse_kinds(self.relation_kinds, viewpoint) if self.relation_kinds is not None else None,
            viewpoint=viewpoint,
            rules=load_rules(self.relation_rules),
        )


@dataclass(frozen=True)
class AnnotationOptions(OptionBundle):
    """Annotations, colours and time stamp of the graph."""

    annotations: Annotated[
        str,
        Option(
            "--annotations",
            help="Annotation of statements with confidence and reason: owl, or rdf12 (RDF 1.2 triple terms, which OWL "
            "tools do not read).",
        ),
    ] = "owl"
    colors: Annotated[
        str,
        Option(
            "--colors",
            help="Colours in the soma profile: usd, or knowrob (as KnowRob reads them; inconsistent with SOMA).",
        ),
    ] = "usd"
    time_of_run: Annotated[
        str | None,
        Option(
            "--time-of-run",
            help="Time stamp of the graph: now, or ISO 8601 with a time zone; default: SOURCE_DATE_EPOCH if set, "
            "otherwise none, so that the same input gives the same bytes.",
        ),
    ] = None

    def graph_options(self) -> "GraphOptions":
        """Return the options of `instantiate`; without --time-of-run, SOURCE_DATE_EPOCH sets the time.

        Raises:
            GraphError: a value is unknown, or the time cannot be read.
        """
        from usd2kg.graph import GraphOptions, read_epoch, read_time  # noqa: PLC0415

        epoch = os.environ.get("SOURCE_DATE_EPOCH")
        time = read_time(self.time_of_run) if self.time_of_run else read_epoch(epoch) if epoch else None
        return GraphOptions(self.annotations, self.colors, time)
