"""Settings of the evaluation, one class per section of `knowledge/settings/evaluation.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "BOOTSTRAP",
    "CONFIDENCE",
    "PLATT_FIT",
    "REPORT",
    "BootstrapSettings",
    "CalibrationSettings",
    "PlattFitSettings",
    "ReportSettings",
]


class CalibrationSettings(NamedTuple):
    """Reliability diagrams and calibration error."""

    bins: int


class BootstrapSettings(NamedTuple):
    """Bootstrap intervals."""

    resamples: int
    seed: int


class PlattFitSettings(NamedTuple):
    """Newton's method for Platt scaling."""

    min_answers: int
    max_iterations: int
    tolerance: float
    ridge: float


class ReportSettings(NamedTuple):
    """Limits on the length of tables and plots in reports."""

    max_names: int
    max_confusions: int
    max_missed: int
    max_heat_map_classes: int
    max_unfolded_rows: int
    latex_page_rows: int
    latex_wide_cell: int


CONFIDENCE = read_settings("evaluation", "confidence", CalibrationSettings)
BOOTSTRAP = read_settings("evaluation", "bootstrap", BootstrapSettings)
PLATT_FIT = read_settings("evaluation", "platt_fit", PlattFitSettings)
REPORT = read_settings("evaluation", "report", ReportSettings)
