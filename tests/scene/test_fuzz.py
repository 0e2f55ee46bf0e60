"""Mutated stages give a valid Scene or a SceneError of one line, in time and without output to the terminal."""

import itertools
import os
import random
import signal
import time
from dataclasses import replace
from pathlib import Path

import pytest

from tests.conftest import shared_file
from tests.scene.fuzz.corpus import as_crate, own_corpus, shared_corpus
from tests.scene.fuzz.inputs import input_cases
from tests.scene.fuzz.loop import Case, Tally, all_cases, fuzz, make_cases, scaled_cases
from tests.scene.fuzz.mutators import MUTATORS, mangle_bytes, paths_of
from tests.scene.fuzz.sanity import insane
from tests.scene.fuzz.worker import (
    CHECK_CHAIN,
    CHECK_INPUT,
    OPENUSDS,
    Judge,
    Outcome,
    Verdict,
    Worker,
    read_checked,
    write_files,
)
from tests.scene.usda import component, cube, xform
from usd2kg.scene import Box

CORPUS = own_corpus()


def check(tally: Tally, capsys):
    with capsys.disabled():
        for verdict, cases in tally.found.items():
            if verdict.outcome in OPENUSDS:
                print(f"\n{verdict.outcome}: {verdict.place} ({cases[0].name})", end="")
    assert not tally.failures, "\n".join(tally.failures)


def test_mangled_stages(capsys):
    tally = fuzz(itertools.islice(make_cases(CORPUS, seed=1), 120))
    assert sum(tally.outcomes.values()) == 120
    # Most mutations are small enough to leave a readable stage.
    assert tally.outcomes[Outcome.READ] > 36
    check(tally, capsys)


def test_mangled_stages_of_third_parties(capsys):
    shared_file("scenes/awkward")
    check(fuzz(itertools.islice(make_cases(shared_corpus(), seed=1), 60)), capsys)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3])
def test_many_mangled_stages(seed, capsys):
    check(fuzz(itertools.islice(all_cases(seed), 8_000)), capsys)


def test_mangled_ontologies_graphs_and_mappings():
    tally = fuzz(input_cases(1), 6, CHECK_INPUT)
    assert sum(tally.outcomes.values()) > 0
    assert not tally.failures, "\n".join(tally.failures)


@pytest.mark.slow
def test_the_whole_chain_of_mangled_stages(capsys):
    check(fuzz(scaled_cases(1), 120, CHECK_CHAIN), capsys)


# --- the cases ----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def judge(tmp_path_factory):
    judge = Judge(tmp_path_factory.mktemp("judge"))
    yield judge
    judge.close()


def test_every_stage_of_the_corpus_is_read_before_it_is_mangled(judge, tmp_path):
    crates = {name: as_crate(files, tmp_path) for name, files in CORPUS.items()}
    for files in (*CORPUS.values(), *crates.values()):
        assert judge.judge(files) == Verdict(Outcome.READ)
    assert judge.reader.starts == 1


def test_crates_are_crates(tmp_path):
    crate = as_crate(CORPUS["arcs"], tmp_path)
    assert list(crate) == ["scene.usdc", "base.usda"]
    assert crate["scene.usdc"].startswith(b"PXR-USDC")
    assert as_crate({"scene.usda": b"#usda 1.0\ndef {"}, tmp_path) is None


def test_the_same_seed_gives_the_same_cases():
    first, again, other = (list(itertools.islice(make_cases(CORPUS, seed), 40)) for seed in (5, 5, 6))
    assert first == again
    assert {case.files["scene.usda"] for case in first if "scene.usda" in case.files} != {
        case.files["scene.usda"] for case in other if "scene.usda" in case.files
    }
    assert sum("scene.usdc" in case.files for case in first) == 10


@pytest.mark.parametrize("mutate", MUTATORS, ids=lambda mutate: mutate.__name__)
def test_every_mutator_changes_text_and_accepts_any_text(mutate):
    rng = random.Random(0)
    text = CORPUS["materials"]["scene.usda"].decode()
    assert any(mutate(text, rng, []) != text for _ in range(5))
    for odd in ("x", "\n", "#usda 1.0\n", "{}}{", 'def "', "<", "@@", '"""'):
        for _ in range(20):
            assert isinstance(mutate(odd, rng, ["", odd]), str)


def test_any_bytes_are_changed():
    rng = random.Random(0)
    data = bytes(range(256))
    assert sum(mangle_bytes(data, rng) != data for _ in range(100)) > 90
    assert all(len(mangle_bytes(b"", rng)) < 300 for _ in range(100))


def test_paths_of_a_text():
    assert paths_of(xform("A", cube("b"), xform("c", cube("d")))) == ["/A", "/A/b", "/A/c", "/A/c/d"]
    assert paths_of("") == ["/"]


# --- invariants -------------------------------------------------------------------------------------


@pytest.fixture
def scene(read):
    return read(xform("World", component("A", cube("a")), component("B", cube("b"))))


