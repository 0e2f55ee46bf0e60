"""Scenes and TBoxes written by hand, so that grounding is tested without OpenUSD or OWL files."""

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any

from usd2kg.grounding import ObjectView, Prediction
from usd2kg.grounding.context import Neighbour, Neighbourhood
from usd2kg.grounding.context.stage_words import WriteForms
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.reading.abbreviations import AbbreviationReader
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.ontology import OntologyClass, TBox, load_home_tbox
from usd2kg.scene import Joint, Scene, SceneObject, StageFrame

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
LAB = "https://lab.example/onto#"
DUL = "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#"


def make_object(path: str, **known: Any) -> SceneObject:
    """Return an object at a path with the fields of `known`; all other fields are empty."""
    blank: dict[str, Any] = {
        "prim_path": path,
        "name": path.rpartition("/")[2],
        "type_name": "Xform",
        "kind": "component",
        "selected_by": "written by hand",
        "parent_path": None,
        "box": None,
        "own_box": None,
        "part_boxes": (),
        "position": None,
        "orientation": None,
        "mass_kg": None,
        "display_name": "",
        "documentation": "",
        "asset": (),
        "materials": (),
        "parts": (),
        "display_color": None,
        "instance_of": None,
    }
    return SceneObject(**(blank | known))


def make_scene(*objects: SceneObject, source: str = "room.usda", joints: tuple[Joint, ...] = ()) -> Scene:
    return Scene(
        source=source,
        content_hash="sha256:5ce7e",
        frame=StageFrame("Z", 1.0, 1.0, True),
        time=None,
        prim_count=len(objects),
        objects=objects,
        left_out={},
        joints=tuple(joints),
    )


def scene_of(*paths: str) -> Scene:
    return make_scene(*(make_object(path) for path in paths))


def make_class(
    name: str, *parents: str, label: str = "", synonyms: Iterable[str] = (), comment: str = "", base: str = LAB
) -> OntologyClass:
    return OntologyClass(
        iri=base + name,
        label=label or name,
        alt_labels=tuple(sorted(synonyms)),
        comment=comment,
        parents=tuple(sorted(base + parent for parent in parents)),
    )


def make_tbox(*classes: OntologyClass) -> TBox:
    return TBox(
        source="written by hand",
        ontology_iri="https://lab.example/onto",
        version_iri=None,
        content_hash="sha256:7b0c5",
        classes=tuple(sorted(classes, key=lambda cls: cls.iri)),
    )


def ground_names(names: Sequence[str], tbox: TBox, **evidence: Any) -> list[Prediction]:
    """Return the predictions of the lexical grounder for bare names."""
    views = [(f"/Room/thing{i}", ObjectView(name=name, **evidence)) for i, name in enumerate(names)]
    return LexicalGrounder().ground_views(views, tbox)


def ground_view(view: ObjectView, tbox: TBox) -> Prediction:
    return LexicalGrounder().ground_views([("/Room/thing", view)], tbox)[0]


@lru_cache(maxsize=1)
def _home_readers() -> tuple[NameReader, AbbreviationReader]:
    lexicon, taxonomy = build_lexicon(load_home_tbox(), load_taxonomy(), {}), load_taxonomy()
    return NameReader(lexicon, taxonomy), AbbreviationReader(lexicon, taxonomy)


def read_name(name: str, parents: tuple[str, ...] = ()) -> NamePhrase:
    """Return a name below these parents as a noun phrase, with the words of the home ontology."""
    return _home_readers()[0].read(name, parents)


def read_words(name: str, parents: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return the words of a name below these parents."""
    return read_name(name, parents).words


def read_abbreviation(tokens: Sequence[str]) -> tuple[str, ...]:
    """Return the likeliest words behind abbreviated tokens, in the home ontology."""
    return next((reading.words for reading in _home_readers()[1].read(tokens)), ())


def local(prediction: Prediction) -> str:
    """Return the local name of a prediction's class, empty if it has none."""
    return (prediction.class_iri or "").rpartition("#")[2]


def words_written(neighbourhood: Neighbourhood, form: str, ways: WriteForms) -> list[tuple[str, float, float]]:
    """Return (word, share of the other objects, score) of the words that a form may abbreviate, sorted."""
    return neighbourhood.words_by_form(ways, _as_it_is, _all_of_them, 1000)(form) or []


def _as_it_is(word: str, share: float, score: float) -> tuple[str, float, float]:
    return word, share, score


def _all_of_them(form: str, found: list[tuple[str, float, float]]) -> list[tuple[str, float, float]]:
    return found


def neighbours_of(neighbourhood: Neighbourhood) -> list[Neighbour]:
    """Return the neighbours, which all vote: siblings first, then objects of equal or similar size."""
    seen = neighbourhood.votes(lambda name, parents, size: (name, parents, size))
    return [Neighbour(name, parents, near, distance, size) for (name, parents, size), near, distance, _ in seen]
