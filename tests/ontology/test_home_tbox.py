"""The built-in TBox: SOMA-HOME's classes with labels and synonyms of this project."""

from collections import defaultdict

import pytest

from tests.conftest import shared_file
from usd2kg.ontology import load_tbox

CONTAINMENT = "http://www.ease-crc.org/ont/SOMA.owl#Containment"


@pytest.fixture(scope="module")
def soma_home():
    """The published ontology."""
    return load_tbox(shared_file("ontologies/soma/SOMA-HOME.owl"))


def test_classes_are_those_of_soma_home(home_tbox, soma_home):
    assert [cls.iri for cls in home_tbox.classes] == [cls.iri for cls in soma_home.classes]


def test_hierarchy_is_that_of_soma_home(home_tbox, soma_home):
    assert {cls.iri: cls.parents for cls in home_tbox.classes} == {cls.iri: cls.parents for cls in soma_home.classes}


def test_containers_are_those_of_soma_home(home_tbox, soma_home):
    def containers(tbox):
        return {cls.local_name for cls in tbox.classes if CONTAINMENT in cls.dispositions}

    assert containers(home_tbox) == containers(soma_home)
    assert {"Cup", "Bowl", "Drawer"} <= containers(home_tbox)


def test_graphs_over_it_import_soma_home(home_tbox):
    assert home_tbox.ontology_iri == "http://www.ease-crc.org/ont/SOMA-HOME.owl"
    assert home_tbox.source == "built-in home TBox"
    assert (home_tbox.imports, home_tbox.notes) == ((), ())


def test_every_class_has_a_label_and_a_description(home_tbox):
    assert len(home_tbox.classes) == 102
    for cls in home_tbox.classes:
        assert cls.label, cls.iri
        assert len(cls.comment.split()) >= 5, cls.iri


def test_labels_and_synonyms_are_unambiguous(home_tbox):
    owners = defaultdict(set)
    for cls in home_tbox.classes:
        for text in (cls.label, *cls.alt_labels):
            owners[text.casefold()].add(cls.local_name)
    assert {text: names for text, names in owners.items() if len(names) > 1} == {}


def test_synonyms_are_clean(home_tbox):
    for cls in home_tbox.classes:
        assert cls.label not in cls.alt_labels
        for text in cls.alt_labels:
            assert text == " ".join(text.split()) != "", (cls.iri, text)


def test_labels_are_unique(home_tbox):
    labels = [cls.label for cls in home_tbox.classes]
    assert len(set(labels)) == len(labels)
