"""Draw the plots of docs/evaluation.md from a run on the demo kitchen, as `usd2kg eval reproduce` draws them.

Usage: python -m tools.draw_evaluation_plots

Needs the extras embedding and plots.
"""

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from tools.data_files import ROOT
from usd2kg.demo import demo_gold, demo_scene
from usd2kg.evaluation import read_matrix, run_matrix
from usd2kg.evaluation.report import write_report

__all__ = ["draw_plots"]

IMAGES = ROOT / "docs/images"
PLOTS = {"scene1_accuracy.png": "evaluation_accuracy.png", "scene1_reliability.png": "evaluation_confidence.png"}
"""File of the report → picture of the documentation."""
_MATRIX = """\
title = "Demo kitchen"
grounders = ["lexical", "embedding"]
regimes = ["semantic", "abbreviated", "opaque", "opaque-anonymous"]

[[scene]]
name = "Demo kitchen"
path = "{scene}"
gold = "{gold}"
"""


def draw_plots(folder: Path) -> list[Path]:
    """Run the matrix and return the plots that were written to a folder."""
    with TemporaryDirectory() as temporary:
        matrix, results = Path(temporary) / "matrix.toml", Path(temporary) / "results"
        matrix.write_text(_MATRIX.format(scene=demo_scene(), gold=demo_gold()), "utf-8")
        plan = read_matrix(matrix)
        write_report(run_matrix(plan, results), plan.title, results)
        return [Path(shutil.copy(results / "plots" / plot, folder / name)) for plot, name in PLOTS.items()]


if __name__ == "__main__":
    for path in draw_plots(IMAGES):
        sys.stdout.write(f"{path.relative_to(ROOT)}\n")
