"""Functions shared by the scripts that fit weights: conditional logits, and files of weights."""

import json
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from tools.data_files import write_data_file

Array = NDArray[np.float64]


def fit_conditional_logit(
    features: Array,
    sizes: Sequence[int],
    is_right: NDArray[np.bool_],
    weights: Array,
    *,
    ridge: float,
    step: float,
    rounds: int,
) -> Array:
    """Return the coefficients that maximise the likelihood of choosing a right option, by gradient ascent.

    A choice has several options, at least one of them right; P(option | choice) ∝ exp(features · coefficients), as in
    McFadden (1974).

    Args:
        features: (options, features), the options of one choice in a row.
        sizes: number of options of each choice.
        is_right: (options,).
        weights: (choices,).
        ridge: strength of the L2 penalty.
        step: learning rate.
        rounds: number of iterations.
    """
    choice = np.repeat(np.arange(len(sizes)), sizes)
    starts = np.cumsum([0, *sizes[:-1]])
    weight = weights[choice]
    coefficients = np.zeros(features.shape[1])
    for _ in range(rounds):
        scores = features @ coefficients
        powers = np.exp(scores - np.maximum.reduceat(scores, starts)[choice])
        shares = powers / np.bincount(choice, powers)[choice]
        right = powers * is_right
        wanted = right / np.bincount(choice, right)[choice]
        coefficients += step * (((wanted - shares) * weight) @ features - ridge * coefficients)
    return coefficients


def write_weights(file: str, names: Sequence[str], weights: Array, figures: Mapping[str, object], digits: int) -> None:
    """Write a JSON file of the package data with the weight of each feature and figures about the fit; print it."""
    rounded = {name: round(float(weight), digits) for name, weight in zip(names, weights, strict=True)}
    text = json.dumps({"weights": rounded, **figures}, indent=2) + "\n"
    write_data_file(file, text.encode())
    print(text, end="")
