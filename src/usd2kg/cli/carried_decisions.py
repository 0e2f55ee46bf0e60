"""Decisions of a person, carried over from an earlier version of the scene."""

import csv
import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.options.review import CarryOverOptions
from usd2kg.cli.output import count_noun, emit, notify

if TYPE_CHECKING:
    from usd2kg.diff import CarriedDecisions
    from usd2kg.grounding import Decision, DecisionOrigin
    from usd2kg.ontology import ClassIRI
    from usd2kg.scene import ReadOptions, Scene

__all__ = ["carry_over_decisions"]

_MAX_LISTED = 3
_COLUMNS = ("path", "decision", "decided_for", "reason", "reviewer", "comment", "time")


def carry_over_decisions(
    decisions: "Mapping[str, ClassIRI | Decision]", scene: "Scene", reading: "ReadOptions", options: CarryOverOptions
) -> "tuple[Mapping[str, ClassIRI | Decision], Mapping[str, DecisionOrigin]]":
    """Return the decisions for a scene, and the origin of each that was made for another prim path.

    Prints the carried decisions and those without an object to stderr, and writes the files of the options.
    """
    if options.previous is None:
        _report_missing([path for path in decisions if path not in scene.by_path], scene.source)
        return decisions, {}
    from usd2kg.diff import carry_decisions, objects_of_scene  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.diff.versions import read_objects  # noqa: PLC0415
    from usd2kg.grounding import NO_CLASS  # noqa: PLC0415

    found = carry_decisions(decisions, read_objects(options.previous, reading), objects_of_scene(scene))
    for path, origin in found.carried.items():
        notify(f"decision: {origin.prim_path} → {path} ({origin.reason})")
    for each in found.unplaced:
        notify(f"decision not placed: {each.prim_path} <{each.class_iri or NO_CLASS}>: {each.reason}")
    kept = len(found.decisions) - len(found.carried)
    counts = f"{kept} kept, {len(found.carried)} carried over, {len(found.unplaced)} not placed"
    notify(f"{len(decisions)} decisions: {counts}")
    if options.unplaced is not None:
        _write_rows(
            [(each.prim_path, each.class_iri or NO_CLASS, "", each.reason, "", "", "") for each in found.unplaced],
            options.unplaced,
        )
    if options.carried is not None:
        _write_rows(_placed_rows(found), options.carried)
    return found.decisions, found.carried


def _report_missing(paths: list[str], scene: str) -> None:
    if paths:
        listed = ", ".join(paths[:_MAX_LISTED]) + ("…" if len(paths) > _MAX_LISTED else "")
        notify(
            f"{count_noun(len(paths), 'decision')} not used: no object of {scene} has the path ({listed}); "
            "--previous OLD carries decisions over to renamed objects"
        )


def _placed_rows(found: "CarriedDecisions") -> list[tuple[str, ...]]:
    from usd2kg.grounding import NO_CLASS, as_decision  # noqa: PLC0415

    rows: list[tuple[str, ...]] = []
    for path, made in found.decisions.items():
        decision, origin = as_decision(made), found.carried.get(path)
        rows.append(
            (
                *(path, decision.class_iri or NO_CLASS),
                *((origin.prim_path, origin.reason) if origin is not None else ("", "")),
                *(decision.reviewer, decision.comment, decision.time),
            )
        )
    return rows


def _write_rows(rows: list[tuple[str, ...]], path: Path) -> None:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([_COLUMNS, *rows])
    emit(text.getvalue(), path)
