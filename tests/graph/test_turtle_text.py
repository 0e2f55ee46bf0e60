"""Our Turtle is what pyoxigraph's serialiser writes, and its parser reads the same triples."""

import pyoxigraph as ox
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.graph.turtle_text import TurtleText
from usd2kg.graph.vocabulary import RDF, RDFS, XSD, Triple

BASE = "https://my.lab/k#"
PREFIXES = {"": BASE, "rdf": RDF.iri, "xsd": XSD.iri}
CUP = ox.NamedNode(BASE + "Cup")
LOCAL_NAMES = " a 1a _a a-b -a a.b a. .a a:b a/b a%20b a'b(c)!$&*+,;=?@~ é ·".split(" ")
NUMBERS = [
    (value, kind)
    for kind in ("integer", "decimal", "double", "boolean", "int", "dateTime", "string")
    for value in ("1", "+1", "-07", "1.", ".5", "1.50", "1e5", "1.E-5", ".5E+1", "INF", "true", "False", "", "\u0661")
]

texts = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"))
names = st.sampled_from(LOCAL_NAMES).map(lambda local: ox.NamedNode(BASE + local)) | st.sampled_from(
    [ox.NamedNode("urn:x:y"), RDF.type, XSD.double, ox.NamedNode(RDFS.iri + "label")]
)
blanks = st.from_regex(r"[a-z][a-z0-9]{0,5}", fullmatch=True).map(ox.BlankNode)
literals = (
    texts.map(ox.Literal)
    | st.builds(ox.Literal, texts, language=st.sampled_from(["en", "de-ch"]))
    | st.builds(ox.Literal, texts, language=st.just("ar"), direction=st.just(ox.BaseDirection.RTL))
    | st.sampled_from(NUMBERS).map(lambda pair: ox.Literal(pair[0], datatype=XSD[pair[1]]))
    | st.builds(ox.Literal, texts, datatype=names)
)
subjects = names | blanks
terms = st.builds(ox.Triple, subjects, names, subjects | literals)
triples = st.lists(st.tuples(subjects, names, subjects | literals | terms), min_size=1, max_size=12)


def own_serialiser(stated: list[Triple]) -> str:
    data = ox.serialize([ox.Triple(*triple) for triple in stated], format=ox.RdfFormat.TURTLE, prefixes=PREFIXES)
    assert data is not None
    return "".join(data.decode().splitlines(keepends=True)[len(PREFIXES) :])


@given(triples)
def test_the_parser_reads_what_was_written(stated: list[Triple]) -> None:
    lines = "".join(f"@prefix {name}: <{iri}> .\n" for name, iri in PREFIXES.items())
    parsed = ox.parse(lines + TurtleText(PREFIXES).statements(stated), format=ox.RdfFormat.TURTLE)
    assert [tuple(quad.triple) for quad in parsed] == stated


@pytest.mark.parametrize("value, kind", NUMBERS)
def test_literals_are_written_as_by_pyoxigraph(value: str, kind: str) -> None:
    stated: list[Triple] = [(CUP, RDFS.label, ox.Literal(value, datatype=XSD[kind]))]
    assert TurtleText(PREFIXES).statements(stated) == own_serialiser(stated)


@pytest.mark.parametrize("local", [name for name in LOCAL_NAMES if name.isascii()])
def test_names_are_written_as_by_pyoxigraph(local: str) -> None:
    stated: list[Triple] = [(ox.NamedNode(BASE + local), RDF.type, ox.NamedNode(BASE + local))]
    assert TurtleText(PREFIXES).statements(stated) == own_serialiser(stated)


def test_neighbours_share_subject_and_predicate() -> None:
    axiom = ox.BlankNode("axiom")
    stated: list[Triple] = [
        (CUP, RDF.type, CUP),
        (CUP, RDF.type, RDF.type),
        (CUP, RDFS.label, ox.Literal("a \u201ccup\u201d\n", language="en")),
        (axiom, RDFS.label, ox.Triple(CUP, RDF.type, CUP)),
        (CUP, RDFS.label, axiom),
    ]
    assert TurtleText(PREFIXES).statements(stated) == own_serialiser(stated)
    assert TurtleText(PREFIXES).statements([]) == ""


def test_the_longest_namespace_is_preferred() -> None:
    text = TurtleText({"k": "https://my.lab/", "c": "https://my.lab/k#"})
    assert text.statements([(CUP, CUP, ox.NamedNode("https://my.lab/k"))]) == "c:Cup c:Cup k:k .\n"
    assert TurtleText({}).statements([(CUP, CUP, CUP)]) == f"{CUP} {CUP} {CUP} .\n"
