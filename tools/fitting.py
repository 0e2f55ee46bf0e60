"""Functions shared by the scripts that fit weights: conditional logits, and files of weights."""

import json
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from tools.data_files import write_data_file

Array = NDArray[np.float64]


def fit_conditional_logit(
    features: Array, sizes: Sequence[int], is_right: NDArray[np.bool_], weights: Array, *, ridge: float
) -> Array:
    """Return the coefficients that maximise the likelihood of choosing a right option less the L2 penalty.

    A choice has several options, at least one of them right; P(option | choice) ∝ exp(features · coefficients), as in
    McFadden (1974). The search is by L-BFGS (Liu and Nocedal, 1989).

    Args:
        features: (options, features), the options of one choice in a row.
        sizes: number of options of each choice.
        is_right: (options,).
        weights: (choices,).
        ridge: strength of the L2 penalty.
    """
    choice = np.repeat(np.arange(len(sizes)), sizes)
    starts = np.cumsum([0, *sizes[:-1]])
    weight = weights[choice]

    def loss(coefficients: Array) -> tuple[float, Array]:
        scores = features @ coefficients
        powers = np.exp(scores - np.maximum.reduceat(scores, starts)[choice])
        totals = np.add.reduceat(powers, starts)
        right = powers * is_right
        right_totals = np.add.reduceat(right, starts)
        likelihood = float((weights * np.log(right_totals / totals)).sum())
        slope = ((right / right_totals[choice] - powers / totals[choice]) * weight) @ features
        penalty = ridge / 2 * float(coefficients @ coefficients)
        return penalty - likelihood, ridge * coefficients - slope

    found = minimize(loss, np.zeros(features.shape[1]), jac=True, method="L-BFGS-B")
    return np.asarray(found.x)


def write_weights(file: str, names: Sequence[str], weights: Array, figures: Mapping[str, object], digits: int) -> None:
    """Write a JSON file of the package data with the weight of each feature and figures about the fit; print it."""
    rounded = {name: round(float(weight), digits) for name, weight in zip(names, weights, strict=True)}
    text = json.dumps({"weights": rounded, **figures}, indent=2) + "\n"
    write_data_file(file, text.encode())
    print(text, end="")
