"""Errors that a user can mend: exit code 2, one line on stderr, nothing on stdout, nothing written."""

import os
import shutil
from pathlib import Path

import pytest

from tests.cli.conftest import Finished, Run


def check(done: Finished, *parts: str) -> None:
    """Assert that a command failed as errors of a user should, and that its line says `parts`."""
    assert done.code == 2
    assert done.out == ""
    assert len(done.err.splitlines()) == 1, done.err
    assert done.err.startswith("usd2kg: ")
    assert "Traceback" not in done.err
    assert [part for part in parts if part not in done.err] == []
    assert list(Path().iterdir()) == []


def write(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


SCENES = {
    "no file": (None, "no such file"),
    "text": (b"a shopping list", ""),
    "empty": (b"", ""),
    "broken layer": (b'#usda 1.0\ndef Xform "a" {', ""),
    "broken crate": (b"PXR-USDC" + bytes(80), ""),
    "no objects": (b'#usda 1.0\ndef Xform "World"\n{\n    def Camera "view" {}\n}\n', "no object"),
    "an image": (b"\x89PNG\r\n\x1a\n" + bytes(100), ""),
}


@pytest.mark.parametrize("command", ["build", "inspect", "ground"])
@pytest.mark.parametrize("case", SCENES)
def test_a_scene_that_cannot_be_read(run: Run, tmp_path: Path, command: str, case: str):
    data, said = SCENES[case]
    path = tmp_path / ("scene.usdc" if case == "broken crate" else "scene.usda")
    if data is not None:
        path.write_bytes(data)
    check(run(command, path), str(path), said)


@pytest.mark.parametrize("command", ["build", "inspect", "ground"])
def test_a_file_that_is_no_usd_by_name_or_is_a_folder(run: Run, tmp_path: Path, command: str):
    check(run(command, write(tmp_path / "room.txt", b"hello")), "room.txt")
    check(run(command, tmp_path), str(tmp_path))


ONTOLOGIES = {
    "no file": (None, "no such file"),
    "no ontology": (b"a shopping list of things", "not an ontology"),
    "does not parse": (b"@prefix : <urn:x#> .\n:a :b", "does not parse"),
    "binary": (b"\x00\xff\xfe\x80" * 40, "not UTF-8"),
    "no classes": (b"@prefix owl: <http://www.w3.org/2002/07/owl#> .\n<urn:x> a owl:Ontology .\n", "no class in scope"),
    "empty": (b"", ""),
}


@pytest.mark.parametrize("command", ["build", "ground", "show", "linearize", "scope"])
@pytest.mark.parametrize("case", ONTOLOGIES)
def test_an_ontology_that_cannot_be_read(run: Run, room: Path, tmp_path: Path, command: str, case: str):
    data, said = ONTOLOGIES[case]
    path = tmp_path / "onto.owl"
    if data is not None:
        path.write_bytes(data)
    arguments = [command, room, "--ontology", path] if command in {"build", "ground"} else ["ontology", command, path]
    check(run(*arguments), str(path), said)


@pytest.mark.parametrize("command", ["build", "ground"])
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--grounder", "oracle"], "grounder 'oracle' is unknown; expected one of lexical, dictionary"),
        (["--regime", "dark"], "regime 'dark' is unknown; expected one of semantic"),
        (["--evidence", "name,colour"], "group 'colour' is unknown; expected a list of asset"),
        (["--evidence", ""], "no group is named"),
        (["--grounder", "dictionary", "--dictionary", "none.csv"], "none.csv: cannot be read"),
        (["-o", "none/out.ttl"], "the folder none does not exist"),
    ],
)
def test_an_option_that_cannot_be(run: Run, room: Path, command: str, arguments: list[str], said: str):
    check(run(command, room, *arguments), said)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--profile", "owl"], "profile 'owl' is unknown; expected one of auto, soma, plain"),
        (["--base", "kitchen"], "base 'kitchen': expected an absolute IRI"),
        (["--base", ":/"], "base ':/': expected an absolute IRI"),
        (["--base", "https://my.lab/%zz/"], "expected an absolute IRI"),
        (["-o", "graph.json"], "the ending '.json' names no graph format; expected one of .ttl, .nt"),
        (["-o", "graph"], "the ending '' names no graph format"),
    ],
)
def test_an_option_of_build_that_cannot_be(run: Run, room: Path, arguments: list[str], said: str):
    check(run("build", room, *arguments), said)


def test_an_option_of_ground_that_cannot_be(run: Run, room: Path, tmp_path: Path):
    check(run("ground", room, "--format", "xlsx"), "format 'xlsx' is unknown; expected one of csv, json")
    check(run("ground", room, "--paths", "none.csv"), "none.csv: cannot be read")
    check(run("ground", room, "--paths", write(tmp_path / "p.csv", b"/a\n/b\n")), "expected a column 'path'")
    check(run("ground", room, "-o", tmp_path), "is a folder")


