"""Counts the commands and programs of the documentation that the tests run, and lists those that they do not.

Usage: python -m tests.doc_counts
"""

from typing import NamedTuple

from tests.doc_console import Block, read_blocks
from tests.doc_pages import GENERATED, GUIDES, PAGES, ROOT, all_pages

__all__ = ["BlockCounts", "count_blocks"]


class BlockCounts(NamedTuple):
    """The code blocks of all pages that show commands or programs."""

    run: int
    marked: tuple[str, ...]
    """`PAGE:LINE: REASON` of each block that says why it is not run."""
    left: tuple[str, ...]
    """`PAGE:LINE` of each block that is neither run nor says why."""

    def __str__(self) -> str:
        """Return the counts in a line."""
        count = self.run + len(self.marked) + len(self.left)
        return f"{self.run} of {count} code blocks are run, {len(self.marked)} say why they are not"


def count_blocks() -> BlockCounts:
    """Count the code blocks of the README and of all pages in docs."""
    covered = {*PAGES, *GUIDES, *GENERATED}
    found = [
        (page, block)
        for page in all_pages()
        for block in read_blocks(ROOT / page)
        if block.is_console or block.language in {"python", "pycon", "sparql", "toml"}
    ]
    return BlockCounts(
        sum(page in covered and not block.reason for page, block in found),
        tuple(f"{_place(page, block)}: {block.reason}" for page, block in found if block.reason),
        tuple(_place(page, block) for page, block in found if page not in covered and not block.reason),
    )


def _place(page: str, block: Block) -> str:
    return f"{page}:{block.line}"


def main() -> None:
    """Print the counts and the reasons."""
    counts = count_blocks()
    print("\n".join([str(counts), *(f"  {place}" for place in counts.marked)]))


if __name__ == "__main__":
    main()
