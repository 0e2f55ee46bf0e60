"""Draw accuracy against dollars of cascades at five thresholds on the demo kitchen, with a scripted model.

Usage: python -m benchmarks.llm.cascade [FOLDER] [--model MODEL] [--picture FILE]

Writes the report of the matrix to FOLDER (default: build/cascade) and copies the plot to FILE. Without --model, a local
server answers by the gold labels with fixed errors (`GoldServer`), at the prices of Gemini 2.5 Flash: this shows the
form of the plot and what the lexical grounder leaves to a model, not the accuracy of a language model.
"""

import argparse
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.llm.gold_server import GoldServer
from usd2kg.demo import demo_gold, demo_scene
from usd2kg.evaluation import Matrix, read_gold, run_matrix
from usd2kg.evaluation.matrix import SceneSpec
from usd2kg.evaluation.report import write_report
from usd2kg.evaluation.report.study_tables import cascade_table
from usd2kg.grounding import NamingRegime
from usd2kg.grounding.llm.factory import LLMSettings
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import read_scene

THRESHOLDS = (0.5, 0.7, 0.8, 0.9, 0.95)
REGIMES = (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED, NamingRegime.OPAQUE)
PRICE = "0.30/2.50"


def main() -> None:
    """Run the matrix and print its table of cascades."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=Path("build/cascade"))
    parser.add_argument("--model", help="a language model; default: the scripted server")
    parser.add_argument("--picture", type=Path, help="file to copy the plot to")
    options = parser.parse_args()
    with TemporaryDirectory() as temporary:
        # The scripted model is another one in each run, so its completions must not stay in the user's cache.
        scripted = LLMSettings("", price=PRICE, completions=Path(temporary) / "completions.sqlite")
        settings = LLMSettings("") if options.model else scripted
        with scripted_model() if not options.model else given_model(options.model) as model:
            results = run_matrix(plan(model), options.folder, settings=settings)
    write_report(results, "Cascades", options.folder)
    table = cascade_table(results[0])
    assert table is not None
    for row in (table.columns, ["---"] * len(table.columns), *table.rows):
        print(f"| {' | '.join(row)} |")
    if options.picture:
        shutil.copy(options.folder / "plots/scene1_cascade.png", options.picture)


def plan(model: str) -> Matrix:
    """Return the matrix of the lexical grounder, strategy B, and cascades of both."""
    scene = SceneSpec("Demo kitchen", demo_scene(), demo_gold(), None, "made for this project", is_optional=False)
    return Matrix("Cascades", (scene,), ("lexical", f"llm-B:{model}"), REGIMES, 1, cascades=THRESHOLDS)


@contextmanager
def scripted_model() -> Iterator[str]:
    """Yield the model string of a running scripted server."""
    tbox = load_home_tbox()
    gold = read_gold(demo_gold(), tbox)
    server = GoldServer(read_scene(demo_scene(), paths=[label.prim_path for label in gold]), gold, tbox)
    try:
        yield f"openai:scripted@{server.url}/v1"
    finally:
        server.close()


@contextmanager
def given_model(model: str) -> Iterator[str]:
    """Yield a model string."""
    yield model


if __name__ == "__main__":
    main()