def test_a_folder_where_nothing_may_be_written(run: Run, room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    # Asked of the system and not tried with chmod: whoever may do everything would pass.
    locked = tmp_path / "locked"
    locked.mkdir()
    allowed = os.access
    monkeypatch.setattr(
        os, "access", lambda path, mode: allowed(path, mode) and not (Path(path) == locked and mode & os.W_OK)
    )
    for arguments in (["build", room, "-o", locked / "g.ttl"], ["ground", room, "-o", locked / "m.csv"]):
        check(run(*arguments), "is not writable")
    check(run("build", room, "-o", locked), "is not writable")
    check(run("demo", "-o", locked / "g.ttl"), "is not writable")
    assert list(locked.iterdir()) == []


def test_a_disk_that_is_full_leaves_the_old_graph(
    run: Run, room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    target = write(tmp_path / "room.ttl", b"old")

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", fail)
    check(run("build", room, "-o", target), "No space left on device")
    assert target.read_bytes() == b"old"
    assert not list(tmp_path.glob(".room*"))


def test_outputs_are_checked_before_the_scene_is_read(run: Run, tmp_path: Path):
    # Neither is there: the output is named, since it would be a pity to find out after an hour.
    check(run("build", tmp_path / "none.usda", "-o", "none/g.ttl"), "the folder none does not exist")
    check(run("ground", tmp_path / "none.usda", "-o", "none/m.csv"), "the folder none does not exist")
    check(run("demo", "-o", "none/g.ttl"), "the folder none does not exist")


def test_demo_wants_a_graph_ending(run: Run):
    check(run("demo", "-o", "kitchen.txt"), "names no RDF format")


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("none.ttl", None, "no such file"),
        ("graph.txt", b"", "names no RDF format"),
        ("graph.ttl", b"not turtle at all", "does not parse as Turtle"),
    ],
)
def test_a_graph_that_cannot_be_asked(run: Run, tmp_path: Path, name: str, data: bytes | None, said: str):
    if data is not None:
        write(tmp_path / name, data)
    check(run("query", tmp_path / name, "on", "table"), name, said)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["on", "unicorn"], "nothing is named 'unicorn'"),
        (["all", "of", "unicorns"], "no class is named 'unicorns'; expected one of artifact, bowl, cup, table"),
        (["sing"], "question 'sing' is not understood"),
        (["--sparql", "SELECT"], "not valid SPARQL"),
        (["--sparql", "DROP ALL"], "expected SELECT, ASK, CONSTRUCT or DESCRIBE"),
        (["--sparql", "@none.rq"], "none.rq: cannot be read as a query"),
        (["--sparql", "ASK { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }"], "query"),
    ],
)
def test_a_question_that_cannot_be_answered(run: Run, graph: Path, arguments: list[str], said: str):
    check(run("query", graph, *arguments), said)


@pytest.mark.parametrize("position", ["first", "last"])
def test_verbose_shows_the_traceback_before_the_line(run: Run, position: str):
    command = ["inspect", "none.usda"]
    done = run("--verbose", *command) if position == "first" else run(*command, "--verbose")
    assert (done.code, done.out) == (2, "")
    assert "Traceback (most recent call last)" in done.err
    assert "SceneError" in done.err
    assert done.err.splitlines()[-1].startswith("usd2kg: none.usda: no such file")


def test_a_bug_of_ours_is_not_dressed_up(run: Run, room: Path, monkeypatch: pytest.MonkeyPatch):
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("usd2kg.scene.read_scene", broken)
    with pytest.raises(ZeroDivisionError):
        run("inspect", room)


@pytest.mark.parametrize("arguments", [["fly"], ["build"], ["build", "--colour"], ["ontology", "fly"], ["inspect"]])
def test_wrong_usage_is_exit_code_2_and_says_how_to_get_help(run: Run, arguments: list[str]):
    done = run(*arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("Usage: ")
    assert "-h' for help" in done.err


def test_odd_names_of_files_are_fine(run: Run, room: Path, tmp_path: Path):
    odd = tmp_path / "my küche #1 100%.usda"
    shutil.copy(room, odd)
    assert run("build", odd).code == 0
    assert [path.name for path in Path().iterdir()] == ["my küche #1 100%.ttl"]
    assert run("query", "my küche #1 100%.ttl", "in", "bowl").out.endswith("1 row\n")


def test_a_hostile_name_in_an_error_stays_on_one_line_and_harmless(run: Run):
    check(run("inspect", "none\nsecond line\x1b[2J.usda"), "none second line")
    assert "\x1b" not in run("inspect", "\x1b[2J.usda").err
