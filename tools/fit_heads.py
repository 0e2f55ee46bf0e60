"""Fit which word of a name is its head, on the lists of names and the labelled scenes that are not tests.

Usage: python tools/fit_heads.py

Writes `src/usd2kg/data/heads.json`: the weights of a conditional logit over the words where a name may end,
and how often the likeliest end has an accepted class, on names that the weights were not fitted on.
"""

import json
import sys
import tomllib
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.evaluation.gold import read_gold
from usd2kg.grounding import view_objects
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, home_names
from usd2kg.grounding.lexical.alignment.matching import Matcher
from usd2kg.grounding.lexical.concepts.sizes import Size
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.head_noun import Features
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import read_scene

ROOT = Path(__file__).parents[1]
MATRIX = ROOT / "benchmarks/accuracy/matrix.toml"
OUTPUT = ROOT / "src/usd2kg/data/heads.json"
sys.path.insert(0, str(ROOT))

from benchmarks.names.lists import resolve_home_lists  # noqa: E402  (scripts are no packages of the product)

RIDGE = 2.0
"""Strength of the pull of the weights to zero."""
ROUNDS, STEP = 2000, 0.0005
FOLDS = 5
REAL = 3
"""How many times more a name of a scene counts than one of a list: people have built with it."""

Array = NDArray[np.float64]


class Name(NamedTuple):
    """The ends of one name."""

    text: str
    features: Array
    """(ends, features)."""
    is_accepted: NDArray[np.bool_]
    """(ends,): whether the best class there is one that a person accepts."""


class Reader(NamedTuple):
    """What reads the names of a TBox, with the home vocabulary or without."""

    matcher: Matcher
    names: NameReader


def main() -> None:
    """Fit, check, write."""
    names = [*names_of_lists(), *REAL * list(names_of_scenes())]
    texts = sorted({name.text for name in names})
    fold_of = dict(zip(texts, np.random.default_rng(0).integers(FOLDS, size=len(texts)).tolist(), strict=True))
    right = 0
    for fold in range(FOLDS):
        weights = fit([name for name in names if fold_of[name.text] != fold])
        right += sum(is_right(name, weights) for name in names if fold_of[name.text] == fold)
    weights = fit(names)
    report = {
        "weights": {name: round(float(weight), 3) for name, weight in zip(Features._fields, weights, strict=True)},
        "names": len(texts),
        "accepted_when_left_out": round(right / len(names), 4),
    }
    OUTPUT.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    print(OUTPUT.read_text(encoding="utf-8"))


def names_of_lists() -> Iterator[Name]:
    """Yield the names of the lists that may be learned from."""
    tbox = open_tbox(None)
    readers = readers_of(tbox)
    for names in resolve_home_lists("train", tbox):
        for thing in names:
            parents = tuple(thing.obj.prim_path.split("/")[1:-1])
            assert thing.obj.box
            yield from ends(readers, thing.obj.name, parents, thing.obj.box.size, thing.accepted)


def names_of_scenes() -> Iterator[Name]:
    """Yield the distinct names of the labelled scenes with SOMA-HOME."""
    for scene in tomllib.loads(MATRIX.read_text(encoding="utf-8"))["scene"]:
        path = (MATRIX.parent / scene["path"]).resolve()
        if not path.exists() or "test" in scene["name"] or "DFL" in scene["name"]:
            continue
        tbox = open_tbox(MATRIX.parent / scene["ontology"] if "ontology" in scene else None)
        readers = readers_of(tbox)
        gold = {label.prim_path: label for label in read_gold(MATRIX.parent / scene["gold"], tbox)}
        seen = set()
        for obj, view in view_objects(read_scene(path, paths=list(gold))):
            stem = view.name.rstrip("0123456789_")
            if obj.prim_path in gold and view.own_size is not None and stem not in seen:
                seen.add(stem)
                accepted = frozenset({gold[obj.prim_path].target, *gold[obj.prim_path].also})
                yield from ends(readers, view.name, view.parents, view.own_size, accepted)


def readers_of(tbox: TBox) -> list[Reader]:
    """Return what reads the names of a TBox, with the home vocabulary and without, as with other ontologies."""
    taxonomy = load_taxonomy()
    lexicons = [build_lexicon(tbox, taxonomy, synonyms) for synonyms in (home_names(), {})]
    readers = [NameReader(lexicon, taxonomy) for lexicon in lexicons]
    return [
        Reader(Matcher(tbox, lexicon, taxonomy, reader), reader)
        for lexicon, reader in zip(lexicons, readers, strict=True)
    ]


def ends(
    readers: list[Reader], text: str, parents: tuple[str, ...], size: Size, accepted: frozenset[ClassIRI]
) -> Iterator[Name]:
    """Yield the ends of a name as each reader has them, with its size and without, where there is a right choice."""
    for reader, known_size in product(readers, (size, None)):
        phrase = reader.names.read(text, parents)
        found = [(features, named.matches) for _, features, named in reader.matcher.ends(phrase, parents, known_size)]
        best = [max(matches, key=lambda match: match.score).class_iri for _, matches in found]
        right = np.array([iri in accepted for iri in best], dtype=bool)
        if len(found) > 1 and right.any():
            yield Name(text, np.array([features for features, _ in found]), right)


def fit(names: list[Name]) -> Array:
    """Return the weights that make the right ends most likely, by gradient ascent."""
    most = max(len(name.features) for name in names)
    features = np.zeros((len(names), most, len(Features._fields)))
    absent = np.full((len(names), most), -np.inf)
    accepted = np.zeros((len(names), most))
    for row, name in enumerate(names):
        count = len(name.features)
        features[row, :count], absent[row, :count], accepted[row, :count] = name.features, 0.0, name.is_accepted
    weights = np.zeros(len(Features._fields))
    for _ in range(ROUNDS):
        shares = softmax(features @ weights + absent)
        right = shares * accepted
        wanted = right / right.sum(axis=1, keepdims=True)
        weights = weights + STEP * (np.einsum("nef,ne->f", features, wanted - shares) - RIDGE * weights)
    return weights


def softmax(scores: Array) -> Array:
    """Return shares that add up to 1 in each row."""
    powers = np.exp(scores - scores.max(axis=1, keepdims=True))
    shares: Array = powers / powers.sum(axis=1, keepdims=True)
    return shares


def is_right(name: Name, weights: Array) -> bool:
    """Return whether the likeliest end has an accepted class."""
    return bool(name.is_accepted[int(np.argmax(name.features @ weights))])


if __name__ == "__main__":
    main()
