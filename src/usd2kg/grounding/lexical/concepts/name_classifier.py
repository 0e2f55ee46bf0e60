"""Classify names that are not terms of the home vocabulary, with a model fitted to its names.

A multinomial logit (McFadden, 1974) over the words of a name, their hypernyms, and the letters of the head noun: a
spice shaker is a container because other shakers are. The weights are in `data/name_classifier.npz`, which
`tools/fit_name_classifier.py` fits and writes.
"""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.settings import CLASSIFIER
from usd2kg.knowledge import data_file
from usd2kg.ontology import ClassIRI

__all__ = ["likely_classes", "name_features", "similar_name"]

Logits = NDArray[np.float64]


class _Model(NamedTuple):
    """Weights of the classifier."""

    rows: Mapping[str, int]
    """Feature → row."""
    weights: NDArray[np.int8]
    """(features, classes), in units of `unit`."""
    unit: float
    intercepts: Logits
    """(classes,)"""
    classes: tuple[ClassIRI, ...]


def likely_classes(words: tuple[str, ...]) -> tuple[tuple[ClassIRI, float], ...]:
    """Return the most probable classes of the built-in home TBox for a name with their probabilities, best first.

    Args:
        words: lower case, modifiers first, the head noun last and singular.
    """
    model = _load_model()
    *modifiers, head = words
    parts = [_head_logits(head)]
    if modifiers:
        parts += [_pair_logits(modifiers[-1], head), _modifier_logits(tuple(modifiers))]
    known = [part for part in parts if part is not None]
    if not known:
        return ()
    logits = sum(known, start=model.intercepts)
    shares = np.exp(logits - logits.max())
    shares /= shares.sum()
    best = np.argsort(-shares, kind="stable")[: CLASSIFIER.max_classes].tolist()
    return tuple((model.classes[place], float(shares[place])) for place in best)


def name_features(words: tuple[str, ...]) -> dict[str, float]:
    """Return feature → value of a name: its words, their hypernyms, and the letters of the head noun."""
    *modifiers, head = words
    if not modifiers:
        return _head_features(head)
    return _head_features(head) | _pair_features(modifiers[-1], head) | _modifier_features(modifiers)


def _head_features(head: str) -> dict[str, float]:
    features = {f"head {head}": 1.0, **_kinds("head", head)}
    for count in CLASSIFIER.ending_letters:
        features[f"ending {head[-count:]}"] = CLASSIFIER.ending_value
    features[f"beginning {head[: CLASSIFIER.beginning_letters]}"] = CLASSIFIER.beginning_value
    return features


def _pair_features(modifier: str, head: str) -> dict[str, float]:
    return {"modified": 1.0, f"pair {modifier} {head}": 1.0, **_kinds("pair", modifier + head)}


def _modifier_features(modifiers: Iterable[str]) -> dict[str, float]:
    features: dict[str, float] = {}
    for modifier in modifiers:
        features[f"modifier {modifier}"] = 1.0
        for name, value in _kinds("modifier", modifier).items():
            features[name] = max(value, features.get(name, 0.0))
    return features


# Names share parts, so the logits of each part are cached.


@lru_cache(maxsize=4096)
def _head_logits(head: str) -> Logits | None:
    return _sum_logits(_head_features(head))


@lru_cache(maxsize=2048)
def _pair_logits(modifier: str, head: str) -> Logits | None:
    return _sum_logits(_pair_features(modifier, head))


@lru_cache(maxsize=2048)
def _modifier_logits(modifiers: tuple[str, ...]) -> Logits | None:
    return _sum_logits(_modifier_features(modifiers))


def _sum_logits(features: Mapping[str, float]) -> Logits | None:
    """Return the sum of the weighted features for each class, (classes,); None if no feature has weights."""
    model = _load_model()
    known = [(model.rows[name], value) for name, value in features.items() if name in model.rows]
    if not known:
        return None
    return _sum_rows(tuple(known))


@lru_cache(maxsize=2048)
def _sum_rows(known: tuple[tuple[int, float], ...]) -> Logits:
    # Cached: `modified` is the only known feature of most pairs.
    model = _load_model()
    rows, values = zip(*known, strict=True)
    logits: Logits = np.array(values) @ model.weights[list(rows)]
    logits *= model.unit
    logits.flags.writeable = False
    return logits


def _kinds(role: str, word: str) -> Mapping[str, float]:
    """Return the hypernyms of the usual senses of a word as features."""
    taxonomy = load_taxonomy()
    noun = taxonomy.singular(word)
    # Most pairs of words are not nouns: only nouns are cached.
    return _kinds_of(role, noun) if noun in taxonomy else {}


@lru_cache(maxsize=512)
def _kinds_of(role: str, noun: str) -> Mapping[str, float]:
    taxonomy = load_taxonomy()
    senses = sorted(taxonomy.senses(noun), key=sense_weight, reverse=True)
    features: dict[str, float] = {}
    for sense, value in zip(senses, CLASSIFIER.sense_values, strict=False):
        for synset, _ in taxonomy.walk_up(sense.synset):
            features.setdefault(_kind(role, synset), value)
    return features


@lru_cache(maxsize=4096)
def _kind(role: str, synset: int) -> str:
    return f"{role} {load_taxonomy().name(synset)}"


def similar_name(words: tuple[str, ...], class_iri: ClassIRI) -> str | None:
    """Return a home name of the class with the same head noun, or None.

    >>> from usd2kg.ontology import load_home_tbox
    >>> similar_name(("gherkin", "jar"), load_home_tbox().resolve("Jar"))
    'jar'
    """
    return _names_by_head().get((words[-1], class_iri))


@lru_cache(maxsize=1)
def _names_by_head() -> Mapping[tuple[str, ClassIRI], str]:
    return {(head, iri): name for head, iri, name in reversed(list(_heads()))}


def _heads() -> Iterator[tuple[str, ClassIRI, str]]:
    for iri, names in home_names().items():
        for name in names:
            yield name.lower().split()[-1], iri, name


@lru_cache(maxsize=1)
def _load_model() -> _Model:
    with data_file("name_classifier.npz").open("rb") as file, np.load(file) as arrays:
        features, classes = (bytes(arrays[name]).decode("utf-8").split("\n") for name in ("features", "classes"))
        return _Model(
            rows={name: row for row, name in enumerate(features)},
            weights=arrays["weights"],
            unit=float(arrays["unit"]),
            intercepts=arrays["intercepts"].astype(np.float64),
            classes=tuple(classes),
        )
