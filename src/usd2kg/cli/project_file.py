"""usd2kg.toml: options of commands that a project sets once.

A top-level key is the name of an option, for every command that has it; a table is a command, such as `[build]` or
`[store.load]`. Options on the command line take precedence. Relative paths start at the folder of the file. No key sets
`--no-project-file`, or an option that prints something and exits, such as `--help`.
"""

import difflib
import inspect
import os
import tomllib
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, get_args, get_origin

import typer
from typer.models import OptionInfo

from usd2kg.cli.options.common import BUILT_IN_ONTOLOGIES
from usd2kg.cli.options.stores import FOLDER_OR_URL
from usd2kg.errors import Usd2kgError

__all__ = [
    "PROJECT_OPTIONS_FILE",
    "CommandOption",
    "ProjectOptions",
    "find_global_options",
    "read_project_options",
    "walk_options",
]

PROJECT_OPTIONS_FILE = "usd2kg.toml"
ALLOWED_ANYWHERE = frozenset(
    {
        *("abstain", "alignment", "annotations", "base", "class-sizes", "decisions", "dictionary", "evidence"),
        *("every-prim", "exclude", "expand-instancers", "include", "kind", "log-format", "metres-per-unit", "no-color"),
        *("objects", "ontology", "profile", "regime", "relation-kinds", "relations", "reviewer", "rules", "time"),
        *("up-axis", "verbose", "viewpoint"),
    }
)
"""Options that neither write a file nor contact a server. A file that is not in the current folder or above it, such as
one that came with a downloaded scene, may set no others."""
_OFFLINE_GROUNDERS = frozenset({"lexical", "dictionary", "embedding", "volume"})
_IGNORES_THE_FILE = "no-project-file"
_QUALIFIED = {
    "decisions": ("color-by", "ask"),
    "gold": ("study",),
    "model": ("study",),
    "ontology": ("color-by", "ask", "study"),
    "reviewer": ("decisions",),
}
"""Option → the options that it qualifies. A command that has some of these rejects the option without any of them, so
the file does not set it there."""

_Command = tuple[str, ...]
"""The words of a command, such as `("store", "load")`."""


class CommandOption(NamedTuple):
    """An option of a command."""

    names: tuple[str, ...]
    """Spellings on the command line, such as `--output` and `-o`."""
    help: str
    is_path: bool
    is_flag: bool
    is_repeatable: bool

    @property
    def key(self) -> str:
        """The name in the file."""
        return self.names[0].removeprefix("--")


class ProjectOptions(NamedTuple):
    """The options that a file sets for one call."""

    file: Path
    keys: tuple[str, ...]
    global_options: tuple[str, ...]
    """The options of the file for all commands, such as `--no-color`."""
    arguments: tuple[str, ...]
    """The arguments of the call with the other options of the file."""


def read_project_options(
    make_app: Callable[[Sequence[str]], typer.Typer], arguments: Sequence[str], global_options: Sequence[str] = ()
) -> ProjectOptions | None:
    """Return the options that the nearest `usd2kg.toml` sets for a call; None if there are none.

    The search starts in the folder of the first positional argument that is a file or folder, otherwise in the current
    folder, and continues in the parent folders.

    Args:
        make_app: returns the command line for the arguments of a call, with all commands if there are none.
        arguments: the arguments of the call, without global options.
        global_options: the global options of the call.

    Raises:
        Usd2kgError: the file does not parse, or an option is unknown, of the wrong type, or not allowed there.
    """
    app = make_app(arguments)
    shared = find_global_options(app)
    commands = {command: [*shared, *options] for command, options in walk_options(app)}
    command, given = _split_command(app, arguments, commands)
    if command is None or {"-h", "--help"}.intersection(given):
        return None
    file = _find_file(_positional(given, commands[command]))
    if file is None:
        return None
    tables = _read(file)
    _check_keys(file, tables, {command: [*shared, *options] for command, options in walk_options(make_app(()))})
    is_trusted = Path.cwd().is_relative_to(file.parent)
    keys: list[str] = []
    added: list[str] = []
    added_globally: list[str] = []
    values = {option: _value_for(tables, command, option.key) for option in commands[command]}
    every_given = (*global_options, *given)
    is_set = {option.key: value is not None or _is_given(option, every_given) for option, value in values.items()}
    for option, value in values.items():
        if value is None or _is_given(option, every_given):
            continue
        qualified = [is_set[key] for key in _QUALIFIED.get(option.key, ()) if key in is_set]
        if qualified and not any(qualified):
            continue
        if not (is_trusted or option.key in ALLOWED_ANYWHERE or _is_offline_grounder(option, value)):
            problem = (
                "may write a file or contact a server, and the file is not in the current folder or a parent of it"
            )
            raise Usd2kgError(f"{file}: {option.key} {problem}; change to {file.parent}, or use --no-project-file")
        keys.append(option.key)
        (added_globally if option in shared else added).extend(_as_arguments(file, option, value))
    return ProjectOptions(file, tuple(keys), tuple(added_globally), (*command, *added, *given)) if keys else None


