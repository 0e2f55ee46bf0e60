"""Choose the built-in TBox for a scene: that of homes, or that of places, such as workplaces and streets."""

import gzip
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

from usd2kg.grounding.settings import BUILT_IN_CHOICE
from usd2kg.knowledge import read_cells
from usd2kg.ontology import PLACES_IRI, OntologyNote, TBox, load_home_tbox, load_places_tbox
from usd2kg.scene import Scene
from usd2kg.words import words_of

__all__ = ["PlaceVotes", "choose_built_in_tbox", "count_place_votes", "stated_places"]

_LONGEST_NOUN = 4
"""Words of the longest nouns that are looked up."""
_BLOCK = 1 << 20
"""Bytes of a file that are searched at once."""


class PlaceVotes(NamedTuple):
    """How many names of a scene mean things of homes, or things that homes do not have."""

    homes: int
    workplaces: tuple[str, ...]
    """The nouns, one for each name, sorted."""

    @property
    def is_workplace(self) -> bool:
        """Whether enough names mean things that homes do not have."""
        count = len(self.workplaces)
        is_frequent = count >= BUILT_IN_CHOICE.min_share * (count + self.homes)
        return is_frequent and count >= BUILT_IN_CHOICE.min_names


def choose_built_in_tbox(*scenes: Scene) -> TBox:
    """Return the TBox of places if many names of one of the scenes mean things that homes do not have, else of homes.

    A note of the TBox of places says which things.
    """
    counted = (count_place_votes(obj.name for obj in scene.objects) for scene in scenes)
    votes = next((found for found in counted if found.is_workplace), None)
    if votes is None:
        return load_home_tbox()
    nouns = ", ".join(list(dict.fromkeys(votes.workplaces))[: BUILT_IN_CHOICE.named_examples])
    understood = len(votes.workplaces) + votes.homes
    message = (
        f"{len(votes.workplaces)} of {understood} names are things of workplaces or streets ({nouns}), so that the "
        "built-in places TBox is used; --ontology home chooses the other"
    )
    return replace(load_places_tbox(), notes=(OntologyNote("ontology", message),))


def count_place_votes(names: Iterable[str]) -> PlaceVotes:
    """Return what names of objects mean; names with the same words count once.

    >>> count_place_votes(["SM_Forklift_01", "Forklift_2", "coffee_mug", "pallets", "xq7"])
    PlaceVotes(homes=1, workplaces=('forklift', 'pallet'))
    """
    homes, workplaces = 0, []
    for words in sorted({tuple(word for word in words_of(name) if not word.isdigit()) for name in names}):
        noun = _longest_noun(words)
        if noun is None:
            continue
        if _nouns()[noun]:
            homes += 1
        else:
            workplaces.append(noun)
    return PlaceVotes(homes, tuple(sorted(workplaces)))


def _longest_noun(words: tuple[str, ...]) -> str | None:
    """Return the longest known noun in a name, of equally long ones the last."""
    known = _nouns()
    for length in range(min(_LONGEST_NOUN, len(words)), 0, -1):
        for start in range(len(words) - length, -1, -1):
            noun = " ".join(words[start : start + length])
            for form in (noun, noun.removesuffix("s")):
                if form in known:
                    return form
    return None


@cache
def _nouns() -> Mapping[str, bool]:
    """Return noun → whether homes have such things."""
    nouns = {name: True for cls in load_home_tbox().classes for name in (cls.label, *cls.alt_labels)}
    nouns.update((noun, in_homes == "yes") for noun, in_homes in read_cells("place_nouns.csv", "noun", "in_homes"))
    return nouns


def stated_places(*files: Path | None) -> tuple[str, ...]:
    """Return the IRI of the ontology of places if the text of a file has it, such as decisions, a mapping or a graph.

    A file that cannot be read states nothing: who reads it for its contents says what is wrong with it.
    """
    wanted = PLACES_IRI.encode()
    return (PLACES_IRI,) if any(file is not None and _contains(file, wanted) for file in files) else ()


def _contains(file: Path, wanted: bytes) -> bool:
    opener = gzip.open if file.suffix == ".gz" else open
    try:
        with opener(file, "rb") as stream:
            before = b""
            while block := stream.read(_BLOCK):
                if wanted in before + block:
                    return True
                before = block[-len(wanted) :]
    except (OSError, EOFError, zlib.error):
        pass
    return False
