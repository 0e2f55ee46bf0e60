"""The journal of decisions: on disk before it is acknowledged, and read back as it was."""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.errors import GroundingError, OutputError
from usd2kg.grounding import Decision, read_decisions
from usd2kg.ontology import TBox
from usd2kg.studio.journal import Journal
from usd2kg.studio.review_state import ReviewState
from usd2kg.studio.verdicts import OPEN, Suggestion, Verdict, VerdictKind

BASE = "https://my.lab/k/"
TIME = "2026-11-27T10:00:00.000+00:00"


def open_journal(folder: Path, tbox: TBox) -> tuple[Journal, ReviewState]:
    journal = Journal(folder / "decisions.sssom.tsv", BASE, tbox)
    return journal, ReviewState(journal.events)


def decide(journal: Journal, review: ReviewState, paths: list[str], verdict: Verdict, reviewer: str = "Ann") -> None:
    suggested = dict.fromkeys(paths[:1], Suggestion(None, 0.1 + 0.2))
    event = review.decide(dict.fromkeys(paths, verdict), reviewer, TIME, review.version, suggested=suggested)
    journal.append(event, review.before(event))
    review.apply(event)


def cup(tbox: TBox) -> Verdict:
    return Verdict(VerdictKind.CLASS, tbox.resolve("Cup"), comment="has a handle")


def test_a_journal_is_read_back_as_it_was(tmp_path: Path, home_tbox: TBox):
    journal, review = open_journal(tmp_path, home_tbox)
    decide(journal, review, ["/A", "/B"], cup(home_tbox))
    decide(journal, review, ["/A"], Verdict(VerdictKind.NO_CLASS), "https://orcid.org/0000-0002-1825-0097")
    decide(journal, review, ["/B"], Verdict(VerdictKind.UNSURE))
    bowl = home_tbox.resolve("Bowl")
    about_cups = review.decide(
        {"/C": Verdict(VerdictKind.CLASS, bowl, proposal='Bowl "of" cups')},
        "Bob",
        TIME,
        0,
        suggested={"/C": Suggestion(bowl, None)},
        concept="http://wordnet-rdf.princeton.edu/id/03152175-n",
        is_audit=True,
    )
    journal.append(about_cups, review.before(about_cups))
    review.apply(about_cups)
    undone = review.undo("Ann", TIME)
    journal.append(undone, review.before(undone))
    review.apply(undone)
    journal.close()
    again, found = open_journal(tmp_path, home_tbox)
    assert again.events == journal.events
    assert [found.verdict(path) for path in ("/A", "/B", "/C", "/D")] == [
        *(review.verdict(path) for path in ("/A", "/B", "/C")),
        OPEN,
    ]
    again.close()


@pytest.mark.parametrize(
    ("text", "cell"),
    [("=1+1", "'=1+1"), ("'=1+1", "''=1+1"), ("red\x1b[2J cup", "red\N{REPLACEMENT CHARACTER}[2J cup")],
)
def test_a_text_is_no_formula_or_escape_sequence(tmp_path: Path, home_tbox: TBox, text: str, cell: str):
    journal, review = open_journal(tmp_path, home_tbox)
    decide(journal, review, ["/A"], Verdict(VerdictKind.UNSURE, comment=text), reviewer=text)
    journal.close()
    assert journal.path.read_text("utf-8").splitlines()[-1].split("\t").count(cell) == 3, "comment, reviewer and actor"
    again, found = open_journal(tmp_path, home_tbox)
    shown = text.replace("\x1b", "\N{REPLACEMENT CHARACTER}")
    assert (found.verdict("/A").comment, found.verdict("/A").reviewer) == (shown, shown)
    again.close()


def test_decisions_of_a_journal_are_those_that_are_valid(tmp_path: Path, home_tbox: TBox):
    journal, review = open_journal(tmp_path, home_tbox)
    decide(journal, review, ["/A", "/B", "/C", "/D"], cup(home_tbox))
    decide(journal, review, ["/A"], Verdict(VerdictKind.NO_CLASS), "Bo|b")
    decide(journal, review, ["/B"], Verdict(VerdictKind.UNSURE))
    decide(journal, review, ["/C"], OPEN)
    journal.close()
    assert read_decisions(journal.path, home_tbox) == {
        "/A": Decision(None, "Bo|b", time=TIME),
        "/D": Decision(home_tbox.resolve("Cup"), "Ann", "has a handle", TIME),
    }


