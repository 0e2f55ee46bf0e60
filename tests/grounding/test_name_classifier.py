"""The classifier for names that are in no list: its features, shares and the similar name it cites."""

import pytest

from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.name_classifier import likely_classes, name_features, similar_name
from usd2kg.ontology import TBox


def test_features_are_words_hypernyms_and_letters():
    features = name_features(("paprika", "shaker"))
    assert features["head shaker"] == features["modifier paprika"] == features["pair paprika shaker"] == 1.0
    assert features["ending ker"] == features["ending haker"] == 0.7
    assert features["beginning shak"] == 0.5
    assert features["head container"] in {1.0, 0.5}
    assert not any(name.startswith("modifier") for name in name_features(("shaker",)))


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("gherkin", "jar"), "Jar"),
        (("paprika", "tin"), "DesignedContainer"),
        (("velvet", "armchair"), "Armchair"),
        (("wardrobe", "handle"), "DesignedHandle"),
    ],
)
def test_unlisted_names_get_ranked_shares(words: tuple[str, ...], expected: str, home_tbox: TBox):
    assert " ".join(words) not in {name.lower() for names in home_names().values() for name in names}
    (best, share), *others = likely_classes(words)
    assert home_tbox.by_iri[best].local_name == expected
    assert 0.4 < share <= 1
    assert all(share >= other for _, other in others)
    assert share + sum(other for _, other in others) <= 1 + 1e-9


def test_a_name_without_known_features_has_no_classes():
    assert likely_classes(("☃☃☃☃☃☃",)) == ()


def test_a_similar_name_has_the_same_head(home_tbox: TBox):
    jar = home_tbox.resolve("Jar")
    found = similar_name(("gherkin", "jar"), jar)
    assert found is not None and found.endswith("jar")
    assert similar_name(("gherkin", "xqzv"), jar) is None
