"""The mapping of prims to classes as SSSOM/TSV (https://mapping-commons.github.io/sssom/spec/), version 1.1.

The predicate is rdf:type, since the subject is an individual and the object a class. SSSOM's usual SKOS mapping
predicates relate concepts.
"""

import re
from collections.abc import Mapping
from datetime import date
from pathlib import Path

from usd2kg.errors import GraphError
from usd2kg.graph.document_prefixes import document_prefixes
from usd2kg.graph.iris import check_base, default_base, individual_iri
from usd2kg.graph.justification import matching_process
from usd2kg.graph.vocabulary import PREFIXES, SSSOM, named_node
from usd2kg.grounding import Grounding, Prediction, Status
from usd2kg.grounding.sssom_file import Curies, cell_text, format_sssom_file
from usd2kg.ontology import TBox

__all__ = ["UNSPECIFIED_LICENSE", "format_sssom"]

UNSPECIFIED_LICENSE = "https://w3id.org/sssom/license/unspecified"
"""SSSOM's value for an unspecified licence."""

_COLUMNS = (
    "subject_id",
    "subject_label",
    "predicate_id",
    "object_id",
    "object_label",
    "mapping_justification",
    "reviewer_id",
    "reviewer_label",
    "review_date",
    "confidence",
    "comment",
    "prim_path",
    "status",
    "grounder",
    "alternatives",
    "concept",
    "concept_label",
    "concept_confidence",
)
_EXTENSIONS = {
    "prim_path": "u2k:primPath",
    "status": "u2k:status",
    "grounder": "u2k:grounder",
    "alternatives": "u2k:alternative",
    "concept": "u2k:concept",
    "concept_label": "skos:prefLabel",
    "concept_confidence": "u2k:conceptConfidence",
}
"""Extension column → CURIE of its property."""
_CLAIMS = frozenset({Status.REFUSED, Status.REVIEWED})
"""Statuses that mean "no class fits" if the prediction has no class."""
_PREFIX = "scene"


def format_sssom(
    grounding: Grounding,
    tbox: TBox,
    names: Mapping[str, str],
    *,
    base: str | None = None,
    license_iri: str = UNSPECIFIED_LICENSE,
    mapping_date: str | None = None,
) -> str:
    """Return the mapping as SSSOM/TSV, with extension columns for prim path, status, grounder, alternatives, concept.

    Objects without an answer (failed, unreadable, missing) have no row; objects that no class fits map to
    sssom:NoTermFound.

    Args:
        grounding: the mapping.
        tbox: the classes.
        names: prim path → label, as in the graph.
        base: namespace of the individuals; by default derived from the file name, as for graphs.
        license_iri: the licence of the mapping.
        mapping_date: ISO date such as 2026-07-15; None omits it, which keeps the output reproducible.

    Raises:
        GraphError: the base or the licence is not an absolute IRI, or the date is invalid.
    """
    base = check_base(base or default_base(grounding.scene))
    if named_node(license_iri) is None:
        raise GraphError(f"license {license_iri!r}: expected an IRI, like https://creativecommons.org/licenses/by/4.0/")
    prefixes = {**document_prefixes(tbox), "orcid": "https://orcid.org/", _PREFIX: base}
    curies = Curies(prefixes, used=(_PREFIX, "skos", "u2k", "xsd"))
    rows = [
        {**_row(p, tbox, names, base, curies), **_concept_cells(p, grounding, curies)}
        for p in grounding.predictions
        if p.class_iri or p.status in _CLAIMS
    ]
    header = _header(grounding, tbox, base, curies)
    dates = {"mapping_date": _read_date(mapping_date)} if mapping_date else {}
    return format_sssom_file({**header, "license": license_iri, **dates}, curies, _EXTENSIONS, _COLUMNS, rows)


def _read_date(text: str) -> str:
    try:
        return date.fromisoformat(text).isoformat()
    except ValueError as error:
        raise GraphError(f"mapping date {text!r}: {error}; expected one like 2026-07-15") from error


def _header(grounding: Grounding, tbox: TBox, base: str, curies: Curies) -> dict[str, str]:
    found = {
        "mapping_set_id": individual_iri(base, "/", "mapping"),
        "mapping_set_title": f"Classes of the objects of {Path(grounding.scene).name}",
        "mapping_tool": "usd2kg",
        "mapping_tool_version": grounding.tool_version,
        "subject_type": "owl named individual",
        "object_type": "owl class",
        "predicate_type": "rdf property",
        "subject_source": curies.shorten(individual_iri(base, "/", "stage")),
        "subject_source_version": grounding.scene_hash,
    }
    if not tbox.ontology_iri.startswith("file:"):
        found["object_source"] = curies.shorten(tbox.ontology_iri)
    return {**found, "object_source_version": tbox.version_iri or tbox.content_hash}


def _row(p: Prediction, tbox: TBox, names: Mapping[str, str], base: str, curies: Curies) -> dict[str, str]:
    review = p.review
    has_id = review is not None and named_node(review.reviewer) is not None
    day = review.time[:10] if review is not None else ""
    others = [candidate.class_iri for candidate in p.candidates if candidate.class_iri != p.class_iri]
    return {
        "subject_id": curies.shorten(individual_iri(base, p.prim_path)),
        "subject_label": cell_text(names.get(p.prim_path) or p.prim_path.rpartition("/")[2]),
        "predicate_id": curies.shorten(f"{PREFIXES['rdf']}type"),
        "object_id": curies.shorten(p.class_iri or f"{SSSOM.iri}NoTermFound"),
        "object_label": cell_text(tbox.by_iri[p.class_iri].label) if p.class_iri else "",
        "mapping_justification": curies.shorten(matching_process(p).value),
        "reviewer_id": curies.shorten(review.reviewer) if review is not None and has_id else "",
        "reviewer_label": _item(review.reviewer) if review is not None and review.reviewer and not has_id else "",
        "review_date": day if re.fullmatch(r"\d{4}-\d{2}-\d{2}", day, flags=re.ASCII) else "",
        "confidence": "" if p.confidence is None else f"{p.confidence:.4f}",
        "comment": cell_text("; ".join(filter(None, (p.explanation, review.comment if review is not None else "")))),
        "prim_path": p.prim_path,
        "status": p.status.value,
        "grounder": cell_text(p.grounder),
        "alternatives": "|".join(curies.shorten(iri) for iri in others),
    }


def _concept_cells(p: Prediction, grounding: Grounding, curies: Curies) -> dict[str, str]:
    concept = grounding.concepts.get(p.concept or "")
    if concept is None:
        return {}
    return {
        "concept": curies.shorten(concept.iri),
        "concept_label": cell_text(concept.label),
        "concept_confidence": f"{p.concept_confidence or 0.0:.4f}",
    }


def _item(text: str) -> str:
    """Return text escaped as an item of a |-separated list."""
    return cell_text(text).replace("|", r"\|")
