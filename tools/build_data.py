"""Build the package data in `src/usd2kg/data` from the sources in `knowledge/`.

Usage: python -m tools.build_data [--check]

Validates each source against `knowledge/schema.toml`. With --check nothing is written; the command fails if a file
differs from what would be written. Data of third parties is not built here: `[data]` in the schema names its commands.
"""

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from tools.data_files import DATA, KNOWLEDGE, ROOT, SourceError, csv_bytes, write_data_file
from tools.settings_files import convert_settings
from tools.source_schema import FACTS, Schema, read_schema, validate_source
from tools.word_lists import convert_word_lists

BUILDERS = {
    "categories.csv": ("tools.build_categories", "build_categories"),
    "class_members.csv": ("tools.build_class_members", "build_class_members"),
    "glosses.csv": ("tools.build_glosses", "build_glosses"),
    "home.ttl": ("tools.builtin_tboxes", "build_home_tbox"),
    "home_names.csv": ("tools.build_home_names", "build_home_names"),
    "place_nouns.csv": ("tools.build_place_nouns", "build_place_nouns"),
    "places.ttl": ("tools.builtin_tboxes", "build_places_tbox"),
}
"""Data file → module and function that returns its content.

All other sources are copied, or are the input of a command. The modules are imported late, since usd2kg reads settings
and word lists on import.
"""

LICENCES = "licences.csv"


class BuiltFile(NamedTuple):
    """One file of the package data."""

    name: str
    """Path below the data folder."""
    content: bytes


def convert_files() -> Iterator[BuiltFile]:
    """Yield the word lists and settings.

    Raises:
        SourceError: a source is malformed.
    """
    for path in sorted((KNOWLEDGE / "words").glob("*.toml")):
        yield BuiltFile(f"words/{path.stem}.json", convert_word_lists(path))
    for path in sorted((KNOWLEDGE / "settings").glob("*.toml")):
        yield BuiltFile(f"settings/{path.stem}.json", convert_settings(path))


def list_licences(schema: Schema, names: Iterable[str]) -> BuiltFile:
    """Return the table of the data files with their origin and licence, for `usd2kg licences`.

    Args:
        schema: the sources, and the files of others.
        names: the word lists and settings, which were written for this project.
    """
    facts = {name: source.facts for source in schema.sources.values() for name in source.builds}
    facts |= schema.data
    own = {"description": "Word lists or settings.", "origin": "written for this project", "licence": "Apache-2.0"}
    facts |= dict.fromkeys(names, own)
    facts[LICENCES] = {**own, "description": "This table."}
    rows = [[name, *(facts[name][key] for key in FACTS)] for name in sorted(facts)]
    return BuiltFile(LICENCES, csv_bytes(("file", *FACTS), rows))


def build_files(schema: Schema) -> Iterator[BuiltFile]:
    """Yield the data files that the tables give; the files of `convert_files` must be in place.

    Raises:
        SourceError: a source does not match its schema, is missing, or is not in the schema.
    """
    check_listed(schema)
    for source in schema.sources.values():
        path = KNOWLEDGE / source.name
        validate_source(path, source)
        for name in source.builds:
            if name in BUILDERS:
                module, function = BUILDERS[name]
                build: Callable[[], bytes] = getattr(import_module(module), function)
                yield BuiltFile(name, build())
            elif name not in schema.data:
                yield BuiltFile(name, path.read_bytes())


def check_listed(schema: Schema, knowledge: Path = KNOWLEDGE) -> None:
    """Check that the schema lists the files of `knowledge` and no others.

    Raises:
        SourceError: a file is missing, or not listed.
    """
    found = {path.name for path in knowledge.iterdir() if path.is_file()} - {"README.md", "schema.toml"}
    if odd := sorted(found ^ set(schema.sources)):
        raise SourceError(knowledge / "schema.toml", f"{odd[0]} is only in the schema or only in the folder")


def find_differences(built: list[BuiltFile], others: Mapping[str, object], data: Path = DATA) -> list[str]:
    """Return one line for each data file that is missing, differs from what was built, or is unknown.

    Args:
        built: what the data files should be.
        others: names of the data files that commands write.
        data: the folder of the data files.
    """
    problems = []
    for name, content in built:
        path = data / name
        if not path.is_file():
            problems.append(f"{name} is missing")
        elif path.read_bytes() != content:
            problems.append(f"{name} differs from its source")
    found = {path.relative_to(data).as_posix() for path in data.rglob("*") if path.is_file()}
    problems.extend(f"{name} is missing; its command is in knowledge/schema.toml" for name in sorted({*others} - found))
    unknown = sorted(found - {name for name, _ in built} - {*others})
    problems.extend(f"{name} has no source and is not in knowledge/schema.toml" for name in unknown)
    return problems


def write_files(files: Iterable[BuiltFile]) -> None:
    """Write the files that differ."""
    for name, content in files:
        path = DATA / name
        if not path.is_file() or path.read_bytes() != content:
            print(f"wrote {write_data_file(name, content).relative_to(ROOT)}")


def main() -> None:
    """Write the data files, or check them."""
    try:
        schema = read_schema(KNOWLEDGE / "schema.toml")
        if "--check" in sys.argv[1:]:
            converted = [*convert_files()]
            licences = list_licences(schema, [file.name for file in converted])
            if problems := find_differences([*converted, licences, *build_files(schema)], schema.data):
                raise SystemExit("\n".join(["src/usd2kg/data is not what knowledge/ gives; run make data:", *problems]))
        else:
            converted = [*convert_files()]
            write_files(converted)
            write_files([list_licences(schema, [file.name for file in converted])])
            write_files(build_files(schema))
    except SourceError as error:
        raise SystemExit(str(error)) from error


if __name__ == "__main__":
    main()
