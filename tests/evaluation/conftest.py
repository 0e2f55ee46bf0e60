"""Fixtures of reports."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pytest

from usd2kg.evaluation.report import canvas

if TYPE_CHECKING:
    from usd2kg.evaluation.report.canvas import Canvas


@pytest.fixture
def svg_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave PNG and PDF empty, which take most of the time of a report."""
    omit_png_and_pdf(monkeypatch)


def omit_png_and_pdf(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave PNG and PDF empty until the patches are undone."""
    save = canvas._save

    def save_svg(drawn: "Canvas", file_format: str, omitted: Sequence[str]) -> bytes:
        return save(drawn, file_format, omitted) if file_format == "svg" else b""

    monkeypatch.setattr(canvas, "_save", save_svg)
