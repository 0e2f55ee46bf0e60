"""usd2kg.toml: options that a project sets once."""

import json
import logging
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import typer

from tests.cli.conftest import Run
from usd2kg.cli.app import make_app
from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.cli.options.common import BUILT_IN_ONTOLOGIES
from usd2kg.cli.project_file import (
    ALLOWED_ANYWHERE,
    CommandOption,
    find_global_options,
    read_project_options,
    walk_options,
)
from usd2kg.errors import Usd2kgError
from usd2kg.grounding.registry import GROUNDERS
from usd2kg.ontology import load_tbox
from usd2kg.query import load_graph

OPTIONS: dict[str, CommandOption] = {
    option.key: option
    for options in (find_global_options(make_app()), *dict(walk_options(make_app())).values())
    for option in options
}
WITHOUT_A_KEY = {
    "help": "prints and exits",
    "version": "prints and exits",
    "install-completion": "changes the shell and exits",
    "show-completion": "prints and exits",
    "no-project-file": "decides whether the file is read",
}
"""Option of the command line → why it is not one of a project."""


def walk_commands(command: Any = None, words: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Yield each command and group, as the parser of the command line knows it."""
    command = command or typer.main.get_command(make_app())
    yield words, command
    for name, below in getattr(command, "commands", {}).items():
        yield from walk_commands(below, (*words, name))


COMMANDS = dict(walk_commands())


def options_of(words: tuple[str, ...]) -> list[Any]:
    """Return the options of a command that a file may set."""
    options = [one for one in COMMANDS[words].params if one.param_type_name == "option"]
    return [one for one in options if one.opts[0].removeprefix("--") not in WITHOUT_A_KEY]


@pytest.fixture(autouse=True)
def empty_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)


def write(text: str, folder: Path | None = None) -> Path:
    file = (folder or Path.cwd()) / "usd2kg.toml"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return file


def arguments(*given: str) -> list[str]:
    found = read_project_options(make_app, given)
    return [*given] if found is None else [*found.arguments]


class TestPrecedence:
    def test_a_key_holds_for_every_command_that_has_the_option(self):
        write('base = "https://x.org/"')
        assert arguments("build", "s.usd") == ["build", "--base=https://x.org/", "s.usd"]
        assert arguments("render", "s.usd") == ["render", "s.usd"]

    def test_the_table_of_a_command_comes_before_the_top_level(self):
        write('base = "https://x.org/"\n[build]\nbase = "https://y.org/"')
        assert arguments("build", "s.usd") == ["build", "--base=https://y.org/", "s.usd"]

    def test_the_command_line_comes_first(self):
        write('base = "https://x.org/"\nexclude = ["/A", "/B"]')
        given = ["build", "--base=b", "--exclude", "/C", "s.usd"]
        assert arguments(*given) == given

    def test_short_names_count(self):
        write('[build]\noutput = "x.ttl"')
        assert arguments("build", "-o", "y.ttl", "s.usd") == ["build", "-o", "y.ttl", "s.usd"]

    def test_subcommands_have_tables_in_tables(self):
        write("[store.load]\nscene = 'kitchen'")
        assert arguments("store", "load", "s", "g.ttl")[:3] == ["store", "load", "--scene=kitchen"]
        assert arguments("store", "list", "s") == ["store", "list", "s"]

    def test_an_option_may_have_the_name_of_a_group_of_commands(self):
        file = write('store = "lab"')
        assert arguments("store", "load", "g.ttl") == ["store", "load", f"--store={file.parent / 'lab'}", "g.ttl"]

    def test_an_address_is_no_path(self):
        write('store = "https://lab.org/sparql"')
        assert arguments("store", "load", "g.ttl") == ["store", "load", "--store=https://lab.org/sparql", "g.ttl"]

    def test_a_reviewer_without_decisions_is_left_out(self):
        write('reviewer = "Ann"')
        assert arguments("build", "s.usd") == ["build", "s.usd"]
        assert arguments("studio", "s.usd") == ["studio", "--reviewer=Ann", "s.usd"]
        given = ["--decisions", "d.csv", "s.usd"]
        assert arguments("build", *given) == ["build", "--reviewer=Ann", *given]
        write('reviewer = "Ann"\ndecisions = "d.csv"')
        assert "--reviewer=Ann" in arguments("build", "s.usd")

    def test_classes_are_left_out_where_a_picture_shows_none(self):
        write('decisions = "d.csv"')
        assert arguments("render", "s.usd") == ["render", "s.usd"]
        assert arguments("render", "--color-by=room", "s.usd")[1].endswith("d.csv")
        assert arguments("render", "s.usd", "--ask", "where is the mug?")[1].endswith("d.csv")


class TestEveryOption:
    @pytest.mark.parametrize("words", [words for words in COMMANDS if options_of(words)], ids=" ".join)
    def test_it_is_read_from_the_file_and_reaches_its_command(self, words: tuple[str, ...]):
        chosen = COMMANDS[words]
        parser = chosen.make_parser(chosen.context_class(chosen, **chosen.context_settings))
        command = words or ("build",)
        is_path = {option.key: option.is_path for option in dict(walk_options(make_app()))[command]}
        for option in options_of(words):
            key = option.opts[0].removeprefix("--")
            value = "true" if option.is_flag else '"7"'
            write(f"[{'.'.join(command)}]\n{key} = {value}")
            # What the option qualifies.
            beside = ["--decisions=d.csv"] if key == "reviewer" else []
            beside += ["--color-by=class"] if words == ("render",) and key != "color-by" else []
            beside += ["--study"] if words == ("eval", "reproduce") and key != "study" else []
            found = read_project_options(make_app, [*command, *beside, "scene"])
            assert found is not None, key
            assert found.keys == (key,)
            assert bool(found.global_options) == (not words)
            given = [*found.global_options] or [one for one in found.arguments[len(words) :] if one not in beside]
            parsed, _, _ = parser.parse_args(given)
            expected: Any = True if option.is_flag else str(Path.cwd() / "7") if is_path.get(key) else "7"
            assert parsed[option.name] == ([expected] if option.multiple else expected), key

    def test_those_without_a_key_are_refused(self):
        known = {name.removeprefix("--") for one in COMMANDS.values() for p in one.params for name in p.opts}
        assert known >= WITHOUT_A_KEY.keys() - {"help"}
        assert OPTIONS.keys().isdisjoint(WITHOUT_A_KEY)
        for key in WITHOUT_A_KEY:
            write(f"{key} = true")
            with pytest.raises(Usd2kgError, match=f"'{key}' (is not an option|decides whether this file is read)"):
                arguments("build", "s.usd")

    def test_a_group_with_a_default_command_has_its_options(self):
        write('[label.write]\nmode = "skip"')
        assert arguments("label", "s.usd", "g.ttl") == ["label", "write", "--mode=skip", "s.usd", "g.ttl"]
        assert arguments("label", "lint", "s.usd") == ["label", "lint", "s.usd"]
        assert arguments("label") == ["label"]
        assert arguments("label", "--help") == ["label", "--help"]


class TestGlobalOptions:
    def test_they_are_set_for_all_commands_or_one(self):
        write("no-color = true\n[studio]\nlog-format = 'json'")
        found = read_project_options(make_app, ["studio", "s.usd"])
        assert found is not None
        assert found.global_options == ("--no-color", "--log-format=json")
        found = read_project_options(make_app, ["studio", "s.usd"], ["--log-format=text"])
        assert found is not None
        assert found.global_options == ("--no-color",)

    def test_the_form_of_messages_holds_from_the_first_one(self, run: Run, room: Path, monkeypatch, request):
        # As when a command starts: pytest's own handlers keep `basicConfig` from its work.
        monkeypatch.setattr("logging.root.handlers", [])
        request.addfinalizer(partial(logging.root.setLevel, logging.root.level))
        write('log-format = "json"', room.parent)
        lines = run("inspect", room).err.splitlines()
        assert json.loads(lines[0])["message"].endswith("usd2kg.toml: sets log-format")
        assert {json.loads(line)["level"] for line in lines} == {"info"}
        assert any("step" in json.loads(line) for line in lines)

    def test_verbose_shows_the_traceback(self, run: Run, room: Path):
        write("verbose = true", room.parent)
        assert "Traceback" in run("build", room, "--evidence=none-such").err
        assert "Traceback" not in run("build", room, "--evidence=none-such", "--no-project-file").err

    def test_colours_are_turned_off(self, run: Run, room: Path, monkeypatch):
        called: list[bool] = []
        monkeypatch.setattr("usd2kg.cli.app.forbid_colors", lambda: called.append(True))
        write("no-color = true", room.parent)
        assert run("inspect", room).code == 0
        assert called


class TestValues:
    def test_lists_repeat_the_option(self):
        write('include = ["/A/*", "/B"]\nkind = "group"')
        assert arguments("inspect", "s.usd")[1:4] == ["--include=/A/*", "--include=/B", "--kind=group"]

    def test_switches_are_true_or_false(self):
        write("every-prim = true\nexpand-instancers = false")
        assert arguments("inspect", "s.usd") == ["inspect", "--every-prim", "s.usd"]

    def test_paths_start_at_the_folder_of_the_file(self, monkeypatch):
        file = write('ontology = "lab.ttl"\nobjects = "/abs/list.csv"')
        (file.parent / "deep" / "er").mkdir(parents=True)
        monkeypatch.chdir(file.parent / "deep" / "er")
        assert set(arguments("inspect", "s.usd")) == {"inspect", "--objects=/abs/list.csv", "s.usd"}
        assert f"--ontology={file.parent / 'lab.ttl'}" in arguments("build", "s.usd")

    def test_a_value_may_begin_with_a_dash(self):
        write('viewpoint = "-1,0,1.6"')
        assert "--viewpoint=-1,0,1.6" in arguments("build", "s.usd")


class TestWhere:
    def test_the_file_is_beside_the_scene_or_above(self):
        file = write('base = "https://x.org/"', Path("project"))
        scene = file.parent / "scenes" / "a.usd"
        scene.parent.mkdir()
        scene.touch()
        found = read_project_options(make_app, ["build", str(scene)])
        assert found is not None
        assert (found.file, found.keys) == (file.absolute(), ("base",))

    def test_values_of_options_are_no_scenes(self):
        write('base = "https://here.org/"')
        elsewhere = write('base = "https://there.org/"', Path("elsewhere")).parent
        (elsewhere / "out.ttl").touch()
        for output in (["-o", "elsewhere/out.ttl"], ["--output=elsewhere/out.ttl"]):
            assert arguments("build", *output, "s.usd") == ["build", "--base=https://here.org/", *output, "s.usd"]
        (elsewhere / "-s.usd").touch()
        assert "--base=https://there.org/" in arguments("build", "-o", "out.ttl", "--", "elsewhere/-s.usd")

    @pytest.mark.parametrize("argument", ["what " * 2000, "a\0b"])
    def test_arguments_that_cannot_be_paths_are_no_scenes(self, argument: str):
        write('model = "openai:m"')
        assert arguments("ask", "g.ttl", argument) == ["ask", "--model=openai:m", "g.ttl", argument]

    @pytest.mark.parametrize(
        "line", ['output = "x.ttl"', 'grounder = "llm-B:m"', 'store = "http://h/s"', "json = true"]
    )
    def test_a_file_elsewhere_may_not_write_or_contact_a_server(self, line: str):
        file = write(line, Path("download"))
        (file.parent / "a.usd").touch()
        with pytest.raises(
            Usd2kgError, match=r"download.*not in the current folder or a parent of it.*--no-project-file"
        ):
            arguments("build", "download/a.usd")

    @pytest.mark.parametrize("name", GROUNDERS)
    def test_a_file_elsewhere_may_choose_a_grounder_without_a_server(self, name: str):
        file = write(f'grounder = "{name}"', Path("download"))
        (file.parent / "a.usd").touch()
        assert arguments("build", "download/a.usd") == ["build", f"--grounder={name}", "download/a.usd"]

    def test_what_a_file_elsewhere_may_set_writes_no_file(self):
        assert OPTIONS.keys() >= ALLOWED_ANYWHERE
        outputs = {name for bundle in OptionBundle.__subclasses__() for name in bundle.output_options}
        assert outputs
        assert ALLOWED_ANYWHERE.isdisjoint({name.replace("_", "-") for name in outputs} | {"output", "completions"})
        for key in ALLOWED_ANYWHERE:
            assert "to write" not in OPTIONS[key].help, key

    @pytest.mark.parametrize("name", BUILT_IN_ONTOLOGIES)
    def test_a_built_in_ontology_is_a_name_and_not_a_file_beside_the_project(self, name: str):
        folder = write(f'ontology = "{name}"').parent
        assert arguments("build", "s.usd") == ["build", f"--ontology={name}", "s.usd"]
        assert load_tbox(name).source.startswith("built-in")
        (folder / name).touch()
        assert arguments("build", "s.usd") == ["build", f"--ontology={folder / name}", "s.usd"]

    def test_help_needs_no_valid_file(self):
        write("nonsense = [")
        assert arguments("build", "--help") == ["build", "--help"]

    def test_it_can_be_ignored(self, run: Run, room: Path):
        write("nonsense = [", room.parent)
        assert run("inspect", room, "--no-project-file").code == 0
        assert "cannot be read" in run("inspect", room).err


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("base = ", "cannot be read"),
        ('ontologi = "x"', "'ontologi' is not an option; did you mean 'ontology'?"),
        ("[biuld]\njson = true", "'biuld' is not a command or an option; did you mean 'build'?"),
        ("[build]\nwhy = true", "'why' is not an option of build"),
        ("[store]\nlaod = {}", "'laod' is not of \\[store\\]; did you mean 'load'?"),
        ("store.load = 3", "store.load is 3; expected a table"),
        ("every-prim = 1", "every-prim is 1; expected true or false"),
        ("base = true", "base is True; expected a text or a number$"),
        ("base = []", "base is \\[\\]; expected a text or a number$"),
        ("include = [[1]]", "expected a text or a number, or a list of them"),
    ],
)
def test_errors_name_the_file_and_what_is_expected(text: str, message: str):
    file = write(text)
    with pytest.raises(Usd2kgError, match=f"^{file}: .*{message}"):
        arguments("build", "s.usd")


def test_a_scene_is_built_with_the_options_of_its_project(run: Run, room: Path):
    write('base = "https://my.lab/k/"\nexclude = ["/Room/Apple"]', room.parent)
    done = run("build", room, "-o", "g.ttl")
    assert done.code == 0
    assert f"{room.parent / 'usd2kg.toml'}: sets exclude, base" in done.err
    found = load_graph(Path("g.ttl")).sparql("SELECT ?p { ?o u2k:primPath ?p . ?o a [] } ORDER BY ?p").values
    assert "/Room/Apple" not in {row[0] for row in found}
    assert load_graph(Path("g.ttl")).sparql("ASK { <https://my.lab/k/Room.Table_1> a [] }").rows == (("true",),)


def test_every_command_takes_the_options_of_a_full_project(run: Run, room: Path, lab: Path):
    folder = room.parent
    assert run("ontology", "align", lab, "-o", folder / "align.csv").code == 0
    (folder / "decisions.csv").write_text("path,decision\n/Room/coffee_mug,Vessel\n", encoding="utf-8")
    for name in ("relations.toml", "plausibility.toml"):
        (folder / name).write_text("", encoding="utf-8")
    write(
        'abstain = true\nalignment = "align.csv"\nannotations = "owl"\nbase = "https://my.lab/k/"\n'
        'decisions = "decisions.csv"\nreviewer = "Ann"\nevidence = "name,geometry"\nevery-prim = false\n'
        'exclude = ["/Room/Apple"]\nexpand-instancers = true\nkind = ["component"]\nmetres-per-unit = 1\n'
        'ontology = "lab.ttl"\nprofile = "soma"\nregime = "semantic"\nrelations = "relations.toml"\n'
        'relation-kinds = "on,inside"\nrules = "plausibility.toml"\ntime = 1\nup-axis = "Z"\nviewpoint = "0,0,1.6"\n',
        folder,
    )
    for command in (
        ("inspect", room),
        ("build", room, "-o", folder / "g.ttl"),
        ("ground", room),
        ("render", room, "-o", folder / "room.png"),
        ("render", room, "--color-by", "class", "-o", folder / "classes.png"),
        ("validate", folder / "g.ttl"),
        ("diff", folder / "g.ttl", folder / "g.ttl"),
        ("diff", room, room),
        ("ask", folder / "g.ttl", "what is in the bowl?"),
        ("label", "lint", room),
        ("ontology", "shapes"),
    ):
        done = run(*command)
        assert done.code in ({0, 1} if command[0] in {"validate", "label"} else {0}), (command, done.err)


class TestInit:
    def test_the_written_file_sets_nothing_and_names_all_common_options(self, run: Run):
        assert run("init").code == 0
        text = Path("usd2kg.toml").read_text("utf-8")
        assert [line for line in text.splitlines() if line and not line.startswith("#")] == []
        for key in ALLOWED_ANYWHERE:
            assert f"\n# {key} = " in text

    def test_with_all_comments_removed_it_is_valid(self, run: Run, tmp_path: Path):
        assert run("init", tmp_path).code == 0
        file = tmp_path / "usd2kg.toml"
        options = [line for line in file.read_text("utf-8").splitlines() if " = " in line and line.startswith("# ")]
        file.write_text("\n".join(line.removeprefix("# ") for line in options), encoding="utf-8")
        found = read_project_options(make_app, ["build", "s.usd"])
        assert found is not None
        assert {"ontology", "include", "every-prim", "viewpoint"} <= set(found.keys)

    def test_an_existing_file_is_kept(self, run: Run, tmp_path: Path):
        write("base = 'x'", tmp_path)
        done = run("init", tmp_path)
        assert done.code == 2
        assert "exists already" in done.err
        assert (tmp_path / "usd2kg.toml").read_text("utf-8") == "base = 'x'"

    def test_a_missing_folder_is_an_error(self, run: Run):
        assert "cannot be written" in run("init", "nowhere").err


def test_json_output_is_still_json(run: Run, room: Path):
    write('base = "https://my.lab/k/"', room.parent)
    assert json.loads(run("build", room, "--json").out)["objects"] == 4
