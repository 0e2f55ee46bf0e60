"""The grounders of a matrix: offline ones, language models with one budget, and cascades of both."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from usd2kg.evaluation.matrix import Cell, Matrix
from usd2kg.grounding import CascadeGrounder, Grounder, make_grounder

if TYPE_CHECKING:
    from usd2kg.grounding.llm.batch_jobs.queue import Reporting
    from usd2kg.grounding.llm.factory import LLMSettings
    from usd2kg.grounding.llm.grounder import LLMGrounder

__all__ = ["MatrixGrounders", "open_grounders"]

_FIRST_TIER = "lexical"


@dataclass(frozen=True)
class MatrixGrounders:
    """The grounders of a matrix by name, with open connections."""

    offline: Mapping[str, Grounder]
    models: "Mapping[tuple[str, int], LLMGrounder]"
    """Name and repeat → language model; the repeats of a model share its client."""
    price: str
    """The user's token price, and whether it is for batch jobs; empty for list prices."""

    def grounder(self, cell: Cell) -> Grounder:
        """Return the grounder of a cell."""
        model = self.model(cell)
        if model is None:
            return self.offline[cell.grounder]
        return model if cell.cascade is None else CascadeGrounder(self.offline[_FIRST_TIER], model, cell.cascade)

    def model(self, cell: Cell) -> "LLMGrounder | None":
        """Return the language model of a cell; None if it has none."""
        return self.models.get((cell.grounder, cell.repeat))


@contextmanager
def open_grounders(
    matrix: Matrix,
    settings: "LLMSettings | None" = None,
    progress: Callable[[int, int], None] | None = None,
    reporting: "Reporting | None" = None,
) -> Iterator[MatrixGrounders]:
    """Open the grounders of a matrix.

    Args:
        matrix: the runs.
        settings: settings of the language models, except for model and strategy; None for the defaults.
        progress: called with the number of objects that a language model has completed and the total of a run.
        reporting: callbacks for the progress of batch jobs; None for log messages.

    Raises:
        GroundingError: an extra, a key or a price is missing, the cache cannot be opened, or language models are to be
            repeated at temperature 0.
    """
    names = dict.fromkeys(name for name in matrix.grounders if name not in matrix.language_models)
    if matrix.cascades:
        names.setdefault(_FIRST_TIER)
    offline = {name: make_grounder(name) for name in names}
    with ExitStack() as stack:
        models: dict[tuple[str, int], LLMGrounder] = {}
        if matrix.language_models:
            from usd2kg.grounding.llm.factory import LLMSettings, open_llm_grounders  # noqa: PLC0415 - slow to import

            settings = settings or LLMSettings("")
            opened = stack.enter_context(open_llm_grounders(matrix.language_models, settings, progress, reporting))
            for name, model in opened.items():
                models |= {(name, repeat): model.repeated(repeat) for repeat in range(1, matrix.repeats + 1)}
        price = (settings.price or "") if settings is not None else ""
        if settings is not None and settings.is_batched:
            price += " in batch jobs"
        yield MatrixGrounders(offline, models, price)
