"""The options of classes that a person decides."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.cli.output import emit, notify
from usd2kg.errors import GroundingError
from usd2kg.files import check_writable

if TYPE_CHECKING:
    from usd2kg.diff import CarriedDecisions
    from usd2kg.grounding import Carried, Grounding
    from usd2kg.ontology import ClassIRI, TBox
    from usd2kg.scene import ReadOptions, Scene

__all__ = ["CarryOverOptions", "ReviewOptions"]

_COLUMNS = ("path", "decision", "decided_for", "reason")


@dataclass(frozen=True)
class ReviewOptions(OptionBundle):
    """Decisions of a person, and the queue of open ones."""

    output_options = frozenset({"queue"})

    decisions: Annotated[
        Path | None,
        typer.Option(
            "--decisions",
            help="Classes that a person chose, used instead of the grounder's: CSV path,decision, or the curated and "
            "reviewed rows of SSSOM (.tsv).",
        ),
    ] = None
    person: Annotated[
        float, typer.Option("--person", min=0, max=1, help="Confidence below which an object goes into the --queue.")
    ] = 0.5
    queue: Annotated[
        Path | None,
        typer.Option("--queue", help="CSV file to write: the objects that a person should decide, for --decisions."),
    ] = None

    def read(self, tbox: "TBox") -> "dict[str, ClassIRI]":
        """Return prim path → class that a person chose.

        Raises:
            GroundingError: the file cannot be read.
        """
        from usd2kg.grounding import read_decisions  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        return read_decisions(self.decisions, tbox) if self.decisions is not None else {}

    def write_queue(self, grounding: "Grounding", tbox: "TBox") -> None:
        """Write the queue, if its file is given."""
        from usd2kg.grounding import format_queue, unsure_of  # noqa: PLC0415

        if self.queue is not None:
            waiting = unsure_of(grounding, self.person)
            emit(format_queue(waiting, tbox), self.queue)
            notify(f"{len(waiting)} objects to review in {self.queue}; fill in the column decision for --decisions")


@dataclass(frozen=True)
class CarryOverOptions(OptionBundle):
    """Decisions about an earlier version of the scene."""

    output_options = frozenset({"unplaced", "carried"})

    previous: Annotated[
        Path | None,
        typer.Option(
            "--previous",
            metavar="OLD",
            help="Graph or stage that the --decisions were made for; they are carried over to objects that were "
            "renamed or moved since. Default: the scene itself.",
        ),
    ] = None
    unplaced: Annotated[
        Path | None, typer.Option("--unplaced", help="CSV file to write: decisions without an object in the scene.")
    ] = None
    carried: Annotated[
        Path | None,
        typer.Option("--carried", help="CSV file to write: the decisions with current prim paths, for --decisions."),
    ] = None

    def check(self, decisions: Path | None, scene_count: int) -> None:
        """Check the options before anything is read.

        Raises:
            GroundingError: they come without decisions, without an earlier version, or with several scenes.
            OutputError: a file cannot be written.
        """
        if self.previous is None:
            if self.unplaced or self.carried:
                raise GroundingError("--unplaced and --carried need the earlier scene; name it with --previous OLD")
            return
        if decisions is None:
            raise GroundingError("--previous needs decisions of a person; name their file with --decisions FILE")
        if scene_count > 1:
            raise GroundingError(f"--previous takes one scene, found {scene_count}; build them one by one")
        for path in filter(None, (self.unplaced, self.carried)):
            check_writable(path)

    def carry_over(
        self, decisions: "Mapping[str, ClassIRI]", scene: "Scene", options: "ReadOptions"
    ) -> "tuple[Mapping[str, ClassIRI], Mapping[str, Carried]]":
        """Return the decisions for a scene, and the origin of each that was made for another prim path.

        Logs what was carried over, and writes the files.
        """
        if self.previous is None:
            return decisions, {}
        from usd2kg.diff import carry_decisions, things_of_scene  # noqa: PLC0415
        from usd2kg.diff.versions import read_things  # noqa: PLC0415

        found = carry_decisions(decisions, read_things(self.previous, options), things_of_scene(scene))
        _log_decisions(found, len(decisions))
        if self.unplaced is not None:
            _write_rows([(each.prim_path, each.class_iri, "", each.reason) for each in found.unplaced], self.unplaced)
        if self.carried is not None:
            _write_rows(_placed_rows(found), self.carried)
        return found.decisions, found.carried


def _log_decisions(found: "CarriedDecisions", count: int) -> None:
    for path, origin in found.carried.items():
        notify(f"decision: {origin.prim_path} → {path} ({origin.reason})")
    for each in found.unplaced:
        notify(f"decision not placed: {each.prim_path} <{each.class_iri}>: {each.reason}")
    kept = len(found.decisions) - len(found.carried)
    notify(f"{count} decisions: {kept} kept, {len(found.carried)} carried over, {len(found.unplaced)} not placed")


def _placed_rows(found: "CarriedDecisions") -> list[tuple[str, ...]]:
    return [
        (path, iri, *((origin.prim_path, origin.reason) if (origin := found.carried.get(path)) else ("", "")))
        for path, iri in found.decisions.items()
    ]


def _write_rows(rows: list[tuple[str, ...]], path: Path) -> None:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([_COLUMNS, *rows])
    emit(text.getvalue(), path)
