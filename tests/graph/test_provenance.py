"""Provenance of the run, justification of classes, and reviews."""

from dataclasses import replace
from datetime import UTC, datetime

import pyoxigraph as ox
import pytest

from tests.graph.records import BASE, ask, ground_as, reread, said_of, select, thing
from tests.grounding.records import make_class, make_scene, make_tbox
from usd2kg.errors import GraphError
from usd2kg.graph import GraphOptions, KnowledgeGraph, instantiate, read_epoch, read_time, serialize_graph
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.grounding import Candidate, Prediction, Status
from usd2kg.ontology import TBox

CUP = thing("/Cup", (1, 0.4, 0.7), (0.09, 0.12, 0.1))
TABLE = thing("/Table", (0, 0, 0), (1.6, 0.8, 0.7))
U2K = "https://w3id.org/usd2kg#"
SSSOM = "https://w3id.org/sssom/"
SEMAPV = "https://w3id.org/semapv/vocab/"


def build(tbox: TBox, options: GraphOptions | None = None, **changes: object) -> KnowledgeGraph:
    """Return the graph of a cup on a table, with `changes` to the prediction of the cup."""
    scene = make_scene(TABLE, CUP)
    grounding = ground_as(tbox, scene, {"/Cup": "Cup", "/Table": "Table"})
    table, cup = grounding.predictions
    grounding = replace(grounding, predictions=(table, replace(cup, **changes)))
    return instantiate(scene, tbox, grounding, base=BASE, options=options)


class TestRun:
    def test_run_is_an_activity_with_inputs_software_and_settings(self, home_tbox: TBox):
        store = reread(build(home_tbox))
        assert ask(
            store,
            "<https://my.lab/k> a owl:Ontology ; u2k:run ?run ."
            ' ?run a prov:Activity ; u2k:grounder "by-hand" ; u2k:setting "regime=semantic" ; u2k:isCalibrated false ;'
            " prov:used ?stage, ?ontology ; prov:wasAssociatedWith ?software ."
            ' ?stage a usd:Stage, prov:Entity ; rdfs:label "room.usda" ; u2k:contentHash "sha256:5ce7e" ;'
            ' u2k:upAxis "Z" ; u2k:metresPerUnit "1"^^xsd:double .'
            f' ?ontology a prov:Entity ; u2k:contentHash "{home_tbox.content_hash}" ;'
            " u2k:ontologyIri <http://www.ease-crc.org/ont/SOMA-HOME.owl> ."
            ' ?software a prov:SoftwareAgent ; rdfs:label "usd2kg" ; u2k:version "0.1.0"',
        )

    def test_writes_the_version_iri_of_the_ontology(self):
        tbox = replace(make_tbox(make_class("Cup"), make_class("Table")), version_iri="https://lab.example/onto/2")
        assert ask(reread(build(tbox)), "?o u2k:ontologyVersionIri <https://lab.example/onto/2>")

    def test_ontology_without_an_iri(self):
        tbox = replace(make_tbox(make_class("Cup"), make_class("Table")), ontology_iri="file:///somewhere/lab.ttl")
        store = reread(build(tbox))
        assert not ask(store, "?o u2k:ontologyIri ?i")
        assert not ask(store, "?o rdfs:label ?l FILTER(CONTAINS(?l, 'somewhere'))")

    def test_writes_the_time_code(self, home_tbox: TBox):
        scene = replace(make_scene(CUP), time=24.0)
        store = reread(instantiate(scene, home_tbox, ground_as(home_tbox, scene, {}), base=BASE))
        assert ask(store, '?s a usd:Stage ; u2k:timeCode "24"^^xsd:double')


class TestTime:
    def test_time_is_omitted_by_default(self, home_tbox: TBox):
        assert not ask(reread(build(home_tbox)), "?r prov:endedAtTime ?t")

    def test_time_is_written_in_utc(self, home_tbox: TBox):
        options = GraphOptions(time=read_time("2026-07-15T14:00:00+02:00"))
        store = reread(build(home_tbox, options))
        assert ask(store, '?r a prov:Activity ; prov:endedAtTime "2026-07-15T12:00:00Z"^^xsd:dateTime')

    def test_source_date_epoch_is_seconds_since_1970(self):
        assert read_epoch("86400") == datetime(1970, 1, 2, tzinfo=UTC)

    def test_now_is_the_current_time(self):
        before = datetime.now(UTC).replace(microsecond=0)
        assert before <= read_time("now") <= datetime.now(UTC)

    @pytest.mark.parametrize("text", ["yesterday", "2026-07-15T12:00:00", "2026-07-15", "", "12:00Z"])
    def test_rejects_an_invalid_time(self, text: str):
        with pytest.raises(GraphError, match="expected now, or one like 2026-07-15T12:00:00Z"):
            read_time(text)

    @pytest.mark.parametrize("text", ["soon", "1e9", "", "9" * 40])
    def test_rejects_an_invalid_epoch(self, text: str):
        with pytest.raises(GraphError, match="expected whole seconds since 1970"):
            read_epoch(text)


class TestJustification:
    @pytest.mark.parametrize(
        ("grounder", "process"),
        [
            ("lexical", "CompositeMatching"),
            ("dictionary", "LexicalMatching"),
            ("embedding", "SemanticSimilarityThresholdMatching"),
            ("volume", "BackgroundKnowledgeBasedMatching"),
            ("llm-B:google:gemini", "BackgroundKnowledgeBasedMatching"),
            ("by-hand", "UnspecifiedMatching"),
        ],
    )
    def test_matching_process_depends_on_the_grounder(self, home_tbox: TBox, grounder: str, process: str):
        said = said_of(reread(build(home_tbox, grounder=grounder)), "k:Cup rdf:type soma:Cup")
        assert said[SSSOM + "mapping_justification"] == SEMAPV + process
        assert said[U2K + "grounder"] == grounder


