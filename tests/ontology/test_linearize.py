"""Linearisation of a TBox as a list and as a tree."""

import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.conftest import shared_file
from tests.ontology.conftest import PREFIXES
from usd2kg.ontology import linearize_flat, linearize_tree, load_tbox

STATEMENTS = [
    ":Seat rdfs:subClassOf :Artifact .",
    ":Bed rdfs:subClassOf :Artifact .",
    ":SofaBed rdfs:subClassOf :Bed, :Seat .",
    ':Chair rdfs:subClassOf :Seat ; rdfs:comment "To sit on."@en .',
    ":RockingSofaBed rdfs:subClassOf :SofaBed .",
    ':Bread rdfs:subClassOf :Food ; rdfs:label "loaf"@en .',
]
FLAT = """\
Artifact
Bed (subClassOf: Artifact)
Bread (subClassOf: Food)
Chair (subClassOf: Seat) -- To sit on.
Food
RockingSofaBed (subClassOf: SofaBed)
Seat (subClassOf: Artifact)
SofaBed (subClassOf: Bed, Seat)
"""
TREE = """\
Artifact
  Bed
    SofaBed
      RockingSofaBed
  Seat
    Chair
    SofaBed (see above)
Food
  Bread
"""


def test_flat(load):
    assert linearize_flat(load("\n".join(STATEMENTS))) == FLAT


def test_tree(load):
    assert linearize_tree(load("\n".join(STATEMENTS))) == TREE


def test_tree_with_comments(load):
    tree = linearize_tree(load("\n".join(STATEMENTS)), with_comments=True)
    assert tree == TREE.replace("Chair\n", "Chair -- To sit on.\n")


def test_numbered_classes_show_their_labels(load):
    device = ':OBI_0000968 rdfs:label "device"@en .'
    detector = ':OBI_0400082 rdfs:subClassOf :OBI_0000968 ; rdfs:label "photodetector"@en .'
    tbox = load(f"{device} {detector}")
    assert linearize_flat(tbox) == "device [OBI_0000968]\nphotodetector [OBI_0400082] (subClassOf: device)\n"
    assert linearize_tree(tbox) == "device [OBI_0000968]\n  photodetector [OBI_0400082]\n"


def test_leaf_with_two_parents_appears_below_both(load):
    text = ':SofaBed rdfs:subClassOf :Bed, :Seat ; rdfs:comment "C" .'
    tree = linearize_tree(load(text), with_comments=True)
    # A leaf needs no reference to its first occurrence; its comment is written once.
    assert tree == "Bed\n  SofaBed -- C\nSeat\n  SofaBed\n"


@settings(max_examples=25, deadline=None)
@given(st.permutations(STATEMENTS))
def test_order_of_the_axioms_does_not_matter(tmp_path_factory, statements):
    path = tmp_path_factory.getbasetemp() / "any_order.ttl"
    path.write_text(PREFIXES + "\n".join(statements), encoding="utf-8")
    tbox = load_tbox(path)
    assert (linearize_flat(tbox), linearize_tree(tbox)) == (FLAT, TREE)


def linearized(path, seed):
    """Return both texts and the hash from a process with another hash seed."""
    code = (
        "import sys; from usd2kg.ontology import load_tbox, linearize_flat, linearize_tree\n"
        "tbox = load_tbox(sys.argv[1])\n"
        "print(tbox.content_hash, repr(tbox), linearize_flat(tbox), linearize_tree(tbox, with_comments=True))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(path)],
        env={"PYTHONHASHSEED": seed, "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        check=True,
    )
    return done.stdout


@pytest.mark.parametrize("name", ["soma/SOMA-HOME.owl", "other/cco/ArtifactOntology.ttl"])
def test_output_is_deterministic(name):
    path = shared_file(f"ontologies/{name}")
    assert linearized(path, "1") == linearized(path, "2")


def test_output_of_all_features_is_deterministic(write_turtle):
    synonyms = " ".join(f':Cup rdfs:label "l{i}"@en ; skos:altLabel "s{i}" .' for i in range(9))
    path = write_turtle(
        "\n".join([*STATEMENTS, synonyms, ":Cup rdfs:subClassOf :Mug, :Food . :Mug rdfs:subClassOf :Cup ."])
    )
    assert linearized(path, "1") == linearized(path, "2")


def test_every_class_is_in_both_texts(home_tbox):
    names = {cls.local_name for cls in home_tbox.classes}
    flat, tree = linearize_flat(home_tbox), linearize_tree(home_tbox)
    assert [line.split(" ")[0] for line in flat.splitlines()] == sorted(names)
    assert {line.strip().removesuffix(" (see above)") for line in tree.splitlines()} == names
