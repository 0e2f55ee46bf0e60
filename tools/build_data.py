"""Build the package data in `src/usd2kg/data` from the sources in `knowledge/`.

Usage: python -m tools.build_data [--check]

With --check nothing is written; the command fails if a file differs from what would be written.
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from tools.source_error import SourceError
from tools.word_lists import convert_word_lists

ROOT = Path(__file__).parents[1]
KNOWLEDGE = ROOT / "knowledge"
DATA = ROOT / "src/usd2kg/data"


class BuiltFile(NamedTuple):
    """One file of the package data."""

    name: str
    """Path below the data folder."""
    content: bytes


def build_files(knowledge: Path = KNOWLEDGE) -> Iterator[BuiltFile]:
    """Yield the data files that the sources in `knowledge` give.

    Raises:
        SourceError: a source does not match its schema.
    """
    for path in sorted((knowledge / "words").glob("*.toml")):
        yield BuiltFile(f"words/{path.stem}.json", convert_word_lists(path))


def find_differences(built: list[BuiltFile], data: Path = DATA) -> list[str]:
    """Return one line for each data file that is missing, differs from what was built, or has no source."""
    problems = []
    for name, content in built:
        path = data / name
        if not path.is_file():
            problems.append(f"{name} is missing")
        elif path.read_bytes() != content:
            problems.append(f"{name} differs from its source")
    expected = {name for name, _ in built}
    found = {path.relative_to(data).as_posix() for path in data.glob("words/*")}
    problems.extend(f"{name} has no source in knowledge/" for name in sorted(found - expected))
    return problems


def main() -> None:
    """Write the data files, or check them."""
    try:
        built = list(build_files())
    except SourceError as error:
        raise SystemExit(str(error)) from error
    if "--check" in sys.argv[1:]:
        if problems := find_differences(built):
            raise SystemExit("\n".join(["src/usd2kg/data is not what knowledge/ gives; run make data:", *problems]))
        return
    for name, content in built:
        path = DATA / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file() or path.read_bytes() != content:
            path.write_bytes(content)
            print(f"wrote {path.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
