"""Journal: the decisions of reviewers in an SSSOM/TSV file that only grows.

Each row is one change of one object. The file is a valid input of `--decisions`: of several rows about a prim, the last
is current. Rows of one event are written at once and are on disk before `append` returns. A last row without line
break, which a crash can leave, is dropped.
"""

import csv
import io
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from usd2kg.append_only import AppendOnlyFile, whole_lines
from usd2kg.errors import GroundingError, OutputError
from usd2kg.graph.document_prefixes import document_prefixes
from usd2kg.graph.iris import individual_iri
from usd2kg.graph.vocabulary import named_node
from usd2kg.grounding.sssom_decisions import NO_TERM, VERDICT
from usd2kg.grounding.sssom_file import Curies, SssomFile, cell_text, format_sssom_file, read_sssom_file
from usd2kg.ontology import TBox
from usd2kg.studio.verdicts import Action, Event, Suggestion, Verdict, VerdictChange, VerdictKind

__all__ = ["Journal"]

_COLUMNS = (
    *("subject_id", "predicate_id", "object_id", "object_label", "mapping_justification"),
    *("reviewer_id", "reviewer_label", "review_date", "comment"),
    *("prim_path", VERDICT, "decided_at", "before"),
    *("event", "action", "actor", "time", "seen", "reverts", "concept", "proposal", "audit"),
    *("suggested", "suggested_confidence"),
)
_EXTENSIONS = {
    "prim_path": "u2k:primPath",
    VERDICT: "u2k:verdict",
    "decided_at": "dcterms:created",
    "before": "u2k:verdictBefore",
    "event": "u2k:event",
    "action": "u2k:action",
    "actor": "dcterms:contributor",
    "time": "dcterms:modified",
    "seen": "u2k:seenEvent",
    "reverts": "u2k:revertedEvent",
    "concept": "u2k:decidedConcept",
    "proposal": "u2k:proposedSubclass",
    "audit": "u2k:isAudit",
    "suggested": "u2k:suggestedClass",
    "suggested_confidence": "u2k:suggestedConfidence",
}
_REQUIRED = ("prim_path", "object_id", VERDICT, *_COLUMNS[-11:])
_EXPECTED = "expected the decisions of a studio project"
_ORCID = "https://orcid.org/"
_CURATED = "semapv:ManualMappingCuration"
_REVIEWED = "semapv:MappingReview"
"""Justification of verdicts that give no class."""


class Journal:
    """The file of events of one project. Only one process may have it open, see `Project`."""

    def __init__(self, path: Path, base: str, tbox: TBox) -> None:
        """Open the journal, or start it.

        Args:
            path: the file.
            base: namespace of the individuals.
            tbox: the classes.

        Raises:
            GroundingError: the file is not a journal.
            OutputError: it cannot be written.
        """
        self.path = path
        self._base = base
        self._tbox = tbox
        try:
            if not path.exists() or not path.stat().st_size:
                path.write_bytes(_header(base, tbox).encode())
                _sync_folder(path.parent)
            rows = whole_lines(path.read_bytes())
            file = read_sssom_file(path, rows.decode(), _REQUIRED, _EXPECTED)
            self._prefixes = file.prefixes
            self.events = _read_events(file, path)
            self._file = AppendOnlyFile(path, len(rows))
        except OSError as error:
            raise OutputError(f"{path}: cannot be opened ({error.strerror}); check its permissions") from error
        except UnicodeDecodeError as error:
            raise GroundingError(f"{path}: is not UTF-8 ({error}); {_EXPECTED}") from error

    def append(self, event: Event, before: Mapping[str, Verdict]) -> None:
        """Write an event to disk.

        Args:
            event: the event; its number follows that of the last one.
            before: prim path → verdict that was current before.

        Raises:
            OutputError: the disk is full or the file is gone; nothing was recorded.
        """
        text = io.StringIO(newline="")
        writer = csv.DictWriter(text, _COLUMNS, delimiter="\t", lineterminator="\n")
        writer.writerows(self._row(event, change, before[change.prim_path]) for change in event.changes)
        try:
            self._file.append(text.getvalue().encode())
        except OSError as error:
            raise OutputError(f"{self.path}: the decision is not saved ({error.strerror}); free some space") from error
        self.events.append(event)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _row(self, event: Event, change: VerdictChange, before: Verdict) -> dict[str, str]:
        verdict = change.verdict
        known = self._tbox.by_iri.get(verdict.class_iri or "")
        # An undo restores a verdict of somebody else; who gives none is the actor.
        reviewer = verdict.reviewer or event.reviewer
        has_id = named_node(reviewer) is not None
        is_settled = verdict.kind in {VerdictKind.CLASS, VerdictKind.NO_CLASS}
        return {
            "subject_id": self._shorten(individual_iri(self._base, change.prim_path)),
            "predicate_id": "rdf:type",
            "object_id": self._shorten(verdict.class_iri or NO_TERM),
            "object_label": cell_text(known.label) if known is not None else "",
            "mapping_justification": _CURATED if is_settled else _REVIEWED,
            "reviewer_id": self._shorten(reviewer) if has_id else "",
            "reviewer_label": "" if has_id else cell_text(reviewer).replace("|", r"\|"),
            "review_date": (verdict.time or event.time)[:10],
            "comment": cell_text(verdict.comment),
            "prim_path": change.prim_path,
            VERDICT: verdict.kind.value,
            "decided_at": verdict.time,
            "before": before.class_iri or before.kind.value,
            "event": str(event.number),
            "action": event.action.value,
            "actor": cell_text(event.reviewer),
            "time": event.time,
            "seen": str(event.seen),
            "reverts": str(event.reverts or ""),
            "concept": self._shorten(event.concept) if event.concept else "",
            "proposal": cell_text(verdict.proposal),
            "audit": "true" if event.is_audit else "",
            **self._suggested(change.suggested),
        }

    def _suggested(self, suggested: Suggestion | None) -> dict[str, str]:
        """Return the cells of what was suggested: empty without an answer."""
        if suggested is None:
            return {"suggested": "", "suggested_confidence": ""}
        confidence = "" if suggested.confidence is None else repr(suggested.confidence)
        return {"suggested": self._shorten(suggested.class_iri or NO_TERM), "suggested_confidence": confidence}

    def _shorten(self, iri: str) -> str:
        """Return the CURIE of an IRI; the IRI itself if the header does not declare its prefix."""
        curie = Curies(self._prefixes).shorten(iri)
        return curie if curie.partition(":")[0] in self._prefixes else iri


