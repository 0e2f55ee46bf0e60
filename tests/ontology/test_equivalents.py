"""Equivalent classes: scope, representative, texts and names."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.ontology.conftest import PREFIXES
from usd2kg.errors import OntologyError
from usd2kg.ontology import OntologyClass, TBox, load_tbox

HOME = "http://example.com/home#"
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"


def parents(tbox):
    """Return local name → local names of the parents."""
    return {cls.local_name: tuple(tbox.by_iri[up].local_name for up in cls.parents) for cls in tbox.classes}


def equivalents(tbox):
    """Return local name → IRIs of the equivalents, if any."""
    return {cls.local_name: cls.equivalents for cls in tbox.classes if cls.equivalents}


# --- scope and hierarchy -----------------------------------------------------------------------------


def test_equivalence_places_a_class_and_makes_it_physical(write_turtle):
    # The file only states that :sink is equivalent to SOMA's class.
    write_turtle("soma:Sink rdfs:subClassOf soma:Fixture . soma:Fixture rdfs:subClassOf dul:PhysicalObject .", "up.ttl")
    text = """
    <http://example.com/home> a owl:Ontology ; owl:imports <http://x/up> .
    :sink owl:equivalentClass soma:Sink . :plan rdfs:subClassOf :idea .
    """
    tbox = load_tbox(write_turtle(text))
    assert parents(tbox) == {"sink": ()}
    assert equivalents(tbox) == {"sink": (f"{SOMA}Sink",)}


def test_subclasses_of_an_equivalent_are_physical(load):
    text = """
    soma:Component rdfs:subClassOf dul:PhysicalObject . soma:Component owl:equivalentClass :part .
    :knob rdfs:subClassOf :handle . :handle rdfs:subClassOf :part . :plan rdfs:subClassOf :idea .
    """
    tbox = load(text)
    assert parents(tbox) == {"handle": ("part",), "knob": ("handle",), "part": ()}
    assert equivalents(tbox) == {"part": (f"{SOMA}Component",)}


def test_representative_has_all_parents_and_children(load):
    text = """
    <http://example.com/home> a owl:Ontology .
    :Cup owl:equivalentClass soma:Cup . :Mug rdfs:subClassOf soma:Cup . :Beaker rdfs:subClassOf :Cup .
    :Cup rdfs:subClassOf :Vessel . soma:Cup rdfs:subClassOf soma:Crockery .
    """
    assert parents(load(text)) == {
        "Beaker": ("Cup",),
        "Cup": ("Vessel", "Crockery"),
        "Mug": ("Cup",),
        "Vessel": (),
        "Crockery": (),
    }


def test_equivalents_of_upper_classes_are_not_candidates(load):
    text = ":concrete owl:equivalentClass dul:PhysicalObject . :Cup rdfs:subClassOf :concrete ."
    assert parents(load(text)) == {"Cup": ()}


def test_equivalence_in_a_flat_list(load):
    text = ":Cup a owl:Class . :Mug a owl:Class ; owl:equivalentClass soma:Mug ."
    tbox = load(text)
    assert (parents(tbox), equivalents(tbox)) == ({"Cup": (), "Mug": ()}, {"Mug": (f"{SOMA}Mug",)})


@pytest.mark.parametrize("top", ["owl:Thing", "owl:Nothing", "rdfs:Resource"])
def test_equivalents_of_top_or_bottom_stay_distinct(load, top):
    tbox = load(f":Cup owl:equivalentClass {top} . :Mug owl:equivalentClass {top} .")
    assert (parents(tbox), equivalents(tbox)) == ({"Cup": (), "Mug": ()}, {})


@pytest.mark.parametrize(
    "text",
    [
        ":Name a rdfs:Datatype ; owl:equivalentClass :Text .",
        ":Name owl:equivalentClass :Text . :Text a rdfs:Datatype .",
        ":Name owl:equivalentClass <http://www.w3.org/2001/XMLSchema#string> .",
    ],
)
def test_datatype_definitions_are_not_classes(load, text):
    assert parents(load(f":Cup rdfs:subClassOf :Crockery . {text}")) == {"Crockery": (), "Cup": ("Crockery",)}


def test_deprecated_equivalents_are_synonyms_only(load):
    text = """
    <http://example.com/home> a owl:Ontology . :Crockery a owl:Class .
    :Tassie rdfs:subClassOf :Crockery ; owl:deprecated true ; rdfs:label "tassie" ; owl:equivalentClass soma:Cup .
    """
    tbox = load(text)
    assert parents(tbox) == {"Crockery": (), "Cup": ("Crockery",)}
    assert tbox.by_iri[f"{SOMA}Cup"].alt_labels == ("tassie",)
    assert tbox.resolve("Tassie") == f"{SOMA}Cup"


# --- explicit scopes ---------------------------------------------------------------------------------

TREE = """
<http://example.com/home> a owl:Ontology . :Crockery rdfs:subClassOf :Artifact .
:Cup rdfs:subClassOf :Crockery ; owl:equivalentClass soma:Cup . :Mug rdfs:subClassOf soma:Cup .
"""


@pytest.mark.parametrize("root", [f"{HOME}Cup", "soma:Cup"])
def test_roots_include_equivalents_and_subclasses(load, root):
    assert parents(load(TREE, roots=[root])) == {"Cup": (), "Mug": ("Cup",)}


@pytest.mark.parametrize(
    ("classes", "kept"),
    [
        ([f"{HOME}Cup"], f"{HOME}Cup"),
        (["soma:Cup"], f"{SOMA}Cup"),
        (["soma:Cup", f"{HOME}Cup"], f"{HOME}Cup"),
    ],
)
def test_listed_classes_keep_one_representative_per_group(load, classes, kept):
    tbox = load(TREE, classes=[*classes, f"{HOME}Crockery"])
    assert [cls.iri for cls in tbox.classes] == sorted([f"{HOME}Crockery", kept])
    assert parents(tbox)["Cup"] == ("Crockery",)
    assert {tbox.resolve(f"{HOME}Cup"), tbox.resolve("soma:Cup")} == {kept}


# --- representative ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        # In the namespace of the ontology, although the other is declared and has a parent, a label and a smaller IRI.
        (
            "<http://example.com/home> a owl:Ontology . :Cup owl:equivalentClass <http://a#A> . "
            '<http://a#A> a owl:Class ; rdfs:subClassOf :Crockery ; rdfs:label "a" .',
            f"{HOME}Cup",
        ),
        # The namespace ends in a slash; an IRI that only shares a prefix is in another one.
        (
            "<http://b/home/> a owl:Ontology . <http://b/home/Cup> owl:equivalentClass <http://b/hometown/A> .",
            "http://b/home/Cup",
        ),
        # Declared.
        (
            ":Cup a owl:Class ; owl:equivalentClass <http://a#A> . "
            '<http://a#A> rdfs:subClassOf :Crockery ; rdfs:label "a" .',
            f"{HOME}Cup",
        ),
        # Used as subclass, used as superclass.
        (
            ':Cup rdfs:subClassOf :Crockery ; owl:equivalentClass <http://a#A> . <http://a#A> rdfs:label "a" .',
            f"{HOME}Cup",
        ),
        (
            ':Mug rdfs:subClassOf :Cup . :Cup owl:equivalentClass <http://a#A> . <http://a#A> rdfs:label "a" .',
            f"{HOME}Cup",
        ),
        # Labelled.
        (':Cup owl:equivalentClass <http://a#A> ; rdfs:label "cup" .', f"{HOME}Cup"),
        # Smallest IRI.
        (":Cup owl:equivalentClass <http://a#A> .", "http://a#A"),
    ],
)
def test_choice_of_the_representative(load, text, kept):
    tbox = load(text)
    grouped = [cls for cls in tbox.classes if cls.equivalents]
    assert [cls.iri for cls in grouped] == [kept]
    assert not set(grouped[0].equivalents) & set(tbox.by_iri)


def test_classes_of_the_file_precede_imported_ones(write_turtle):
    write_turtle(
        '<http://a#A> a owl:Class ; rdfs:subClassOf <http://a#B> ; rdfs:label "a" ; owl:equivalentClass :Cup .', "a.ttl"
    )
    text = "<http://x> a owl:Ontology ; owl:imports <http://x/a> . :Cup rdfs:subClassOf :Crockery ."
    assert equivalents(load_tbox(write_turtle(text))) == {"Cup": ("http://a#A",)}


def test_equivalence_is_transitive(load):
    text = """
    :A owl:equivalentClass :B . :C owl:equivalentClass :B, :D . :E owl:equivalentClass :F .
    :A rdfs:subClassOf :Top . :E rdfs:subClassOf :Top .
    """
    tbox = load(text)
    assert parents(tbox) == {"A": ("Top",), "E": ("Top",), "Top": ()}
    assert equivalents(tbox) == {"A": (f"{HOME}B", f"{HOME}C", f"{HOME}D"), "E": (f"{HOME}F",)}


def test_a_class_equivalent_to_itself_has_no_equivalents(load):
    tbox = load(":Cup rdfs:subClassOf :Crockery ; owl:equivalentClass :Cup .")
    assert (parents(tbox), equivalents(tbox)) == ({"Crockery": (), "Cup": ("Crockery",)}, {})


# --- cycles ------------------------------------------------------------------------------------------


def test_subclass_axiom_within_a_group_is_not_a_cycle(load):
    tbox = load(":A owl:equivalentClass :B . :A rdfs:subClassOf :B, :Top . :B rdfs:subClassOf :A .")
    assert (parents(tbox), tbox.notes) == ({"A": ("Top",), "Top": ()}, ())


def test_reports_a_cycle_through_an_equivalent(load):
    tbox = load(":A owl:equivalentClass :B . :B rdfs:subClassOf :C . :C rdfs:subClassOf :A, :Top .")
    assert parents(tbox) == {"A": ("Top",), "C": ("Top",), "Top": ()}
    assert [note.message.split(" ")[0] for note in tbox.notes] == [f"<{HOME}A>", f"<{HOME}C>"]


def _reach(edges, start):
    found, pending = {start}, [start]
    while pending:
        here = pending.pop()
        pending += [up for low, up in edges if low == here and up not in found]
        found |= {up for low, up in edges if low == here}
    return found


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 100_000))
def test_hierarchies_with_equivalents_are_acyclic_and_deterministic(tmp_path_factory, seed):
    rng = random.Random(seed)
    names = "ABCDEFGH"
    # Superclasses are later letters, so only equivalences cause cycles.
    below = {tuple(sorted(rng.sample(names, 2))) for _ in range(rng.randint(1, 8))}
    same = {tuple(rng.sample(names, 2)) for _ in range(rng.randint(0, 3))}
    lines = [f":{a} rdfs:subClassOf :{b} .\n" for a, b in sorted(below)]
    lines += [f":{a} owl:equivalentClass :{b} .\n" for a, b in sorted(same)]
    path = tmp_path_factory.getbasetemp() / "random.ttl"
    path.write_text(PREFIXES + "".join(lines))
    tbox = load_tbox(path)
    rng.shuffle(lines)
    path.write_text(PREFIXES + "".join(lines))
    assert load_tbox(path).classes == tbox.classes

    both_ways = same | {(b, a) for a, b in same}
    edges = below | both_ways
    kept = {name: tbox.resolve(name).removeprefix(HOME) for name in sorted({name for edge in edges for name in edge})}
    assert len(tbox.classes) == len({min(_reach(both_ways, name)) for name in kept})
    assert all(kept[a] == kept[b] for a, b in same)
    for name, stands in kept.items():
        above = {kept[up] for up in _reach(edges, name)}
        # Classes that are each other's superclass form a cycle, whose edges are dropped.
        strict = {up for up in above if stands not in {kept[upper] for upper in _reach(edges, up)}}
        assert {iri.removeprefix(HOME) for iri in tbox.closure(HOME + stands)} == strict | {stands}


# --- texts and dispositions --------------------------------------------------------------------------


def test_labels_and_synonyms_of_equivalents_become_synonyms(load):
    text = """
    <http://example.com/home> a owl:Ontology .
    :Tap rdfs:subClassOf :Fitting ; rdfs:label "tap" ; skos:altLabel "spigot" ; owl:equivalentClass soma:Tap, :Cock .
    soma:Tap rdfs:label "faucet"@en, "Hahn"@de ; skos:altLabel "water tap" . :Cock rdfs:label "tap" .
    """
    cls = load(text).by_iri[f"{HOME}Tap"]
    assert (cls.label, cls.alt_labels) == ("tap", ("Hahn", "faucet", "spigot", "water tap"))


def test_local_names_are_fallback_synonyms_of_equivalents(load):
    cls = load(":Tap rdfs:subClassOf :Fitting ; owl:equivalentClass soma:WaterTap .").by_iri[f"{HOME}Tap"]
    assert (cls.label, cls.alt_labels) == ("Tap", ("WaterTap",))


@pytest.mark.parametrize(
    ("own", "comment"), [('rdfs:comment "Ours."', "Ours."), ('skos:altLabel "spigot"', "Water comes out.")]
)
def test_comment_of_an_equivalent_is_the_fallback(load, own, comment):
    text = f"""
    :Tap rdfs:subClassOf :Fitting ; {own} ; owl:equivalentClass soma:Tap .
    soma:Tap rdfs:comment "Water comes out." .
    """
    assert load(text).by_iri[f"{HOME}Tap"].comment == comment


def test_dispositions_follow_equivalences(load):
    text = """
    soma:Vessel rdfs:subClassOf
        [ a owl:Restriction ; owl:onProperty soma:hasDisposition ; owl:someValuesFrom :holding ] .
    :holding owl:equivalentClass soma:Containment . soma:Containment rdfs:subClassOf soma:Enclosing .
    :vessel owl:equivalentClass soma:Vessel . :cup rdfs:subClassOf :vessel .
    """
    assert load(text).by_iri[f"{HOME}cup"].dispositions == (f"{HOME}holding", f"{SOMA}Containment", f"{SOMA}Enclosing")


# --- names -------------------------------------------------------------------------------------------

NAMED = TBox(
    "home.owl",
    HOME,
    None,
    "sha256:0",
    (
        OntologyClass(f"{HOME}Bin", "bin", (), "", (), equivalents=("http://a#Cup", "http://a#Pail", f"{SOMA}Bin")),
        OntologyClass(
            f"{HOME}Cup", "cup", (), "", (), equivalents=(f"{SOMA}Beaker", "http://a#Pail2", "http://b#Pail")
        ),
        OntologyClass(f"{HOME}Mug", "mug", (), "", ()),
    ),
)


@pytest.mark.parametrize(
    ("name", "local"),
    [
        (f"{SOMA}Beaker", "Cup"),
        (f" <{SOMA}Beaker>", "Cup"),
        ("soma:Beaker", "Cup"),
        ("Beaker", "Cup"),
        ("Bin", "Bin"),  # the name of the class and of its equivalent
        ("Cup", "Cup"),  # the name of a class precedes that of an equivalent class
        ("http://a#Cup", "Bin"),
        ("Mug", "Mug"),
    ],
)
def test_resolves_names_of_equivalents(name, local):
    assert NAMED.resolve(name) == HOME + local


def test_rejects_ambiguous_names_of_equivalents():
    with pytest.raises(OntologyError, match=f"'Pail' names 2 classes \\({HOME}Bin, {HOME}Cup\\) of the 3 in scope"):
        NAMED.resolve("Pail")


# --- every syntax ------------------------------------------------------------------------------------

FUNCTIONAL = """\
Prefix(:=<http://example.com/home#>)
Ontology(<http://example.com/home>
EquivalentClasses(:Cup <http://a#A> <http://b#B>)
EquivalentClasses(:Mug ObjectIntersectionOf(:Cup ObjectSomeValuesFrom(:hasPart :Handle)))
)
"""
MANCHESTER = """\
Prefix: : <http://example.com/home#>

Ontology: <http://example.com/home>

ObjectProperty: hasPart

Class: Cup
    EquivalentTo: <http://a#A>, <http://b#B>

Class: Mug
    EquivalentTo: Cup and (hasPart some Handle)
"""
OWL_XML = """\
<?xml version="1.0"?>
<Ontology xmlns="http://www.w3.org/2002/07/owl#" xml:base="http://example.com/home"
    ontologyIRI="http://example.com/home">
    <EquivalentClasses><Class IRI="#Cup"/><Class IRI="http://a#A"/><Class IRI="http://b#B"/></EquivalentClasses>
    <EquivalentClasses>
        <Class IRI="#Mug"/>
        <ObjectIntersectionOf>
            <Class IRI="#Cup"/>
            <ObjectSomeValuesFrom><ObjectProperty IRI="#hasPart"/><Class IRI="#Handle"/></ObjectSomeValuesFrom>
        </ObjectIntersectionOf>
    </EquivalentClasses>
</Ontology>
"""
TURTLE = (
    PREFIXES
    + """\
<http://example.com/home> a owl:Ontology .
:Cup owl:equivalentClass <http://a#A> . <http://b#B> owl:equivalentClass :Cup .
:Mug owl:equivalentClass [ a owl:Class ; owl:intersectionOf
    ( :Cup [ a owl:Restriction ; owl:onProperty :hasPart ; owl:someValuesFrom :Handle ] ) ] .
"""
)


@pytest.mark.parametrize("text", [FUNCTIONAL, MANCHESTER, OWL_XML, TURTLE], ids=["ofn", "omn", "owx", "ttl"])
def test_equivalents_are_the_same_in_all_syntaxes(tmp_path, text):
    path = tmp_path / "home.owl"
    path.write_text(text, encoding="utf-8")
    tbox = load_tbox(path)
    assert parents(tbox) == {"Cup": (), "Mug": ("Cup",)}
    assert equivalents(tbox) == {"Cup": ("http://a#A", "http://b#B")}
