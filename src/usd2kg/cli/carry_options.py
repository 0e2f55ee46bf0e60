"""The options of keeping decisions where the scene has changed since."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.output import emit, printable, talk
from usd2kg.errors import GroundingError

if TYPE_CHECKING:
    from usd2kg.diff import CarriedDecisions, ObjectState
    from usd2kg.grounding import Carried
    from usd2kg.ontology import ClassIRI
    from usd2kg.scene import ReadOptions, Scene

__all__ = ["STAGE_ENDINGS", "CarryOptions"]

STAGE_ENDINGS = frozenset({".usd", ".usda", ".usdc", ".usdz"})
_COLUMNS = ("path", "decision", "decided_for", "reason")


@dataclass(frozen=True)
class CarryOptions:
    """Where the decided things were before, and where to keep what becomes of the decisions."""

    previous: Annotated[
        Path | None,
        typer.Option(
            "--previous",
            metavar="OLD",
            help="The graph or stage that the --decisions are about: they go with things that were renamed or moved.",
        ),
    ] = None
    unplaced: Annotated[
        Path | None,
        typer.Option("--unplaced", help="CSV file to write: the decisions that belong to nothing in the scene now."),
    ] = None
    carried: Annotated[
        Path | None,
        typer.Option("--carried", help="CSV file to write: the decisions under the paths of now, for --decisions."),
    ] = None

    def check(self, decisions: Path | None, scene_count: int) -> None:
        """Raise an error where these options cannot be heeded, before any work is spent.

        Raises:
            GroundingError: there are no decisions, no previous scene or several new ones.
            OutputError: a file cannot be written.
        """
        from usd2kg.files import check_writable  # noqa: PLC0415

        if self.previous is None:
            if self.unplaced or self.carried:
                raise GroundingError("--unplaced and --carried need the scene before; say where with --previous OLD")
            return
        if decisions is None:
            raise GroundingError("--previous is about decisions of a person; say where they are with --decisions FILE")
        if scene_count > 1:
            raise GroundingError(f"--previous is about one scene, and {scene_count} are given; build them one by one")
        for path in filter(None, (self.unplaced, self.carried)):
            check_writable(path)

    def carry(
        self, decisions: "Mapping[str, ClassIRI]", scene: "Scene", options: "ReadOptions"
    ) -> "tuple[Mapping[str, ClassIRI], Mapping[str, Carried]]":
        """Return the decisions for a scene, and where those come from that are about another path; tell on stderr."""
        if self.previous is None:
            return decisions, {}
        from usd2kg.diff import carry_decisions, objects_of_scene  # noqa: PLC0415 - too slow for --help

        found = carry_decisions(decisions, _things(self.previous, options), objects_of_scene(scene))
        _tell(found, len(decisions))
        if self.unplaced is not None:
            rows = [(each.prim_path, each.class_iri, "", each.reason) for each in found.unplaced]
            emit(_csv(rows), self.unplaced)
        if self.carried is not None:
            emit(_csv(_rows(found)), self.carried)
        return found.decisions, found.carried


def _things(path: Path, options: "ReadOptions") -> "tuple[ObjectState, ...]":
    from usd2kg.diff import objects_of_graph, objects_of_scene, read_statements  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    if path.suffix.lower() in STAGE_ENDINGS:
        return objects_of_scene(read_scene(path, options=options))
    return objects_of_graph(read_statements(path), str(path))


def _tell(found: "CarriedDecisions", count: int) -> None:
    for path, origin in found.carried.items():
        talk(f"decision: {printable(origin.prim_path)} → {printable(path)} ({printable(origin.reason)})")
    for each in found.unplaced:
        talk(f"decision not placed: {printable(each.prim_path)} <{each.class_iri}>: {printable(each.reason)}")
    kept = len(found.decisions) - len(found.carried)
    talk(f"{count} decisions: {kept} kept, {len(found.carried)} carried over, {len(found.unplaced)} not placed")


def _rows(found: "CarriedDecisions") -> list[tuple[str, str, str, str]]:
    origins = {path: found.carried.get(path) for path in found.decisions}
    return [
        (path, iri, *((origin.prim_path, origin.reason) if (origin := origins[path]) else ("", "")))
        for path, iri in found.decisions.items()
    ]


def _csv(rows: list[tuple[str, str, str, str]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([_COLUMNS, *rows])
    return text.getvalue()
