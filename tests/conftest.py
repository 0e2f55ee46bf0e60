"""Fixtures that several tests share."""

import gc
import os
import shutil
import signal
import tempfile
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import pytest
from _pytest.doctest import DoctestModule
from hypothesis import is_hypothesis_test, settings

from tests.scene.usda import METRES
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.scene import Scene, read_scene
from usd2kg.table_cache import TABLE_CACHE_VARIABLE

_SETTINGS = "_hypothesis_internal_use_settings"
"""Attribute by which Hypothesis keeps the settings of a test."""
SHARED = Path(os.environ.get("USD2KG_SHARED", Path(__file__).parents[2] / "shared"))
"""Real scenes and ontologies with gold labels; they may not be redistributed with the project."""

settings.register_profile("usd2kg", deadline=None)
settings.load_profile("usd2kg")
"""Examples have no deadline by the clock: the machine may be busy."""

gc.set_threshold(50_000, 20, 100)
"""Tests make many small things that stay, which the collector would traverse often. `gc.freeze` does not help:
`paused_collection` counts what is frozen."""

signal.signal(signal.SIGINT, signal.default_int_handler)
"""A shell has what it runs in the background ignore interruptions, and so would all that the tests start."""


def pytest_configure(config: pytest.Config) -> None:
    """Share one empty cache of tables among all processes of a run.

    A test that changes a setting of the grounder must switch it off: the tables were computed without the change.
    """
    if not hasattr(config, "workerinput"):
        folder = tempfile.mkdtemp(prefix="usd2kg-tables-")
        config.add_cleanup(lambda: shutil.rmtree(folder))
        os.environ[TABLE_CACHE_VARIABLE] = folder


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Multiply the examples of property-based tests by the environment variable `USD2KG_EXAMPLES`."""
    factor = int(os.environ.get("USD2KG_EXAMPLES", "1"))
    tests = [getattr(item, "obj", None) for item in items if factor > 1]
    for test in {getattr(test, "__func__", test) for test in tests if is_hypothesis_test(test)}:
        of_test = getattr(test, _SETTINGS, settings())
        setattr(test, _SETTINGS, settings(of_test, max_examples=factor * of_test.max_examples))


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path: Path) -> Generator[None, list[pytest.Collector], list[pytest.Collector]]:
    """Look for examples only in test files that have some."""
    found = yield
    return [one for one in found if not isinstance(one, DoctestModule) or ">>>" in file_path.read_text("utf-8")]


@pytest.fixture
def write_stage(tmp_path: Path) -> Callable[..., Path]:
    """A function that writes a layer of text, `#usda 1.0` added, and returns its path."""

    def write(text: str, name: str = "scene.usda") -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#usda 1.0\n" + text, encoding="utf-8")
        return path

    return write


@pytest.fixture(scope="session")
def home_tbox() -> TBox:
    """The TBox that ships with the package."""
    return load_home_tbox()


def shared_file(relative: str) -> Path:
    """Return a file of the shared inputs; skip the test where they are absent."""
    path = SHARED / relative
    if not path.exists():
        pytest.skip(f"needs the shared input {relative}, which is not part of the project")
    return path


@pytest.fixture
def read(write_stage) -> Callable[..., Scene]:
    """A function that writes prims as a stage and reads it back."""

    def run(*prims: str, layer: str = METRES, name: str = "scene.usda", **options) -> Scene:
        return read_scene(write_stage(layer + "\n".join(prims), name), **options)

    return run


@pytest.fixture(scope="module")
def browser() -> Generator[Any]:
    """A headless Chromium; modules that use it have the marks `BROWSER_MARKS`."""
    from tests.browser import launch_browser  # noqa: PLC0415 - few tests need Playwright

    with launch_browser() as found:
        yield found
