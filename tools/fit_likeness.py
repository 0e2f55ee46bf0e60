"""Fit which class a name is likely of, on the names of the home vocabulary.

Usage: python tools/fit_likeness.py

Writes `src/usd2kg/data/likeness.npz`: the weights of a multinomial logit, as bytes, and prints how often the
likeliest class is right for names that the weights were not fitted on. Takes five minutes.
"""

import io
import warnings
import zipfile
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.exceptions import ConvergenceWarning
from sklearn.feature_extraction import DictVectorizer
from sklearn.linear_model import LogisticRegression
from sklearn.model_selection import cross_val_score
from sklearn.pipeline import make_pipeline

from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.grounding.lexical.concepts.name_classifier import features_of
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy

OUTPUT = Path(__file__).parents[1] / "src/usd2kg/data/likeness.npz"

LEAST_COUNT = 2
"""Features that fewer names have tell nothing about others."""
INVERSE_RIDGE = 3.0
ROUNDS = 200
FOLDS = 5
BYTE = 127


def main() -> None:
    """Fit, check, write."""
    warnings.simplefilter("ignore", ConvergenceWarning)
    features, classes = vocabulary()
    right = cross_val_score(make_pipeline(DictVectorizer(dtype=np.float32), model()), features, classes, cv=FOLDS)
    print(f"{len(classes)} names; right when left out: {right.mean():.3f}")
    vectorizer = DictVectorizer(dtype=np.float32)
    fitted = model().fit(vectorizer.fit_transform(features), classes)
    write(list(vectorizer.get_feature_names_out()), fitted)


def vocabulary() -> tuple[list[dict[str, float]], list[str]]:
    """Return the features and the class of each name."""
    singular = load_taxonomy().singular
    rows = [(name.lower().split(), iri) for iri, names in home_names().items() for name in names]
    features = [features_of((*modifiers, singular(head))) for (*modifiers, head), _ in rows]
    counts = Counter(name for found in features for name in found)
    telling = [{k: v for k, v in found.items() if counts[k] >= LEAST_COUNT} for found in features]
    return telling, [iri for _, iri in rows]


def model() -> LogisticRegression:
    """Return a model that is still to be fitted."""
    return LogisticRegression(C=INVERSE_RIDGE, max_iter=ROUNDS)


def write(names: list[str], fitted: LogisticRegression) -> None:
    """Write the weights as bytes; features that round to nothing are left out."""
    weights = fitted.coef_.T
    unit = float(np.abs(weights).max() / BYTE)
    rounded = np.round(weights / unit).astype(np.int8)
    kept = np.flatnonzero(rounded.any(axis=1))
    arrays = {
        "features": text([names[row] for row in kept]),
        "classes": text(list(fitted.classes_)),
        "weights": rounded[kept],
        "unit": np.float64(unit),
        "intercepts": fitted.intercept_,
    }
    # numpy's own writer stamps the time, and the same fit is to give the same file.
    with zipfile.ZipFile(OUTPUT, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, array in arrays.items():
            data = io.BytesIO()
            np.lib.format.write_array(data, np.asanyarray(array))
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), data.getvalue(), zipfile.ZIP_DEFLATED)
    print(f"{OUTPUT.name}: {len(kept)} features, {OUTPUT.stat().st_size / 1e6:.2f} MB")


def text(lines: list[str]) -> Any:
    """Return lines as an array of bytes."""
    return np.frombuffer("\n".join(lines).encode("utf-8"), dtype=np.uint8)


if __name__ == "__main__":
    main()
