"""Fit the classifier of names by their words, on the names of the home vocabulary.

Usage: python -m tools.fit_name_classifier

Writes `src/usd2kg/data/name_classifier.npz`, the weights of a multinomial logit as bytes, and prints the
cross-validated accuracy. Takes five minutes.
"""

import warnings
from collections import Counter

import numpy as np
from sklearn.exceptions import ConvergenceWarning
from sklearn.feature_extraction import DictVectorizer
from sklearn.linear_model import LogisticRegression
from sklearn.model_selection import cross_val_score
from sklearn.pipeline import make_pipeline

from tools.data_files import encode_lines, npz_bytes, write_data_file
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.name_classifier import name_features
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy

MIN_COUNT = 2
"""Features of fewer names are dropped: they do not generalise."""
INVERSE_RIDGE = 3.0
ROUNDS = 200
FOLDS = 5
BYTE = 127
"""Largest weight after quantisation."""


def main() -> None:
    """Fit, cross-validate and write."""
    warnings.simplefilter("ignore", ConvergenceWarning)
    features, classes = read_vocabulary()
    right = cross_val_score(make_pipeline(DictVectorizer(dtype=np.float32), make_model()), features, classes, cv=FOLDS)
    print(f"{len(classes)} names; right when left out: {right.mean():.3f}")
    vectorizer = DictVectorizer(dtype=np.float32)
    fitted = make_model().fit(vectorizer.fit_transform(features), classes)
    write_model(list(vectorizer.get_feature_names_out()), fitted)


def read_vocabulary() -> tuple[list[dict[str, float]], list[str]]:
    """Return the features and the class of each name."""
    singular = load_taxonomy().singular
    rows = [(name.lower().split(), iri) for iri, names in home_names().items() for name in names]
    features = [name_features((*modifiers, singular(head))) for (*modifiers, head), _ in rows]
    counts = Counter(name for found in features for name in found)
    kept = [{k: v for k, v in found.items() if counts[k] >= MIN_COUNT} for found in features]
    return kept, [iri for _, iri in rows]


def make_model() -> LogisticRegression:
    """Return an unfitted model."""
    return LogisticRegression(C=INVERSE_RIDGE, max_iter=ROUNDS)


def write_model(names: list[str], fitted: LogisticRegression) -> None:
    """Write the quantised weights without features whose weights all round to 0."""
    weights = fitted.coef_.T
    unit = float(np.abs(weights).max() / BYTE)
    rounded = np.round(weights / unit).astype(np.int8)
    kept = np.flatnonzero(rounded.any(axis=1))
    arrays = {
        "features": encode_lines([names[row] for row in kept]),
        "classes": encode_lines(list(fitted.classes_)),
        "weights": rounded[kept],
        "unit": np.float64(unit),
        "intercepts": fitted.intercept_,
    }
    # numpy.savez stores the time, and equal fits must give equal bytes.
    path = write_data_file("name_classifier.npz", npz_bytes(**arrays))
    print(f"{path.name}: {len(kept)} features, {path.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