def find_global_options(app: typer.Typer) -> list[CommandOption]:
    """Return the options that every command accepts."""
    assert app.registered_callback is not None, "the application has global options"
    assert app.registered_callback.callback is not None, "its callback is a function"
    parameters = inspect.signature(app.registered_callback.callback).parameters.values()
    options = [option for one in parameters if (option := _option_of(one)) is not None]
    return [option for option in options if option.key != _IGNORES_THE_FILE]


def _split_command(
    app: typer.Typer, arguments: Sequence[str], commands: Container[_Command]
) -> tuple[_Command | None, Sequence[str]]:
    """Return the command of a call, None if it names none, and the arguments that follow."""
    for count in (1, 2):
        if tuple(arguments[:count]) in commands:
            return tuple(arguments[:count]), arguments[count:]
    defaults = {group.name: getattr(group.typer_instance.info.cls, "default_command", None) for group in _groups(app)}
    name = arguments[0] if len(arguments) > 1 else None
    if name is not None and (default := defaults.get(name)) is not None:
        return (name, default), arguments[1:]
    return None, ()


def walk_options(app: typer.Typer, above: _Command = ()) -> Iterator[tuple[_Command, list[CommandOption]]]:
    """Yield each command with its options."""
    for registered in app.registered_commands:
        assert registered.name is not None, "all commands are named"
        assert registered.callback is not None, "all commands are functions"
        parameters = inspect.signature(registered.callback).parameters.values()
        yield (*above, registered.name), [option for one in parameters if (option := _option_of(one)) is not None]
    for group in _groups(app):
        yield from walk_options(group.typer_instance, (*above, group.name))


class _Group(NamedTuple):
    name: str
    typer_instance: typer.Typer


def _groups(app: typer.Typer) -> Iterator[_Group]:
    """Yield the groups of commands."""
    for group in app.registered_groups:
        assert group.typer_instance is not None, "groups are applications"
        yield _Group(str(group.name), group.typer_instance)


def _option_of(parameter: inspect.Parameter) -> CommandOption | None:
    kind, *found = get_args(parameter.annotation) or (parameter.annotation,)
    info = next((one for one in found if isinstance(one, OptionInfo)), None)
    if info is None or info.is_eager:
        return None
    # In an annotation, Typer takes the first name as the default.
    declared = (info.default, *(info.param_decls or ()))
    names = tuple(name for name in declared if isinstance(name, str) and name.startswith("-"))
    names = names or (f"--{parameter.name.replace('_', '-')}",)
    types = {kind, *get_args(kind)}
    is_list = any(get_origin(one) is list for one in types)
    types |= {one for part in types for one in get_args(part)}
    is_path = Path in types or info.metavar == FOLDER_OR_URL
    return CommandOption(names, info.help or "", is_path, types == {bool}, is_list)


def _positional(given: Sequence[str], options: Sequence[CommandOption]) -> Iterator[str]:
    """Yield the arguments that are neither options nor their values."""
    with_value = {name for option in options if not option.is_flag for name in option.names}
    arguments = iter(given)
    for argument in arguments:
        if argument == "--":
            yield from arguments
        elif argument in with_value:
            next(arguments, None)
        elif not argument.startswith("-"):
            yield argument


