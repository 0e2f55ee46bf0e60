"""Find the prefix that the names of a stage share: `aws_robomaker_warehouse` of `aws_robomaker_warehouse_Bucket_01`.

A vendor, project or level at the beginning of nearly all names says nothing about a single object. Names that begin
with their head noun (`chair_oak`, `chair_red`) share a beginning too; there, what follows does not name objects.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.settings import CONVENTION
from usd2kg.words import split_identifier, words_of

__all__ = ["shared_prefix", "view_without_prefix", "without_prefix"]


def shared_prefix(names: Iterable[str], names_object: Callable[[str], bool]) -> tuple[str, ...]:
    """Return the lower-case parts that nearly all distinct names of a stage begin with; empty if there are none.

    The share of the names that begin with a prefix is smoothed with a pseudo-count, so a short list has none: with k of
    n names it is k / (n + pseudo-count).

    Args:
        names: the names of the stage's objects; names that differ only in numbers count once.
        names_object: returns whether what follows a prefix names an object by itself.
    """
    distinct = {_letters_of(name): name for name in names}
    prefix: tuple[str, ...] = ()
    found = prefix
    remaining = list(distinct.items())
    while remaining:
        first = [parts[len(prefix)] for parts, _ in remaining if len(parts) > len(prefix) + 1]
        common = max(sorted(set(first)), key=first.count, default=None)
        if common is None or first.count(common) < CONVENTION.min_share * (len(distinct) + CONVENTION.pseudo_count):
            break
        prefix = (*prefix, common)
        remaining = [(parts, name) for parts, name in remaining if parts[: len(prefix)] == prefix]
        objects = sum(names_object(without_prefix(name, prefix)) for _, name in remaining)
        if objects >= CONVENTION.min_object_share * len(remaining):
            found = prefix
    return found


def without_prefix(name: str, prefix: Sequence[str]) -> str:
    """Return a name without a prefix; unchanged if it does not begin with it, or if no word follows.

    >>> without_prefix("acme_warehouse_Bucket_01", ("acme", "warehouse"))
    'Bucket_01'
    >>> without_prefix("acme_warehouse_01", ("acme", "warehouse"))
    'acme_warehouse_01'
    """
    parts = split_identifier(name)[: len(prefix)]
    if not prefix or tuple(part.lower() for part in parts) != tuple(prefix):
        return name
    end = 0
    for part in parts:
        end = name.index(part, end) + len(part)
    rest = name[end:].lstrip("_-. ")
    return rest if words_of(rest) else name


def view_without_prefix(view: ObjectView, prefix: Sequence[str]) -> ObjectView:
    """Return a view without a prefix in its texts."""
    if not prefix:
        return view
    return replace(
        view,
        name=without_prefix(view.name, prefix),
        display_name=without_prefix(view.display_name, prefix),
        asset=tuple(without_prefix(text, prefix) for text in view.asset),
        parts=tuple(without_prefix(text, prefix) for text in view.parts),
    )


def _letters_of(name: str) -> tuple[str, ...]:
    return tuple(part.lower() for part in split_identifier(name) if not part.isdigit())
