"""The options for a person's review decisions."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.errors import GroundingError
from usd2kg.files import check_writable

if TYPE_CHECKING:
    from usd2kg.grounding import Decision
    from usd2kg.ontology import TBox

__all__ = ["CarryOverOptions", "DecisionsFile", "ReviewOptions", "Reviewer"]

DecisionsFile = Annotated[
    Path | None,
    Option(
        "--decisions",
        help="Classes that a person chose, used instead of the grounder's: CSV path,decision, or the curated and "
        "reviewed rows of SSSOM (.tsv).",
    ),
]
Reviewer = Annotated[
    str | None,
    Option("--reviewer", metavar="NAME", help="Name or ORCID iD of the reviewer, for decisions without one."),
]


@dataclass(frozen=True)
class ReviewOptions(OptionBundle):
    """Decisions of a person, and the queue of open decisions."""

    output_options = frozenset({"queue"})

    decisions: DecisionsFile = None
    person: Annotated[
        float, Option("--person", min=0, max=1, help="Confidence below which an object goes into the --queue.")
    ] = 0.5
    queue: Annotated[
        Path | None,
        Option("--queue", help="CSV file to write: the objects that a person should decide, for --decisions."),
    ] = None

    reviewer: Reviewer = None

    def read(self, tbox: "TBox") -> "dict[str, Decision]":
        """Return prim path → decision.

        Raises:
            GroundingError: the file cannot be read, or there is a reviewer without a file.
        """
        from usd2kg.grounding import read_decisions  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        if self.decisions is None:
            if self.reviewer is not None:
                raise GroundingError(f"--reviewer {self.reviewer}: there are no decisions; give them with --decisions")
            return {}
        found = read_decisions(self.decisions, tbox)
        return {path: replace(made, reviewer=made.reviewer or self.reviewer or "") for path, made in found.items()}


@dataclass(frozen=True)
class CarryOverOptions(OptionBundle):
    """Decisions about an earlier version of the scene."""

    output_options = frozenset({"unplaced", "carried"})

    previous: Annotated[
        Path | None,
        Option(
            "--previous",
            metavar="OLD",
            help="Earlier graph or stage of the --decisions, to carry them over to renamed or moved objects; "
            "default: none.",
        ),
    ] = None
    unplaced: Annotated[
        Path | None, Option("--unplaced", help="CSV file to write: decisions without an object in the scene.")
    ] = None
    carried: Annotated[
        Path | None,
        Option("--carried", help="CSV file to write: the decisions with current prim paths, for --decisions."),
    ] = None

    def check(self, decisions: Path | None, scene_count: int) -> None:
        """Check the options before anything is read.

        Raises:
            GroundingError: there are no decisions, no earlier version, or several scenes.
            OutputError: a file cannot be written.
        """
        if self.previous is None:
            if self.unplaced or self.carried:
                raise GroundingError("--unplaced and --carried need the earlier scene; give it with --previous OLD")
            return
        if decisions is None:
            raise GroundingError("--previous needs a person's decisions; give their file with --decisions FILE")
        if scene_count > 1:
            raise GroundingError(f"--previous takes one scene, found {scene_count}; build them one by one")
        for path in filter(None, (self.unplaced, self.carried)):
            check_writable(path)
