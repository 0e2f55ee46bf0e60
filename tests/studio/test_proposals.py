"""Subclasses that reviewers propose: kept with the decision, and written as OWL."""

from pathlib import Path
from types import SimpleNamespace

import pyoxigraph as ox
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.studio.conftest import HOSTILE, Client, running_studio
from tests.studio.test_application import CUP_1, CUP_2, TABLE, THING, class_index, decide, states
from usd2kg.grounding import Prediction, Status
from usd2kg.ontology import TBox, load_tbox
from usd2kg.readiness import format_suggestions
from usd2kg.studio.decision_request import read_decision
from usd2kg.studio.object_review import ObjectReview, ReviewStatus
from usd2kg.studio.proposals import find_proposals
from usd2kg.studio.request_body import BadRequestError
from usd2kg.studio.verdicts import Verdict, VerdictKind

PREDICTION = Prediction("/A", None, None, Status.REFUSED, "test", "")
ORCID = "https://orcid.org/0000-0002-1825-0097"


def propose(studio: Client, objects: list[int], label: str, parent: str, reviewer: str = "Ann", comment: str = ""):
    return decide(
        studio,
        objects,
        "choose",
        reviewer,
        proposal=label,
        comment=comment,
        **{"class": class_index(studio, parent)},
    )


def exported(studio: Client) -> ox.Store:
    store = ox.Store()
    store.load(studio.ask("api/export/proposals.ttl").body, format=ox.RdfFormat.TURTLE)
    return store


def proposed(store: ox.Store) -> list[tuple[str, ...]]:
    query = """
        PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#> PREFIX skos: <http://www.w3.org/2004/02/skos/core#>
        PREFIX dcterms: <http://purl.org/dc/terms/>
        SELECT ?label ?parent ?who ?note ?path {
            ?c rdfs:label ?label ; rdfs:subClassOf ?parent ; dcterms:creator ?who ; skos:example ?path
            OPTIONAL { ?c skos:editorialNote ?note }
        } ORDER BY ?label ?path"""
    return [tuple(cell.value if cell is not None else "" for cell in row) for row in store.query(query)]


@pytest.mark.studio
def test_a_proposal_is_the_superclass_until_then(studio: Client):
    cup = class_index(studio, "Cup")
    reply = propose(studio, [CUP_1, CUP_2], "Espresso cup", "Cup", ORCID, "small, with a saucer")
    assert [(state["class"], state["proposal"]) for state in reply["states"]] == [(cup, "Espresso cup")] * 2
    (first, second) = proposed(exported(studio))
    iri = "http://www.ease-crc.org/ont/SOMA.owl#Cup"
    assert first == ("Espresso cup", iri, ORCID, "small, with a saucer", "/Kitchen/Cup_1")
    assert second[4] == "/Kitchen/Cup_2"
    assert "soma:Cup" in studio.ask("api/export/graph.ttl").body.decode()
    assert studio.ask(f"api/object/{CUP_1}").json()["history"][0]["proposal"] == "Espresso cup"
    # Another decision about one of the objects takes it out.
    decide(studio, [CUP_2], "no-class", "Bob")
    assert [row[4] for row in proposed(exported(studio))] == ["/Kitchen/Cup_1"]
    studio.ask("api/undo", {"reviewer": ORCID})
    assert proposed(exported(studio)) == []
    assert states(studio)[CUP_1] == "suggested"


@pytest.mark.studio
def test_proposals_survive_a_restart_and_are_an_ontology(stage: Path, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(stage, folder) as studio:
        propose(studio, [CUP_1], "cup with handle", "Cup")
        propose(studio, [CUP_2], "Cup with Handle", "Cup", "Bob")
        propose(studio, [THING], HOSTILE, "DesignedArtifact")
    with running_studio(stage, folder) as studio:
        rows = proposed(exported(studio))
        assert {row[0] for row in rows} == {"cup with handle", HOSTILE}
        assert studio.ask("api/undo", {"reviewer": "Bob"}).status == 200
    (handle,) = [cls for cls in load_tbox(folder / "proposals.ttl").classes if cls.label == "cup with handle"]
    assert handle.comment == ""
    assert 'skos:example "/Kitchen/Cup_1"' in (folder / "proposals.ttl").read_text("utf-8")
    assert [parent.rpartition("#")[2] for parent in handle.parents] == ["Cup"]


@pytest.mark.studio
@pytest.mark.parametrize(
    ("label", "action", "message"),
    [
        ("two\nlines", "choose", "on one line"),
        ("\u202etxet", "choose", "on one line"),
        ("\ud800", "choose", "the body is not JSON"),
        ("_ !", "choose", "expected letters"),
        ("x" * 101, "choose", "at most 100 characters"),
        ("CUPBOARD", "choose", "the ontology has the class Cupboard; choose it"),
        ("Espresso cup", "confirm", "expected the action choose"),
        (3, "choose", "found int, expected str"),
    ],
)
def test_labels_that_are_none_are_refused(studio: Client, label: object, action: str, message: str):
    body = {"objects": [TABLE], "action": action, "class": 0, "proposal": label, "reviewer": "Ann"}
    reply = studio.ask("api/decisions", body)
    assert reply.status == 400
    assert message in reply.json()["error"]


@settings(max_examples=200, deadline=None)
@given(label=st.text(min_size=1, max_size=12))
def test_every_accepted_label_can_be_written_and_read(home_tbox: TBox, label: str):
    body = {"action": "choose", "class": 0, "proposal": label}
    try:
        decision = read_decision(body, ["/A"], SimpleNamespace(tbox=home_tbox), None)  # type: ignore[arg-type]
    except BadRequestError:
        return
    verdict = decision.verdicts["/A"]
    if verdict.proposal == "":
        return
    state = ObjectReview("/A", ReviewStatus.CORRECTED, verdict.class_iri, PREDICTION, verdict, False)
    (one,) = find_proposals([state], SimpleNamespace(concepts={}))  # type: ignore[arg-type]
    found = ox.parse(format_suggestions([one], home_tbox), format=ox.RdfFormat.TURTLE)
    label_iri = "http://www.w3.org/2000/01/rdf-schema#label"
    assert [triple.object.value for triple in found if triple.predicate.value == label_iri] == [label.strip()]


def test_the_concept_is_named_only_if_the_label_is_its_own(home_tbox: TBox):
    cup = Verdict(VerdictKind.CLASS, home_tbox.resolve("Cup"), "Ann", "2026-11-27T10:00:00+00:00", proposal="Mug")
    states = [ObjectReview("/A", ReviewStatus.CONFIRMED, cup.class_iri, PREDICTION, cup, False)]
    (one,) = find_proposals(states, SimpleNamespace(concepts={}))  # type: ignore[arg-type]
    assert (one.label, one.concept, one.objects) == ("Mug", None, ("/A",))
    assert one.proposals[0].reviewer == "Ann"
