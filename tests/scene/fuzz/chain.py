"""Verdicts on the whole chain, from reading to queries, and on ontologies, graphs and SSSOM files."""

import logging
import traceback
from collections.abc import Callable
from pathlib import Path

import usd2kg
from tests.scene.fuzz.sanity import is_line
from tests.scene.fuzz.worker import Outcome, Verdict
from usd2kg.errors import Usd2kgError
from usd2kg.graph import document_of, write_graph
from usd2kg.grounding import read_decisions
from usd2kg.ontology import load_home_tbox, load_tbox
from usd2kg.pipeline import build
from usd2kg.query.graph_file import load_graph
from usd2kg.render import render_scene
from usd2kg.validation import validate_graph

# Warnings of the package are not output: the command line decides where they go.
logging.getLogger("usd2kg").addHandler(logging.NullHandler())
_PACKAGE = str(Path(usd2kg.__file__).parent)


def check_chain(path: str) -> Verdict:
    """Return the verdict on a stage."""

    def run() -> None:
        result = build(path)
        target = Path(path).with_name("fuzz.ttl")
        write_graph(document_of(result.graph), target)
        graph = load_graph(str(target))
        assert len(graph.sparql("SELECT DISTINCT ?o { ?o u2k:primPath ?p }").rows) >= len(result.scene.objects)
        assert render_scene(path, size=(32, 32))

    return _judge(run)


def check_input(path: str) -> Verdict:
    """Return the verdict on an ontology, a graph (graph.*) or an SSSOM file (*.tsv)."""

    def run() -> None:
        if path.endswith(".tsv"):
            read_decisions(Path(path), load_home_tbox())
        elif Path(path).name.startswith("graph."):
            validate_graph(load_graph(path))
        else:
            load_tbox(path)

    return _judge(run)


def _judge(run: Callable[[], None]) -> Verdict:
    try:
        run()
        return Verdict(Outcome.READ)
    except Usd2kgError as error:
        message = str(error)
        if is_line(message):
            return Verdict(Outcome.REFUSED, detail=message[:500])
        return Verdict(Outcome.INSANE, "message of several lines", message[:500])
    except MemoryError:
        return Verdict(Outcome.MEMORY, detail=traceback.format_exc()[-1000:])
    except Exception as error:
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename.startswith(_PACKAGE)]
        place = f"{Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else "the fuzzer"
        return Verdict(Outcome.EXCEPTION, f"{type(error).__name__} in {place}", traceback.format_exc()[-1000:])
