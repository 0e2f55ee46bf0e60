"""The options that colour the objects of a picture by a property."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.cli.options.common import OntologyFile
from usd2kg.cli.options.review import DecisionsFile
from usd2kg.errors import OutputError

if TYPE_CHECKING:
    from usd2kg.diagrams import ColorMode

__all__ = ["ColorOptions"]


@dataclass(frozen=True)
class ColorOptions(OptionBundle):
    """The property shown by colours, and the source of classes."""

    color_by: Annotated[
        str | None,
        Option(
            "--color-by",
            help="Property shown by colours, with a legend: material, class, concept, confidence, room, support "
            "(what an object is on or in), or answer, which needs --ask; default: answer with --ask, else material.",
        ),
    ] = None
    ask: Annotated[
        str | None,
        Option("--ask", metavar="QUESTION", help="Highlight the answer to a question in plain English."),
    ] = None
    ontology: OntologyFile = None
    decisions: DecisionsFile = None

    def mode(self) -> "ColorMode":
        """Return the property shown by colours.

        Raises:
            OutputError: the mode is unknown, or does not fit the other options.
        """
        from usd2kg.diagrams import ColorMode  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        modes = [mode.value for mode in ColorMode]
        if self.color_by is None:
            mode = ColorMode.MATERIAL if self.ask is None else ColorMode.ANSWER
            if mode is ColorMode.MATERIAL and (self.ontology or self.decisions):
                raise OutputError(
                    "--ontology and --decisions do not change the colours of materials; choose another --color-by than "
                    "material"
                )
        elif self.color_by in modes:
            mode = ColorMode(self.color_by)
        else:
            raise OutputError(f"--color-by {self.color_by}: expected {', '.join(modes[:-1])} or {modes[-1]}")
        if (mode is ColorMode.ANSWER) != (self.ask is not None):
            problem = "needs a question" if self.ask is None else "does not show the answer"
            raise OutputError(f"--color-by {mode} {problem}; use --ask 'what is on the table?' with --color-by answer")
        return mode
