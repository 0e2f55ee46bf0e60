"""The error of the build step for a file in `knowledge/` that does not match its schema."""

from pathlib import Path

ROOT = Path(__file__).parents[1]


class SourceError(ValueError):
    """A source file, or a line of it, is not what its schema says."""

    def __init__(self, path: Path, problem: str, line: int | None = None) -> None:
        shown = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
        super().__init__(f"{shown}: {problem}" if line is None else f"{shown}:{line}: {problem}")
