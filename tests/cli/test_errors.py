"""User errors: exit code 2, one line on stderr, nothing on stdout, no file."""

import os
import shutil
from pathlib import Path

import pytest

from tests.cli.conftest import Finished, Run


def check(done: Finished, *parts: str) -> None:
    """Assert that a command failed with a user error, and that its line contains `parts`."""
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
def test_rejects_an_unreadable_scene(run: Run, tmp_path: Path, command: str, case: str):
    data, message = SCENES[case]
    path = tmp_path / ("scene.usdc" if case == "broken crate" else "scene.usda")
    if data is not None:
        path.write_bytes(data)
    check(run(command, path), str(path), message)


@pytest.mark.parametrize("command", ["build", "inspect", "ground"])
def test_rejects_other_files_and_folders_as_scene(run: Run, tmp_path: Path, command: str):
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


@pytest.mark.parametrize("command", ["build", "show"])
@pytest.mark.parametrize("case", ONTOLOGIES)
def test_rejects_an_unreadable_ontology(run: Run, room: Path, tmp_path: Path, command: str, case: str):
    data, message = ONTOLOGIES[case]
    path = tmp_path / "onto.owl"
    if data is not None:
        path.write_bytes(data)
    arguments = [command, room, "--ontology", path] if command == "build" else ["ontology", command, path]
    check(run(*arguments), str(path), message)


@pytest.mark.parametrize("command", ["build", "ground"])
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--grounder", "oracle"], "grounder 'oracle' is unknown; expected one of lexical, dictionary"),
        (["--regime", "dark"], "regime 'dark' is unknown; expected one of semantic"),
        (["--evidence", "name,colour"], "group 'colour' is unknown; expected a list of asset"),
        (["--evidence", ""], "no group is named"),
        (["--grounder", "dictionary", "--dictionary", "none.csv"], "none.csv: cannot be read"),
        (["-o", "none/out.ttl"], "the folder none does not exist"),
    ],
)
def test_rejects_invalid_grounding_options(run: Run, room: Path, command: str, arguments: list[str], message: str):
    check(run(command, room, *arguments), message)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--time-of-run", "noon"], "time 'noon'"),
        (["--annotations", "rdfstar"], "annotations 'rdfstar' is unknown; expected one of owl, rdf12"),
        (["--colors", "rgb"], "colors 'rgb' is unknown; expected one of usd, knowrob"),
        (["--profile", "owl"], "profile 'owl' is unknown; expected one of auto, soma, plain"),
        (["--base", "kitchen"], "base 'kitchen': expected an absolute IRI"),
        (["--base", ":/"], "base ':/': expected an absolute IRI"),
        (["--base", "https://my.lab/%zz/"], "expected an absolute IRI"),
        (["-o", "graph.json"], "the ending '.json' names no graph format; expected one of .ttl, .nt"),
        (["-o", "graph"], "the ending '' names no graph format"),
    ],
)
def test_rejects_invalid_options_of_build(run: Run, room: Path, arguments: list[str], message: str):
    check(run("build", room, *arguments), message)


def test_rejects_invalid_options_of_ground(run: Run, room: Path, tmp_path: Path):
    check(run("ground", room, "--format", "xlsx"), "format 'xlsx' is unknown; expected one of csv, json")
    check(run("ground", room, "--paths", "none.csv"), "none.csv: cannot be read")
    check(run("ground", room, "--paths", write(tmp_path / "p.csv", b"/a\n/b\n")), "expected a column 'path'")
    check(run("ground", room, "-o", tmp_path), "is a folder")


def test_rejects_an_unwritable_folder(run: Run, room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    # chmod would not stop root.
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


def test_keeps_the_old_graph_if_the_disk_is_full(run: Run, room: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    target = write(tmp_path / "room.ttl", b"old")

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", fail)
    check(run("build", room, "-o", target), "No space left on device")
    assert target.read_bytes() == b"old"
    assert not list(tmp_path.glob(".room*"))


def test_checks_outputs_before_reading_the_scene(run: Run, tmp_path: Path):
    check(run("build", tmp_path / "none.usda", "-o", "none/g.ttl"), "the folder none does not exist")
    check(run("ground", tmp_path / "none.usda", "-o", "none/m.csv"), "the folder none does not exist")
    check(run("demo", "-o", "none/g.ttl"), "the folder none does not exist")


def test_rejects_an_output_of_demo_without_rdf_ending(run: Run):
    check(run("demo", "-o", "kitchen.txt"), "names no RDF format")


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("none.ttl", None, "no such file"),
        ("graph.txt", b"", "names no RDF format"),
        ("graph.ttl", b"not turtle at all", "does not parse as Turtle"),
    ],
)
def test_rejects_an_unreadable_graph(run: Run, tmp_path: Path, name: str, data: bytes | None, message: str):
    if data is not None:
        write(tmp_path / name, data)
    check(run("query", tmp_path / name, "on", "table"), name, message)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["on", "flurbl"], "'flurbl' is not a word"),
        (
            ["all", "of", "unicorns"],
            "no class or concept is named 'unicorns'; expected a noun that is a concept of an object, or one of the "
            "classes artifact, bowl, cup, table",
        ),
        (["sing"], "question 'sing' is not understood"),
        (["--sparql", "SELECT"], "not valid SPARQL"),
        (["--sparql", "DROP ALL"], "expected SELECT, ASK, CONSTRUCT or DESCRIBE"),
        (["--sparql", "@none.rq"], "none.rq: cannot be read as a query"),
        (["--sparql", "ASK { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }"], "query"),
    ],
)
def test_rejects_unanswerable_questions(run: Run, graph: Path, arguments: list[str], message: str):
    check(run("query", graph, *arguments), message)


@pytest.mark.parametrize("position", ["first", "last"])
def test_verbose_prints_the_traceback_before_the_message(run: Run, position: str):
    command = ["inspect", "none.usda"]
    done = run("--verbose", *command) if position == "first" else run(*command, "--verbose")
    assert (done.code, done.out) == (2, "")
    assert "Traceback (most recent call last)" in done.err
    assert "SceneError" in done.err
    assert done.err.splitlines()[-1].startswith("usd2kg: none.usda: no such file")


def test_raises_other_exceptions(run: Run, room: Path, monkeypatch: pytest.MonkeyPatch):
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("usd2kg.scene.read_scene", broken)
    with pytest.raises(ZeroDivisionError):
        run("inspect", room)


@pytest.mark.parametrize("arguments", [["fly"], ["build"], ["build", "--colour"], ["ontology", "fly"], ["inspect"]])
def test_wrong_usage_points_to_help(run: Run, arguments: list[str]):
    done = run(*arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("Usage: ")
    assert "-h' for help" in done.err


def test_accepts_special_characters_in_file_names(run: Run, room: Path, tmp_path: Path):
    odd = tmp_path / "my küche #1 100%.usda"
    shutil.copy(room, odd)
    assert run("build", odd).code == 0
    assert [path.name for path in Path().iterdir()] == ["my küche #1 100%.ttl"]
    assert run("query", "my küche #1 100%.ttl", "in", "bowl").out.endswith("1 row\n")


def test_sanitizes_file_names_in_errors(run: Run):
    check(run("inspect", "none\nsecond line\x1b[2J.usda"), "none second line")
    assert "\x1b" not in run("inspect", "\x1b[2J.usda").err
