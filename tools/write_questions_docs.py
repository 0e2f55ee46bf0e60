"""Write docs/questions.md: the questions that a graph answers, each with its answer in the demo kitchen.

Usage: python tools/write_questions_docs.py [--check]
"""

import sys
import tempfile
from pathlib import Path

import usd2kg
from usd2kg.cli.query import answer_text
from usd2kg.demo import demo_scene
from usd2kg.query import FUNCTIONS, GraphStore
from usd2kg.query.questions import Question, list_questions

OUTPUT = Path(__file__).parent.parent / "docs/questions.md"
_ROWS = 5
_EXAMPLES = {
    "above": {"thing": "barTable"},
    "alike": {"thing": "wineGlass_01"},
    "below": {"thing": "cookerHood", "distance": "70 cm"},
    "close-to": {"thing": "toaster", "distance": "12 cm"},
    "contents": {"thing": "refrigerator"},
    "graspable": {"thing": "barTable"},
    "heavy-near": {"thing": "sink_steel", "distance": "50 cm"},
    "hold-liquid": {"thing": "barTable"},
    "joints": {"thing": "refrigerator"},
    "moves-along": {"thing": "saucer_1"},
    "nearest": {"thing": "toaster", "class": "cup"},
    "reach": {"position": "-1.5 0.4 1.1", "radius": "25 cm"},
    "same-surface": {"thing": "fruitBowl"},
    "support-chain": {"thing": "apple_1"},
    "to-open": {"thing": "refrigerator"},
    "unsure": {"confidence": "0.8"},
}
_INTRODUCTION = f"""\
# Questions

Written by `tools/write_questions_docs.py`, with the answers that the graph of the demo kitchen gives, cut after {_ROWS}
rows.

```console
$ usd2kg query --list
$ usd2kg query kitchen.ttl --question support-chain --with thing=apple_1
```

A thing is named by label, class or prim path; where the name means several, all are asked for, and a last column says
which one a row is about. Numbers may have units (`50 cm`, `300 g`, `80 %`). `--json` gives the rows as JSON. In Python:
`load_graph("kitchen.ttl").answer("support-chain", {{"thing": "apple_1"}})`. All work in the `soma` and the `plain`
profile.

Each question is a file of SPARQL in `src/usd2kg/graph/questions`. Lengths are metres, masses kilograms, angles radians;
things are measured by their boxes along the world's axes, so that what is turned or hollow is taken for larger than it
is.
"""
_FUNCTIONS_HEAD = """\
## Functions

What SPARQL cannot compute from positions, these functions do, in `--sparql` too: `u2kf:` is
`https://w3id.org/usd2kg/function#`. An object without a box leaves them unbound.

| function | what comes back |
| --- | --- |
"""


def page() -> str:
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


def main() -> None:
    """Write the page, or check that it is what would be written."""
    if "--check" in sys.argv:
        if OUTPUT.read_text("utf-8") != page():
            raise SystemExit(f"{OUTPUT} is not what the graph answers; run python tools/write_questions_docs.py")
        return
    OUTPUT.write_text(page(), "utf-8")


if __name__ == "__main__":
    main()
