"""Write docs/questions.md: the predefined questions, each with its answer for the demo kitchen.

Usage: python -m tools.write_questions_docs [--check]
"""

import tempfile
from pathlib import Path

import usd2kg
from tools.generated_docs import DOCS, write_or_check
from usd2kg.cli.query import answer_text
from usd2kg.demo import demo_scene
from usd2kg.query import FUNCTIONS, GraphStore
from usd2kg.query.questions import Question, list_questions

_ROWS = 5
_EXAMPLES = {
    "above": {"thing": "barTable"},
    "alike": {"thing": "wineGlass_01"},
    "below": {"thing": "cookerHood", "distance": "70 cm"},
    "close-to": {"thing": "toaster", "distance": "12 cm"},
    "connects": {"thing": "door_int_LOW"},
    "contents": {"thing": "refrigerator"},
    "graspable": {"thing": "barTable"},
    "heavy-near": {"thing": "sink_steel", "distance": "50 cm"},
    "hold-liquid": {"thing": "barTable"},
    "joints": {"thing": "refrigerator"},
    "moves-along": {"thing": "saucer_1"},
    "nearest": {"thing": "toaster", "class": "cup"},
    "reach": {"position": "-1.5 0.4 1.1", "radius": "25 cm"},
    "route": {"thing": "refrigerator", "other": "KitchenDining"},
    "same-surface": {"thing": "fruitBowl"},
    "support-chain": {"thing": "apple_1"},
    "to-open": {"thing": "refrigerator"},
    "unsure": {"confidence": "0.8"},
    "ways-into": {"thing": "KitchenDining"},
}
_INTRODUCTION = f"""\
# Questions

Written by `tools/write_questions_docs.py`. The answers are those for the demo kitchen, cut after {_ROWS} rows.

```console
$ usd2kg query --list
$ usd2kg query kitchen.ttl --question support-chain --with thing=apple_1
```

An object is named by label, class or prim path. If a name matches several objects, the question is asked for each, and
the last column names the object of a row. Numbers may have units (`50 cm`, `300 g`, `80 %`). `--json` prints JSON. In
Python: `load_graph("kitchen.ttl").answer("support-chain", {{"thing": "apple_1"}})`. All questions work with both
profiles, `soma` and `plain`.

Each question is a SPARQL file in `src/usd2kg/query/questions`. Units are metres, kilograms and radians. Objects are
measured by their axis-aligned boxes, which overestimate rotated and hollow objects.
"""
_FUNCTIONS_HEAD = """\
## Functions

These functions compute what SPARQL cannot, from the boxes of objects; they also work with `--sparql`. `u2kf:` is
`https://w3id.org/usd2kg/function#`. For an object without a box the result is unbound.

| function | result |
| --- | --- |
"""


def build_page() -> str:
    """Return the page."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "kitchen.ttl"
        usd2kg.write_graph(usd2kg.build(demo_scene()).graph, path)
        store = usd2kg.load_graph(path)
    sections = [_INTRODUCTION, *(_section(question, store) for question in list_questions())]
    rows = "".join(f"| `u2kf:{name}` | {meaning} |\n" for name, meaning in FUNCTIONS.items())
    return "\n".join([*sections, _FUNCTIONS_HEAD + rows])


def _section(question: Question, store: GraphStore) -> str:
    given = _EXAMPLES.get(question.id, {})
    options = "".join(
        f' --with {name}="{value}"' if " " in value else f" --with {name}={value}" for name, value in given.items()
    )
    table = answer_text(store.answer(question.id, given), _ROWS)
    note = f"{question.note}\n\n" if question.note else ""
    command = f"$ usd2kg query kitchen.ttl --question {question.id}{options}"
    return f"## {question.id}\n\n{question.text}\n\n{note}```console\n{command}\n{table}```\n"


if __name__ == "__main__":
    write_or_check(DOCS / "questions.md", build_page(), "tools.write_questions_docs")
