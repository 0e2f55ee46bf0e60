"""Fit the choice of the head noun of a name, on the training lists of names and scenes.

Usage: python -m tools.fit_head_noun

Writes `src/usd2kg/data/head_noun.json`: the weights of a conditional logit over the words that may be the head noun,
and the cross-validated share of names whose most probable head noun has an accepted class.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.labelled_scenes import iter_training_scenes
from benchmarks.names.lists import resolve_home_lists
from tools.fitting import Array, fit_conditional_logit, write_weights
from usd2kg.grounding import view_objects
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.extent import extent_of
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.sizes import Size
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.reading.head_noun import HeadFeatures
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox

RIDGE = 2.0
"""Strength of the L2 penalty on the weights."""
FOLDS = 5
SCENE_COPIES = 3
"""Weight of a name from a scene relative to one from a list, since scenes are the intended input."""


class Name(NamedTuple):
    """The ends of one name: the words that may be its head noun."""

    text: str
    features: Array
    """(ends, features)."""
    is_accepted: NDArray[np.bool_]
    """(ends,): whether the best class at this end is an accepted one."""


class Reader(NamedTuple):
    """Reads names with one lexicon."""

    matcher: PhraseMatcher
    names: NameReader


def main() -> None:
    """Fit, cross-validate and write."""
    names = [*read_lists(), *SCENE_COPIES * list(read_scenes())]
    texts = sorted({name.text for name in names})
    fold_of = dict(zip(texts, np.random.default_rng(0).integers(FOLDS, size=len(texts)).tolist(), strict=True))
    right = 0
    for fold in range(FOLDS):
        weights = fit([name for name in names if fold_of[name.text] != fold])
        right += sum(is_right(name, weights) for name in names if fold_of[name.text] == fold)
    figures = {"names": len(texts), "accepted_when_left_out": round(right / len(names), 4)}
    write_weights("head_noun.json", HeadFeatures._fields, fit(names), figures, digits=3)


def read_lists() -> Iterator[Name]:
    """Yield the names of the training lists."""
    tbox = open_tbox(None)
    readers = make_readers(tbox)
    for names in resolve_home_lists("train", tbox):
        for labelled in names:
            parents = tuple(labelled.obj.prim_path.split("/")[1:-1])
            assert labelled.obj.box
            yield from read_ends(readers, labelled.obj.name, parents, labelled.obj.box.size, labelled.accepted)


def read_scenes() -> Iterator[Name]:
    """Yield the distinct names of the training scenes labelled with SOMA-HOME."""
    for case in iter_training_scenes():
        if "DFL" in case.name:
            continue
        readers = make_readers(case.tbox)
        gold = {label.prim_path: label for label in case.gold}
        seen = set()
        for obj, view in view_objects(case.scene):
            stem = view.name.rstrip("0123456789_")
            if obj.prim_path in gold and view.own_size is not None and stem not in seen:
                seen.add(stem)
                accepted = frozenset({gold[obj.prim_path].target, *gold[obj.prim_path].also})
                yield from read_ends(readers, view.name, view.parents, view.own_size, accepted)


def make_readers(tbox: TBox) -> list[Reader]:
    """Return readers with the home vocabulary and without it, as with other ontologies."""
    taxonomy = load_taxonomy()
    readers = []
    for synonyms in (home_names(), {}):
        lexicon = build_lexicon(tbox, taxonomy, synonyms)
        reader = NameReader(lexicon, taxonomy)
        readers.append(Reader(PhraseMatcher(TermMatcher(tbox, lexicon, taxonomy, reader), taxonomy, reader), reader))
    return readers


def read_ends(
    readers: Sequence[Reader], text: str, parents: tuple[str, ...], size: Size, accepted: frozenset[ClassIRI]
) -> Iterator[Name]:
    """Yield the ends of a name by each reader, with its size and without, if there are several and one is right."""
    for reader, known_size in product(readers, (size, None)):
        phrase = reader.names.read(text, parents)
        candidates = reader.matcher.head_candidates(phrase, parents, extent_of(known_size))
        found = [(features, head.matches) for _, features, head in candidates]
        best = [max(matches, key=lambda match: match.score).class_iri for _, matches in found]
        right = np.array([iri in accepted for iri in best], dtype=bool)
        if len(found) > 1 and right.any():
            yield Name(text, np.array([features for features, _ in found]), right)


def fit(names: Sequence[Name]) -> Array:
    """Return the weights that make the accepted ends most likely."""
    return fit_conditional_logit(
        np.concatenate([name.features for name in names]),
        [len(name.features) for name in names],
        np.concatenate([name.is_accepted for name in names]),
        np.ones(len(names)),
        ridge=RIDGE,
    )


def is_right(name: Name, weights: Array) -> bool:
    """Return whether the most probable end has an accepted class."""
    return bool(name.is_accepted[int(np.argmax(name.features @ weights))])


if __name__ == "__main__":
    main()