REVIEWER = "https://orcid.org/0000-0001-2345-6789"


def reviewed(tbox: TBox, name: str | None, reviewer: str = REVIEWER, **said: object) -> ox.Store:
    """Return the graph after a review of the cup, which was predicted with 0.75."""
    predicted = Prediction(
        "/Cup",
        tbox.resolve("Cup"),
        0.75,
        Status.GROUNDED,
        "lexical",
        "“cup” is the label",
        ("name",),
        (Candidate(tbox.resolve("Cup"), 0.75), Candidate(tbox.resolve("Glass"), 0.1)),
    )
    decided = predicted.reviewed(tbox.resolve(name) if name else None, reviewer, **said)  # type: ignore[arg-type]
    scene = make_scene(TABLE, CUP)
    grounding = ground_as(tbox, scene, {"/Table": "Table"})
    grounding = replace(grounding, predictions=(grounding.predictions[0], decided))
    return reread(instantiate(scene, tbox, grounding, base=BASE))


class TestReview:
    def test_a_correction_overrides_the_prediction_and_keeps_it(self, home_tbox: TBox):
        store = reviewed(home_tbox, "Bowl", confidence=0.9, comment="it has no handle", time="2026-07-15T12:00:00Z")
        assert ask(store, "k:Cup a soma:Bowl")
        assert not ask(store, "k:Cup a soma:Cup")
        said = said_of(store, "k:Cup rdf:type soma:Bowl")
        assert said[SSSOM + "confidence"] == "0.9"
        assert said[SSSOM + "mapping_justification"] == SEMAPV + "ManualMappingCuration"
        assert said[SSSOM + "reviewer_id"] == REVIEWER
        assert said[U2K + "status"] == "reviewed"
        assert said[U2K + "reviewComment"] == "it has no handle"
        assert said[U2K + "reviewTime"] == "2026-07-15T12:00:00Z"
        assert said[U2K + "predictedClass"] == home_tbox.resolve("Cup")
        assert said[U2K + "predictedConfidence"] == "0.75"
        assert (said[U2K + "grounder"], said[U2K + "explanation"]) == ("lexical", "“cup” is the label")

    def test_confirmation_keeps_the_matching_process(self, home_tbox: TBox):
        said = said_of(reviewed(home_tbox, "Cup", "Ada Lovelace"), "k:Cup rdf:type soma:Cup")
        assert said[SSSOM + "mapping_justification"] == SEMAPV + "CompositeMatching"
        assert said[SSSOM + "reviewer_label"] == "Ada Lovelace"
        assert SSSOM + "confidence" not in said, "reviews have no confidence"
        assert said[U2K + "predictedConfidence"] == "0.75"
        assert U2K + "predictedClass" not in said

    def test_review_without_a_class(self, home_tbox: TBox):
        store = reviewed(home_tbox, None, comment="a sculpture")
        assert not ask(store, "k:Cup a soma:Cup")
        assert ask(
            store,
            f'k:Cup u2k:status "reviewed" ; sssom:reviewer_id <{REVIEWER}> ; u2k:reviewComment "a sculpture" ;'
            ' u2k:predictedClass soma:Cup ; u2k:predictedConfidence "0.75"^^xsd:double',
        )


class TestRdf12:
    def test_reifiers_have_the_same_annotations_as_owl_axioms(self, home_tbox: TBox):
        graph = build(home_tbox, GraphOptions(annotations="rdf12"))
        for ending in (".ttl", ".nt"):
            store = reread(graph, ending)
            found = store.query(
                "SELECT ?c { ?r rdf:reifies <<( k:Cup rdf:type soma:Cup )>> ; sssom:confidence ?c }",
                prefixes={**PREFIXES, "k": BASE},
            )
            assert [row["c"].value for row in found] == ["0.75"]
            rules = store.query(
                "SELECT ?v { ?r rdf:reifies <<( k:Cup soma:isOntopOf k:Table )>> ; u2k:rule ?v }",
                prefixes={**PREFIXES, "k": BASE},
            )
            assert [row["v"].value for row in rules] == ["on/1"]
            assert ask(store, "k:Cup a soma:Cup ; soma:isOntopOf k:Table"), "a reified triple is not asserted by itself"
            assert not ask(store, "?x a owl:Axiom")

    def test_both_annotation_styles_are_equivalent(self, home_tbox: TBox):
        """Axioms and reifiers of the same triple have the same annotations."""
        owl, rdf12 = (reread(build(home_tbox, GraphOptions(annotations=name))) for name in ("owl", "rdf12"))
        others = "FILTER(!STRSTARTS(STR(?n), STR(owl:)) && ?n NOT IN (rdf:type, rdf:reifies))"
        query = "SELECT ?s ?p ?o ?n ?v {{ {} ; ?n ?v . " + others + " }}"
        axioms = select(
            owl, query.format("?x owl:annotatedSource ?s ; owl:annotatedProperty ?p ; owl:annotatedTarget ?o")
        )
        assert axioms
        assert select(rdf12, query.format("?x rdf:reifies <<( ?s ?p ?o )>>")) == axioms

    def test_the_same_input_gives_the_same_bytes(self, home_tbox: TBox):
        options = GraphOptions(annotations="rdf12")
        first, second = (serialize_graph(build(home_tbox, options), ox.RdfFormat.TURTLE) for _ in range(2))
        assert first == second

    def test_rejects_an_unknown_annotation_style(self):
        with pytest.raises(GraphError, match="annotations 'rdfstar' is unknown; expected one of owl, rdf12"):
            GraphOptions(annotations="rdfstar")
