"""Which class a name is likely of that is in no list."""

import math

import numpy as np
import pytest

from tests.grounding.records import ground_names, local
from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.grounding.lexical.concepts import name_classifier as likeness
from usd2kg.grounding.lexical.concepts.name_classifier import features_of, likely_classes, similar_name
from usd2kg.ontology import TBox


def listed() -> set[str]:
    return {name.lower() for names in home_names().values() for name in names}


def test_features_are_words_kinds_and_letters():
    features = features_of(("paprika", "shaker"))
    assert features["head shaker"] == features["modifier paprika"] == features["pair paprika shaker"] == 1.0
    assert features["ending ker"] == features["ending haker"] == 0.7
    assert features["beginning shak"] == 0.5
    assert features["head container"] in {1.0, 0.5}
    assert not any(name.startswith("modifier") for name in features_of(("shaker",)))


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("gherkin", "jar"), "Jar"),
        (("paprika", "tin"), "DesignedContainer"),
        (("velvet", "armchair"), "Armchair"),
        (("wardrobe", "handle"), "DesignedHandle"),
    ],
)
def test_names_that_are_in_no_list(words: tuple[str, ...], expected: str, home_tbox: TBox):
    assert " ".join(words) not in listed()
    (best, share), *others = likely_classes(words)
    assert home_tbox.by_iri[best].local_name == expected
    assert 0.4 < share <= 1
    assert all(share >= other for _, other in others)
    assert share + sum(other for _, other in others) <= 1 + 1e-9


def test_the_shares_are_those_of_the_logit():
    model = likeness._load_model()
    features = {name: value for name, value in features_of(("tea", "chest")).items() if name in model.rows}
    logits = model.intercepts.copy()
    for name, value in features.items():
        logits += value * model.unit * model.weights[model.rows[name]].astype(float)
    shares = np.exp(logits) / np.exp(logits).sum()
    best = int(shares.argmax())
    assert likely_classes(("tea", "chest"))[0] == (model.classes[best], pytest.approx(float(shares[best])))
    assert math.isclose(shares.sum(), 1)


def test_a_name_without_any_known_feature_says_nothing():
    assert likely_classes(("☃☃☃☃☃☃",)) == ()


def test_a_similar_name_has_the_same_head(home_tbox: TBox):
    jar = home_tbox.resolve("Jar")
    found = similar_name(("gherkin", "jar"), jar)
    assert found is not None and found.endswith("jar")
    assert similar_name(("gherkin", "xqzv"), jar) is None


def test_the_word_for_the_kind_may_stand_behind(home_tbox: TBox):
    expected = {"plate_27cm_dinner": "DinnerPlate", "CottonSwab_Jar": "Jar"}
    found = dict(zip(expected, map(local, ground_names(list(expected), home_tbox)), strict=True))
    assert found == expected
