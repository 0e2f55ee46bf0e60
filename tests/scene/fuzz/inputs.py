"""Small ontologies, graphs and SSSOM files, which are mutated like stages."""

import itertools
import random
from collections.abc import Iterator

from tests.scene.fuzz.loop import Case
from tests.scene.fuzz.mutators import mangle_bytes
from usd2kg.ontology.limits import NESTING

__all__ = ["INPUTS", "input_cases"]

_TURTLE = b"""@prefix : <http://x#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix u2k: <https://w3id.org/usd2kg#> .
<http://x> a owl:Ontology ; owl:imports <http://y> ; owl:versionIRI <http://x/1> .
:A a owl:Class ; rdfs:label "a thing"@en . :B rdfs:subClassOf :A ; owl:equivalentClass
  [ owl:intersectionOf ( :A :C ) ] .
:D owl:equivalentClass :B ; rdfs:subClassOf [ owl:onProperty :p ; owl:someValuesFrom :A ] .
:o a :B, u2k:Object ; rdfs:label "cup 1" ; u2k:primPath "/World/cup" ; u2k:on :t ; u2k:boxCenter "0 0 1" ;
  u2k:mass 1.5 .
:t a :A, u2k:Object ; rdfs:label "table" ; u2k:primPath "/World/table" ; u2k:explanation <<( :o a :B )>> .
"""
INPUTS: dict[str, bytes] = {
    "a.ttl": _TURTLE,
    "graph.ttl": _TURTLE,
    "a.ofn": b"Prefix(:=<http://x#>)\nOntology(<http://x>\nImport(<http://y>)\nSubClassOf(:B ObjectIntersectionOf(:A "
    b'ObjectSomeValuesFrom(:p :C)))\nEquivalentClasses(:B :D)\nAnnotationAssertion(:label :B "a cup"@en)\n)',
    "a.omn": b"Prefix: : <http://x#>\nOntology: <http://x>\nObjectProperty: :p\nClass: :C\nClass: :A\n  SubClassOf: "
    b":C and (:p some (:C or not (:C)))\n",
    "a.owx": b'<Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://x"><SubClassOf><Class IRI="#A"/>'
    b'<ObjectComplementOf><Class IRI="#B"/></ObjectComplementOf></SubClassOf></Ontology>',
    "a.rdf": b'<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:rdfs="http://www.w3.org/2000/01/'
    b'rdf-schema#"><rdf:Description rdf:about="http://x#A"><rdfs:subClassOf rdf:resource="http://x#B"/>'
    b"</rdf:Description></rdf:RDF>",
    "a.jsonld": b'{"@id": "http://x#A", "http://www.w3.org/2000/01/rdf-schema#subClassOf": {"@id": "http://x#B"}}',
    "graph.jsonld": b'{"@id": "http://x#o", "https://w3id.org/usd2kg#primPath": "/World/cup"}',
    "a.tsv": b"#curie_map:\n#  soma: http://www.ease-crc.org/ont/SOMA.owl#\nsubject_id\tpredicate_id\tobject_id\t"
    b"mapping_justification\treviewer_label\tprim_path\nx:a\trdf:type\tsoma:Cup\tsemapv:ManualMappingCuration\tAnn\t/a\n",
}
_BRACKETS = (
    (b"(", b")"),
    (b"[ :p ", b" ]"),
    (b"<<( :a :b ", b" )>>"),
    (b"<a>", b"</a>"),
    (b'{"a":', b"}"),
    (b"not (", b")"),
)


def _nest(data: bytes, rng: random.Random) -> bytes:
    """Insert brackets, sometimes deeper than any limit."""
    start, end = rng.choice(_BRACKETS)
    depth = rng.choice((1, 30, NESTING.owl_levels, 2_000, 20_000))
    at = rng.randrange(len(data) + 1)
    return data[:at] + start * depth + b":A" + end * depth + data[at:]


def _repeat(data: bytes, rng: random.Random) -> bytes:
    """Repeat a part many times."""
    at = rng.randrange(len(data) + 1)
    return data[:at] + data[at : at + rng.randrange(1, 80)] * rng.choice((2, 100, 2_000)) + data[at:]


def input_cases(seed: int) -> Iterator[Case]:
    """Yield an endless sequence of mutated files."""
    for number in itertools.count():
        rng = random.Random(f"{seed} input {number}")
        name, data = rng.choice(list(INPUTS.items()))
        for mutate in rng.choices((mangle_bytes, _nest, _repeat), weights=(6, 2, 1), k=rng.choice((1, 1, 2))):
            data = mutate((data.decode(errors="ignore") or " ").encode(), rng)
        yield Case(f"{seed} {number} {name}", {name: data})
