"""Labels back onto the stage: from the classes of a run to a layer, and what is wrong with labels that stand there."""

from usd2kg.labelling.classes import NAMINGS, label_maker
from usd2kg.labelling.lint import LabelLint, lint_stage
from usd2kg.labelling.runs import Answer, Run, read_run
from usd2kg.labelling.write import label_stage

__all__ = ["NAMINGS", "Answer", "LabelLint", "Run", "label_maker", "label_stage", "lint_stage", "read_run"]