def _find_file(positional: Iterable[str]) -> Path | None:
    # Unlike `Path.exists`, `os.path.exists` is False for an invalid path, such as a long question.
    start = next((Path(one) for one in positional if os.path.exists(one)), Path()).absolute()  # noqa: PTH110
    folders = [start, *start.parents] if start.is_dir() else start.parents
    files = (folder / PROJECT_OPTIONS_FILE for folder in folders)
    return next((file for file in files if file.is_file()), None)


def _read(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, RecursionError, tomllib.TOMLDecodeError) as error:
        raise Usd2kgError(f"{file}: cannot be read ({error}); expected TOML, as usd2kg init writes it") from error


def _check_keys(file: Path, tables: Mapping[str, Any], commands: Mapping[_Command, Sequence[CommandOption]]) -> None:
    all_keys = {option.key for options in commands.values() for option in options}
    groups = {command[0] for command in commands if len(command) > 1}
    for key, value in tables.items():
        if not isinstance(value, dict):
            _check_known(file, key, all_keys, "an option")
        elif key in groups:
            for name, options in value.items():
                _check_known(file, name, {command[1] for command in commands if command[0] == key}, f"of [{key}]")
                _check_table(file, options, commands[key, name], f"{key}.{name}")
        else:
            _check_known(file, key, {command[0] for command in commands}, "a command or an option")
            _check_table(file, value, commands[(key,)], key)


def _check_table(file: Path, table: Any, options: Sequence[CommandOption], name: str) -> None:
    if not isinstance(table, dict):
        raise Usd2kgError(f"{file}: {name} is {table!r}; expected a table of options, [{name}]")
    for key in table:
        _check_known(file, key, {option.key for option in options}, f"an option of {name.replace('.', ' ')}")


def _check_known(file: Path, key: str, known: set[str], expected: str) -> None:
    if key == _IGNORES_THE_FILE:
        raise Usd2kgError(f"{file}: {key!r} decides whether this file is read; expected it on the command line")
    if key not in known:
        near = difflib.get_close_matches(key, sorted(known), 1)
        raise Usd2kgError(f"{file}: {key!r} is not {expected}" + (f"; did you mean {near[0]!r}?" if near else ""))


def _value_for(tables: Mapping[str, Any], command: _Command, key: str) -> Any:
    """Return the value of an option, None if it has none; the table of the command takes precedence."""
    own: Any = tables
    for word in command:
        # An option may have the name of a group of commands, such as `store`.
        own = own.get(word) if isinstance(own, dict) else None
    found = own.get(key) if isinstance(own, dict) else None
    shared = tables.get(key)
    # A table of the same name is a command: `--graph` is an option, `[graph]` a group of commands.
    return found if found is not None or isinstance(shared, dict) else shared


def _is_given(option: CommandOption, given: Sequence[str]) -> bool:
    return any(argument.partition("=")[0] in option.names for argument in given)


def _as_arguments(file: Path, option: CommandOption, value: Any) -> Iterator[str]:
    """Yield the arguments that set an option.

    Raises:
        Usd2kgError: the value has the wrong type.
    """
    name = option.names[0]
    if option.is_flag:
        if not isinstance(value, bool):
            raise Usd2kgError(f"{file}: {option.key} is {value!r}; expected true or false")
        yield from [name] if value else []
        return
    values = value if option.is_repeatable and isinstance(value, list) else [value]
    for one in values:
        if isinstance(one, bool) or not isinstance(one, str | int | float):
            expected = "a text or a number" + (", or a list of them" if option.is_repeatable else "")
            raise Usd2kgError(f"{file}: {option.key} is {value!r}; expected {expected}")
        is_path = option.is_path and "://" not in str(one) and not _is_built_in(file, option, str(one))
        # With “=”, a value may begin with a dash.
        yield f"{name}={file.parent / str(one) if is_path else one}"


def _is_built_in(file: Path, option: CommandOption, value: str) -> bool:
    """Return whether a value names a built-in ontology, and no file beside the project file has that name."""
    return option.key == "ontology" and value in BUILT_IN_ONTOLOGIES and not (file.parent / value).is_file()


def _is_offline_grounder(option: CommandOption, value: object) -> bool:
    """Return whether a value names a grounder that contacts no server."""
    return option.key == "grounder" and value in _OFFLINE_GROUNDERS