def _header(base: str, tbox: TBox) -> str:
    """Return an empty journal. It declares all prefixes that rows need: rows are appended, the header stays."""
    curies = Curies(
        {**document_prefixes(tbox), "orcid": _ORCID, "scene": base}, used=("dcterms", "orcid", "scene", "u2k", "xsd")
    )
    for cls in tbox.classes:
        curies.shorten(cls.iri)
    header = {
        "mapping_set_id": individual_iri(base, "/", "decisions"),
        "mapping_set_title": "Decisions of reviewers",
        "mapping_tool": "usd2kg",
        "license": "https://w3id.org/sssom/license/unspecified",
        "subject_type": "owl named individual",
        "object_type": "owl class",
        "predicate_type": "rdf property",
    }
    return format_sssom_file(header, curies, _EXTENSIONS, _COLUMNS, ())


def _read_events(file: SssomFile, path: Path) -> list[Event]:
    """Return the events; rows with the same number are one event.

    Raises:
        GroundingError: a row is not an event.
    """
    events: dict[int, Event] = {}
    for line, cells in file.rows:
        event = _read_event(f"{path}: line {line}", cells, file.expand)
        earlier = events.get(event.number)
        changes = (*(earlier.changes if earlier else ()), *event.changes)
        events[event.number] = replace(event, changes=changes)
    return list(events.values())


def _read_event(where: str, cells: Mapping[str, str], expand: Callable[[str], str]) -> Event:
    """Return the event of one row, with its one change."""
    try:
        number, seen, reverts = int(cells["event"]), int(cells["seen"]), int(cells["reverts"] or 0)
        action, kind = Action(cells["action"]), VerdictKind(cells[VERDICT])
        suggested = _read_suggestion(cells, expand)
    except ValueError as error:
        raise GroundingError(f"{where}: {error}; {_EXPECTED}") from error
    reviewer = expand(cells.get("reviewer_id", "")) or cells.get("reviewer_label", "").replace(r"\|", "|")
    iri = expand(cells["object_id"]) if kind is VerdictKind.CLASS else None
    who = "" if kind is VerdictKind.OPEN else reviewer
    verdict = Verdict(kind, iri, who, cells["decided_at"], cells.get("comment", ""), number, cells["proposal"])
    change = VerdictChange(cells["prim_path"], verdict, suggested)
    concept, is_audit = expand(cells["concept"]), cells["audit"] == "true"
    return Event(number, action, cells["actor"], cells["time"], (change,), seen, reverts, concept, is_audit)


def _read_suggestion(cells: Mapping[str, str], expand: Callable[[str], str]) -> Suggestion | None:
    """Return what was suggested when the decision of a row was made; None without an answer."""
    iri, confidence = expand(cells["suggested"]), cells["suggested_confidence"]
    return Suggestion(None if iri == NO_TERM else iri, float(confidence) if confidence else None) if iri else None


def _sync_folder(folder: Path) -> None:
    """Put the entry of a new file on disk; not every system can."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    with suppress(OSError):
        os.fsync(handle)
    os.close(handle)
