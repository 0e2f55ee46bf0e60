"""A headless Chromium for the tests of pages, and an open studio in it."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.studio.conftest import KEY, Client, needs_page

__all__ = ["BROWSER_MARKS", "close_page", "launch_browser", "open_page"]

_CHROMIUM = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
_SOFTWARE_GL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--no-sandbox"]
BROWSER_MARKS = [
    pytest.mark.studio,
    pytest.mark.skipif(_CHROMIUM is None, reason="needs Chromium, in CHROMIUM or on the path"),
    needs_page,
]
"""Marks of a module whose tests use the fixture `browser`."""


@contextmanager
def launch_browser() -> Iterator[Browser]:
    """Launch Chromium, which draws without a GPU."""
    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=_CHROMIUM, args=_SOFTWARE_GL)
        yield found
        found.close()


def open_page(browser: Browser, client: Client, reviewer: str = "") -> Page:
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    page = context.new_page()
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.on("console", lambda message: problems.append(message.text) if message.type == "error" else None)
    page.goto(f"{client.address}#token={KEY}")
    expect(page.locator(".queue-row").first).to_be_visible()
    page.wait_for_selector("html[data-geometry=loaded]")
    if reviewer:
        page.get_by_label("Reviewer").fill(reviewer)
        page.keyboard.press("Enter")
    page.problems = problems  # type: ignore[attr-defined]
    return page


def close_page(page: Page) -> None:
    assert page.problems == []  # type: ignore[attr-defined]
    page.context.close()