def test_a_torn_last_row_is_dropped_and_the_file_is_continued(tmp_path: Path, home_tbox: TBox):
    journal, review = open_journal(tmp_path, home_tbox)
    decide(journal, review, ["/A"], cup(home_tbox))
    decide(journal, review, ["/B"], cup(home_tbox))
    journal.close()
    whole = journal.path.read_bytes()
    journal.path.write_bytes(whole[:-7])
    again, found = open_journal(tmp_path, home_tbox)
    assert found.verdict("/B") == OPEN
    decide(again, found, ["/B"], cup(home_tbox))
    again.close()
    assert again.path.read_bytes() == whole


def test_a_killed_process_loses_nothing_that_was_acknowledged(tmp_path: Path, home_tbox: TBox):
    script = f"""
import os, signal
from pathlib import Path
from tests.studio.test_journal import cup, decide, open_journal
from usd2kg.ontology import load_home_tbox
tbox = load_home_tbox()
journal, review = open_journal(Path({str(tmp_path)!r}), tbox)
for number in range(50):
    decide(journal, review, [f"/Object_{{number}}"], cup(tbox))
    print(number, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == -9, done.stderr
    journal, review = open_journal(tmp_path, home_tbox)
    assert [review.verdict(f"/Object_{n}").kind for n in range(50)] == [VerdictKind.CLASS] * len(
        done.stdout.splitlines()
    )
    journal.close()


def test_a_failed_write_changes_nothing(tmp_path: Path, home_tbox: TBox, monkeypatch: pytest.MonkeyPatch):
    journal, review = open_journal(tmp_path, home_tbox)
    decide(journal, review, ["/A"], cup(home_tbox))
    before = journal.path.read_bytes()

    def fail(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", fail)
    with pytest.raises(OutputError, match=r"the decision is not saved \(No space left on device\)"):
        decide(journal, review, ["/B"], cup(home_tbox))
    assert journal.path.read_bytes() == before
    assert review.verdict("/B") == OPEN
    assert [event.number for event in journal.events] == [1]
    journal.close()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps open files")
@pytest.mark.parametrize("is_replaced", [False, True])
def test_a_file_that_was_taken_away_is_an_error(tmp_path: Path, home_tbox: TBox, is_replaced: bool):
    journal, review = open_journal(tmp_path, home_tbox)
    decide(journal, review, ["/A"], cup(home_tbox))
    journal.path.rename(tmp_path / "elsewhere.tsv")
    if is_replaced:
        journal.path.write_text("")
    with pytest.raises(
        OutputError, match=r"the decision is not saved \(the file was moved or deleted while it was open\)"
    ):
        decide(journal, review, ["/B"], cup(home_tbox))
    assert review.verdict("/B") == OPEN
    journal.close()


def test_a_file_that_is_no_journal_is_refused(tmp_path: Path, home_tbox: TBox):
    (tmp_path / "decisions.sssom.tsv").write_text("path\tclass\n/A\tCup\n")
    with pytest.raises(GroundingError, match="line 1 has no column prim_path; expected the decisions of a studio"):
        open_journal(tmp_path, home_tbox)


@settings(max_examples=50, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.sampled_from(["decide", "undo", "redo"]),
            st.sampled_from(["Ann", "Bob"]),
            st.lists(st.sampled_from(["/A", "/B", "/C"]), min_size=1, max_size=3, unique=True),
            st.sampled_from(list(VerdictKind)),
            st.text(max_size=8),
        ),
        max_size=12,
    )
)
def test_every_sequence_of_acts_is_read_back(tmp_path_factory: pytest.TempPathFactory, acts):
    from usd2kg.ontology import load_home_tbox  # noqa: PLC0415

    tbox = load_home_tbox()
    folder = tmp_path_factory.mktemp("journal")
    journal, review = open_journal(folder, tbox)
    for act, who, paths, kind, comment in acts:
        iri = tbox.resolve("Cup") if kind is VerdictKind.CLASS else None
        if act == "decide":
            verdict = Verdict(kind, iri, comment=comment)
            event = review.decide(dict.fromkeys(paths, verdict), who, TIME, review.version)
        elif not (review.can_undo(who) if act == "undo" else review.can_redo(who)):
            continue
        else:
            event = review.undo(who, TIME) if act == "undo" else review.redo(who, TIME)
        journal.append(event, review.before(event))
        review.apply(event)
    journal.close()
    again, found = open_journal(folder, tbox)
    for path in ("/A", "/B", "/C"):
        expected, read = review.verdict(path), found.verdict(path)
        assert (read.kind, read.class_iri, read.reviewer) == (expected.kind, expected.class_iri, expected.reviewer)
        assert found.is_conflict(path) == review.is_conflict(path)
    for who in ("Ann", "Bob"):
        assert (found.can_undo(who), found.can_redo(who)) == (review.can_undo(who), review.can_redo(who))
    again.close()
