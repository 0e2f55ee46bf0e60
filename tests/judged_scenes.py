"""Stages whose relations were judged."""

from pathlib import Path

import pytest

from benchmarks.relations.judged import SCENES


def judged_stage(name: str) -> Path:
    """Return the stage of a judged scene; skip the test where it is missing."""
    source = SCENES[name]
    if not source.stage.exists():
        pytest.skip(f"needs {source.stage}, which is not part of the project: {source.remedy}")
    return source.stage