def test_a_good_scene_is_sane(scene):
    assert list(insane(scene)) == []


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"prim_path": "/World/B"}, "prim path twice"),
        ({"parent_path": "/World/B"}, "parent that does not come before"),
        ({"box": Box((0, 0, 0), (1, -1, 1))}, "box not finite or inside out"),
        ({"own_box": Box((0, 0, 0), (1, float("inf"), 1))}, "own box not finite or inside out"),
        ({"part_boxes": (Box((0, 0, float("nan")), (1, 1, 1)),)}, "part box not finite or inside out"),
        ({"position": (0, float("nan"), 0)}, "position not finite"),
        ({"orientation": (0, 0, 0, 0.9)}, "orientation no unit quaternion"),
        ({"mass_kg": 0.0}, "mass not finite or not positive"),
        ({"mass_kg": float("inf")}, "mass not finite or not positive"),
        ({"display_color": (0, 0, float("nan"))}, "display colour not finite"),
        ({"name": "\ud800"}, "text that is not Unicode"),
    ],
)
def test_insane_objects(scene, change, problem):
    first, second = scene.objects
    assert problem in list(insane(replace(scene, objects=(replace(first, **change), second))))


# --- the child process --------------------------------------------------------------------------------

HERE = "tests.scene.test_fuzz"


def raise_other(path):
    return read_checked(None)


def obey(path):
    """Do what the name of the file says."""
    match Path(path).name:
        case "die":
            os.kill(os.getpid(), signal.SIGSEGV)
        case "sleep":
            time.sleep(60)
        case "talk":
            os.write(2, b"Warning: message\n")
        case "leave":
            os._exit(3)
    return Verdict(Outcome.READ)


@pytest.fixture(scope="module")
def worker(tmp_path_factory):
    worker = Worker(f"{HERE}:obey", tmp_path_factory.mktemp("worker"))
    yield worker
    worker.close()


def test_output_to_the_terminal_is_reported_once(worker):
    verdict = worker.ask(Path("talk"))
    assert (verdict.outcome, verdict.place) == (Outcome.TALKED, "Warning: message")
    starts = worker.starts
    assert worker.ask(Path("quiet")) == Verdict(Outcome.READ)
    assert worker.starts == starts


def test_a_worker_that_died_is_replaced(worker):
    worker.ask(Path("quiet"))
    starts = worker.starts
    assert worker.ask(Path("die")) == Verdict(Outcome.DIED, "SIGSEGV in OpenUSD")
    assert worker.ask(Path("leave")) == Verdict(Outcome.DIED, "exit 3 in OpenUSD")
    assert worker.ask(Path("quiet")) == Verdict(Outcome.READ)
    assert worker.starts == starts + 2


def test_a_worker_that_takes_too_long_is_replaced(worker):
    assert worker.ask(Path("sleep"), seconds=0.2).outcome == Outcome.HUNG
    assert worker.ask(Path("quiet")) == Verdict(Outcome.READ)


def test_unexpected_exceptions_are_reported_with_their_place(tmp_path):
    worker = Worker(f"{HERE}:raise_other", tmp_path)
    verdict = worker.ask(Path("any"))
    worker.close()
    assert verdict.outcome == Outcome.EXCEPTION
    assert verdict.place.startswith("TypeError in scene/stage.py:")


def test_a_file_that_is_no_stage_is_refused(judge):
    assert judge.judge({"scene.usda": b"no stage"}).outcome == Outcome.REFUSED


# --- the tally ----------------------------------------------------------------------------------------


def test_equal_faults_are_merged_and_faults_of_openusd_are_no_failures(tmp_path):
    tally = Tally()
    cases = [Case(f"1 {number} kinds", {"scene.usda": b"text"}) for number in range(9)]
    for case in cases[:5]:
        tally.add(case, Verdict(Outcome.INSANE, "position not finite", case.name))
    tally.add(cases[5], Verdict(Outcome.OPENUSD_DIED, "SIGSEGV in OpenUSD"))
    tally.add(cases[6], Verdict(Outcome.OPENUSD_BUSY, "OpenUSD"))
    tally.add(cases[7], Verdict(Outcome.READ))
    tally.add(cases[8], Verdict(Outcome.REFUSED))
    assert tally.failures == ["insane scene: position not finite (1 0 kinds) 1 0 kinds"]
    assert str(tally).splitlines()[0] == "      5 insane scene"
    tally.keep(tmp_path)
    # The first three of each fault.
    assert len(list(tmp_path.glob("insane_scene*/scene.usda"))) == 3
    assert (
        (tmp_path / "OpenUSD_died_SIGSEGV_in_OpenUSD_1_5_kinds" / "verdict.txt").read_text().startswith("OpenUSD died")
    )


def test_files_are_written_as_they_are(tmp_path):
    write_files({"a.usda": b"\0\xff", "b.usda": b""}, tmp_path / "new")
    assert (tmp_path / "new" / "a.usda").read_bytes() == b"\0\xff"
