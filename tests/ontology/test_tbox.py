"""TBox queries: hierarchy, common ancestors, names."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.errors import OntologyError
from usd2kg.ontology import OntologyClass, TBox

BASE = "http://example.com/home#"


def tbox_of(**parents):
    """Return a TBox from local name → space-separated local names of the parents."""
    classes = tuple(
        OntologyClass(BASE + name, name.lower(), (), "", tuple(BASE + up for up in sorted(ups.split())))
        for name, ups in sorted(parents.items())
    )
    return TBox("home.owl", BASE, None, "sha256:0", classes)


#        Artifact        Food
#        /      \         |
#     Seat     Bed      Bread
#      /  \    /
#   Chair SofaBed
HOME = tbox_of(Artifact="", Seat="Artifact", Bed="Artifact", Chair="Seat", SofaBed="Seat Bed", Food="", Bread="Food")


def local(iris):
    return [iri.removeprefix(BASE) for iri in iris]


def test_roots_and_children_are_sorted():
    assert local(HOME.roots) == ["Artifact", "Food"]
    assert local(HOME.children[BASE + "Artifact"]) == ["Bed", "Seat"]
    assert HOME.children[BASE + "Bread"] == ()


def test_closure_includes_the_class_and_its_superclasses():
    assert sorted(local(HOME.closure(BASE + "SofaBed"))) == ["Artifact", "Bed", "Seat", "SofaBed"]
    assert local(HOME.closure(BASE + "Food")) == ["Food"]


def test_subclass_is_reflexive_and_antisymmetric():
    assert HOME.is_subclass(BASE + "Chair", BASE + "Artifact")
    assert HOME.is_subclass(BASE + "Chair", BASE + "Chair")
    assert not HOME.is_subclass(BASE + "Artifact", BASE + "Chair")
    assert not HOME.is_subclass(BASE + "Chair", BASE + "Food")


def test_depth_is_the_longest_path_to_a_root():
    # D is below B, and below C, which is below B: paths of two and three edges.
    deep = tbox_of(A="", B="A", C="B", D="B C")
    assert local(deep.depths) == ["A", "B", "C", "D"]
    assert list(deep.depths.values()) == [0, 1, 2, 3]


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 12))
def test_hierarchy_of_any_tree_is_consistent(seed, size):
    # Parents are drawn from earlier names, so there is no cycle.
    rng = random.Random(seed)
    names = [chr(ord("A") + index) for index in range(size)]
    parents = {
        name: " ".join(rng.sample(names[:index], rng.randint(0, min(index, 2)))) for index, name in enumerate(names)
    }
    tbox = tbox_of(**parents)
    for cls in tbox.classes:
        closure = tbox.closure(cls.iri)
        assert closure == {cls.iri}.union(*(tbox.closure(parent) for parent in cls.parents))
        assert all(tbox.depths[parent] < tbox.depths[cls.iri] for parent in cls.parents)
        assert all(cls.iri in tbox.children[parent] for parent in cls.parents)
        assert (cls.iri in tbox.roots) == (tbox.depths[cls.iri] == 0) == (len(closure) == 1)


def test_accepts_very_deep_hierarchies():
    # Deeper than Python's default limit of 1000 calls; C0000 is the deepest.
    chain = tbox_of(**{f"C{index:04}": f"C{index + 1:04}" if index < 1100 else "" for index in range(1101)})
    assert len(chain.closure(BASE + "C0000")) == 1101
    assert chain.depths[BASE + "C0000"] == 1100


# --- names -------------------------------------------------------------------------------------------

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
NAMED = TBox(
    "soma.owl",
    SOMA,
    None,
    "sha256:0",
    tuple(OntologyClass(iri, "", (), "", ()) for iri in (BASE + "Cup", SOMA + "Bowl", SOMA + "Cup")),
)


@pytest.mark.parametrize(
    ("name", "iri"),
    [
        (SOMA + "Cup", SOMA + "Cup"),
        (f"<{SOMA}Cup>", SOMA + "Cup"),
        ("soma:Cup", SOMA + "Cup"),
        ("SOMA:Cup", SOMA + "Cup"),
        (" soma:Bowl\n", SOMA + "Bowl"),
        ("Bowl", SOMA + "Bowl"),
        (BASE + "Cup", BASE + "Cup"),
    ],
)
def test_resolve(name, iri):
    assert NAMED.resolve(name) == iri


def test_resolves_labels_after_local_names():
    classes = [(BASE + "Cup", "Bowl"), (BASE + "Bowl", "dish"), (BASE + "C_17", "Fire extinguisher")]
    tbox = TBox("t.ttl", BASE, None, "sha256:0", tuple(OntologyClass(iri, label, (), "", ()) for iri, label in classes))
    assert tbox.resolve("Bowl") == BASE + "Bowl"
    assert tbox.resolve("fire extinguisher") == BASE + "C_17"


def test_resolves_curies_with_prefixes_of_the_file():
    cup = OntologyClass(BASE + "Cup", "cup", (), "", ())
    tbox = TBox("t.ttl", BASE, None, "sha256:0", (cup,), prefixes={"my": BASE})
    assert tbox.resolve("my:Cup") == BASE + "Cup"


def test_rejects_ambiguous_names():
    with pytest.raises(OntologyError) as caught:
        NAMED.resolve("Cup")
    assert str(caught.value) == (
        f"soma.owl: 'Cup' names 2 classes ({BASE}Cup, {SOMA}Cup) of the 3 in scope; "
        "expected an IRI, a CURIE, or a unique local name or label, see usd2kg ontology show"
    )


@pytest.mark.parametrize("name", ["cup", "Cupboard", "", "soma:Plate", "https://www.ease-crc.org/ont/SOMA.owl#Cup"])
def test_rejects_unknown_names(name):
    with pytest.raises(OntologyError, match="names no class of the 3 in scope"):
        NAMED.resolve(name)
