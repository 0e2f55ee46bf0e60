"""Matplotlib canvases with fixed settings, as deterministic SVG, PNG and PDF. Matplotlib loads on first use."""

import io
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.report.blocks import Figure, printable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas

__all__ = ["add_legend", "check_matplotlib", "label_text", "method_color", "method_marker", "open_canvas", "to_figure"]

_COLORS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#7F7F7F", "#000000")
"""Palette of Okabe and Ito, distinguishable with colour vision deficiencies."""
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
_LONGEST_LABEL = 40
_LETTERS_PER_INCH = 12
"""Width of a letter at the font size below."""
_SYMBOL_WIDTH = 6
"""Width of a legend symbol with its padding, in letters."""
_SETTINGS: Mapping[Any, Any] = {
    "svg.hashsalt": "usd2kg",
    # Keep text as text: sharp, searchable, and rendered with the viewer's fonts if this font lacks a script.
    "svg.fonttype": "none",
    # Fonts as TrueType: publishers reject the default, Type 3.
    "pdf.fonttype": 42,
    "savefig.bbox": "tight",
    "savefig.dpi": 200,
    # A dollar sign in a name must not start a formula.
    "text.parse_math": False,
    "font.family": ["DejaVu Sans", "sans-serif"],
    "font.size": 11,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e3e3e3",
    "legend.frameon": False,
    "axes.titlesize": 11,
    "axes.titlelocation": "left",
}


def check_matplotlib() -> None:
    """Raise EvaluationError with the install command if matplotlib is not installed."""
    try:
        import matplotlib.figure  # noqa: F401, PLC0415
    except ImportError as error:
        raise EvaluationError(
            f"plots need matplotlib, which cannot be imported ({error}); pip install 'usd2kg[plots]'"
        ) from error


def method_color(index: int) -> str:
    """Return the colour of the method with this index."""
    return _COLORS[index % len(_COLORS)]


def method_marker(index: int) -> str:
    """Return the marker of the method or scene with this index."""
    return _MARKERS[index % len(_MARKERS)]


@contextmanager
def open_canvas(
    width: float, height: float, panels: tuple[int, int] = (1, 1)
) -> Iterator[tuple["Canvas", list["Axes"]]]:
    """Yield a canvas of a size in inches and its panels, independent of the user's matplotlib settings."""
    check_matplotlib()
    import matplotlib as mpl  # noqa: PLC0415
    from matplotlib.figure import Figure as Canvas  # noqa: PLC0415

    with mpl.rc_context(), warnings.catch_warnings():
        mpl.rcdefaults()
        mpl.rcParams.update(_SETTINGS)
        # The viewer's fonts render scripts that the font lacks; matplotlib just cannot measure them.
        warnings.filterwarnings("ignore", message="Glyph .* missing from", category=UserWarning)
        canvas = Canvas(figsize=(width, height), layout="constrained")
        yield canvas, list(canvas.subplots(*panels, squeeze=False).flat)


def to_figure(canvas: "Canvas", name: str, caption: str) -> Figure:
    """Return the canvas in all formats, without a date, cropped to the drawn content including legends."""
    svg = _save(canvas, "svg", ("Date", "Creator", "Format", "Type")).decode("utf-8")
    return Figure(
        name,
        printable(caption),
        svg[svg.index("<svg") :].strip(),
        _save(canvas, "png", ("Software",)),
        _save(canvas, "pdf", ("CreationDate", "Creator", "Producer")),
    )


def _save(canvas: "Canvas", file_format: str, omitted: Sequence[str]) -> bytes:
    """Return the canvas as a file without some metadata."""
    file = io.BytesIO()
    canvas.savefig(file, format=file_format, metadata=dict.fromkeys(omitted))
    return file.getvalue()


def label_text(text: str, longest: int = _LONGEST_LABEL) -> str:
    """Return text as a label, truncated to `longest` characters."""
    # Matplotlib hides labels with a leading underscore from the legend.
    text = " " + printable(text) if text.startswith("_") else printable(text)
    return text if len(text) <= longest else text[: longest - 1] + "…"


def add_legend(canvas: "Canvas", *panels: "Axes") -> None:
    """Add one legend for several panels above them, with as many columns as fit the width."""
    entries = [zip(*axes.get_legend_handles_labels(), strict=True) for axes in panels]
    by_label = {label: handle for panel in entries for handle, label in panel}
    fitting = int(canvas.get_figwidth() * _LETTERS_PER_INCH / (max(map(len, by_label), default=0) + _SYMBOL_WIDTH))
    canvas.legend([*by_label.values()], [*by_label], loc="outside upper left", ncols=max(1, min(fitting, 4)))
