"""Which class a name is likely of that is in no list: learned from the names of the home vocabulary.

A multinomial logit (McFadden, 1974) over the words of a name and what they are kinds of: a `spice shaker` is a
container although nobody wrote it down, as other shakers are. The weights are in `data/likeness.npz`, written by
`tools/fit_likeness.py`.
"""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.knowledge import data_file
from usd2kg.ontology import ClassIRI

__all__ = ["features_of", "likely_classes", "similar_name"]

_MOST = 4
"""Classes that are told for a name."""
_SENSES = (1.0, 0.5)
"""What the likeliest meanings of a word count, the likeliest first."""
_ENDING, _BEGINNING = 0.7, 0.5
_ENDINGS = (3, 4, 5)
_BEGINNING_LETTERS = 4

Logits = NDArray[np.float64]


class _Model(NamedTuple):
    """The weights."""

    rows: Mapping[str, int]
    """Feature → row."""
    weights: NDArray[np.int8]
    """(features, classes), in units of `unit`."""
    unit: float
    intercepts: Logits
    """(classes,)"""
    classes: tuple[ClassIRI, ...]


def likely_classes(words: tuple[str, ...]) -> tuple[tuple[ClassIRI, float], ...]:
    """Return the likeliest classes of the built-in home TBox for a name, each with its probability, best first.

    Args:
        words: in lower case, modifiers first, the head noun last and singular.
    """
    model = _load_model()
    *modifiers, head = words
    parts = [_weigh_head(head)]
    if modifiers:
        parts += [_weigh_pair(modifiers[-1], head), _weigh_modifiers(tuple(modifiers))]
    known = [part for part in parts if part is not None]
    if not known:
        return ()
    logits = sum(known, start=model.intercepts)
    shares = np.exp(logits - logits.max())
    shares /= shares.sum()
    best = np.argsort(-shares, kind="stable")[:_MOST].tolist()
    return tuple((model.classes[place], float(shares[place])) for place in best)


def features_of(words: tuple[str, ...]) -> dict[str, float]:
    """Return the features of a name: its words, what they are kinds of, and the letters of its head."""
    *modifiers, head = words
    if not modifiers:
        return _head_features(head)
    return _head_features(head) | _pair_features(modifiers[-1], head) | _modifier_features(modifiers)


def _head_features(head: str) -> dict[str, float]:
    features = {f"head {head}": 1.0, **_kinds("head", head)}
    for count in _ENDINGS:
        features[f"ending {head[-count:]}"] = _ENDING
    features[f"beginning {head[:_BEGINNING_LETTERS]}"] = _BEGINNING
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


# The parts of a name return in others, and with them what they add.


@lru_cache(maxsize=4096)
def _weigh_head(head: str) -> Logits | None:
    return _weigh(_head_features(head))


@lru_cache(maxsize=2048)
def _weigh_pair(modifier: str, head: str) -> Logits | None:
    return _weigh(_pair_features(modifier, head))


@lru_cache(maxsize=2048)
def _weigh_modifiers(modifiers: tuple[str, ...]) -> Logits | None:
    return _weigh(_modifier_features(modifiers))


def _weigh(features: Mapping[str, float]) -> Logits | None:
    """Return what features add to the logit of each class, (classes,); None if no weight is known."""
    model = _load_model()
    known = [(model.rows[name], value) for name, value in features.items() if name in model.rows]
    if not known:
        return None
    return _weigh_rows(tuple(known))


@lru_cache(maxsize=2048)
def _weigh_rows(known: tuple[tuple[int, float], ...]) -> Logits:
    # Of most pairs nothing is known but that they are pairs.
    model = _load_model()
    rows, values = zip(*known, strict=True)
    logits: Logits = np.array(values) @ model.weights[list(rows)]
    logits *= model.unit
    logits.flags.writeable = False
    return logits


def _kinds(role: str, word: str) -> Mapping[str, float]:
    """Return the synsets above the likeliest meanings of a word, as features."""
    taxonomy = load_taxonomy()
    noun = taxonomy.singular(word)
    # Most pairs of words are no noun, and few come again.
    return _kinds_of(role, noun) if noun in taxonomy else {}


@lru_cache(maxsize=512)
def _kinds_of(role: str, noun: str) -> Mapping[str, float]:
    taxonomy = load_taxonomy()
    senses = sorted(taxonomy.senses(noun), key=sense_weight, reverse=True)
    features: dict[str, float] = {}
    for sense, value in zip(senses, _SENSES, strict=False):
        for synset, _ in taxonomy.walk_up(sense.synset):
            features.setdefault(_kind(role, synset), value)
    return features


@lru_cache(maxsize=4096)
def _kind(role: str, synset: int) -> str:
    return f"{role} {load_taxonomy().name(synset)}"


def similar_name(words: tuple[str, ...], class_iri: ClassIRI) -> str | None:
    """Return a name of the class in the home vocabulary with the same head, or None.

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
    with data_file("likeness.npz").open("rb") as file, np.load(file) as arrays:
        features, classes = (bytes(arrays[name]).decode("utf-8").split("\n") for name in ("features", "classes"))
        return _Model(
            rows={name: row for row, name in enumerate(features)},
            weights=arrays["weights"],
            unit=float(arrays["unit"]),
            intercepts=arrays["intercepts"].astype(np.float64),
            classes=tuple(classes),
        )
