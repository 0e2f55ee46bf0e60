"""Template of a gold file, with one row per object of a scene."""

import csv
import io

from usd2kg.grounding import Grounding
from usd2kg.ontology import TBox
from usd2kg.scene import Scene, SceneObject
from usd2kg.words import words_of

__all__ = ["gold_template"]

_COLUMNS = ("path", "class", "also", "words", "size_m", "asset", "documentation")


def gold_template(scene: Scene, suggestions: Grounding | None = None, tbox: TBox | None = None) -> str:
    """Return a CSV file with one row per object and empty columns `class` and `also`.

    Further columns help the annotator; `read_gold` ignores them. With `suggestions`, `class` is pre-filled for review.
    Do not evaluate a grounder on labels that started from its own answers.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    for obj in scene.objects:
        writer.writerow(_row(obj, _suggestion(obj, suggestions, tbox)))
    return text.getvalue()


def _suggestion(obj: SceneObject, suggestions: Grounding | None, tbox: TBox | None) -> str:
    if suggestions is None or tbox is None:
        return ""
    found = suggestions.by_path.get(obj.prim_path)
    return tbox.by_iri[found.class_iri].local_name if found and found.class_iri else ""


def _row(obj: SceneObject, suggestion: str) -> tuple[str, ...]:
    size = " x ".join(f"{side:.2f}" for side in obj.box.size) if obj.box else ""
    words = " ".join(words_of(obj.display_name or obj.name))
    return (obj.prim_path, suggestion, "", words, size, ", ".join(obj.asset), obj.documentation)
