"""Controls of the page by keyboard: lists, tabs, popovers; and what is loaded when it starts."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.studio.conftest import KEY, Client, needs_page, running_studio
from tests.studio.test_browser import CHROMIUM, SOFTWARE_GL, close_page, open_page

pytestmark = [
    pytest.mark.studio,
    pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium, in CHROMIUM or on the path"),
    needs_page,
]


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE_GL)
        yield found
        found.close()


@pytest.fixture(scope="module")
def shared(stage: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    with running_studio(stage, tmp_path_factory.mktemp("controls") / "project") as client:
        yield client


@pytest.fixture(scope="module")
def page(browser: Browser, shared: Client) -> Iterator[Page]:
    found = open_page(browser, shared)
    yield found
    close_page(found)


def test_arrows_go_through_a_list_and_a_letter_chooses(page: Page) -> None:
    colors = page.get_by_label("Color by")
    colors.focus()
    for expected in ("class", "concept"):
        page.keyboard.press("ArrowDown")
        expect(colors).to_have_value(expected)
        expect(colors).to_be_focused()
    page.keyboard.press("r")
    expect(colors).to_have_value("state")
    # The keys of the review work again.
    expect(colors).not_to_be_focused()
    colors.select_option("material")


def test_a_popover_closes_with_escape_a_click_elsewhere_and_tab(page: Page) -> None:
    for name in ("Export", "Relations"):
        # Enter opens it, and confirms no group.
        summary, panel = page.locator("summary", has_text=name), page.locator("details[open].popover")
        summary.focus()
        page.keyboard.press("Enter")
        expect(panel).to_have_count(1)
        expect(page.locator(".status-bar")).to_contain_text("0 of 5 decided")
        page.keyboard.press("Tab")
        page.keyboard.press("Escape")
        expect(panel).to_have_count(0)
        expect(summary).to_be_focused()
        summary.click()
        expect(panel).to_have_count(1)
        page.locator(".top-bar h1").click()
        expect(panel).to_have_count(0)
        summary.click()
        page.keyboard.press("Shift+Tab")
        expect(panel).to_have_count(0)


def test_a_choice_in_the_popover_of_relations_leaves_it_open(page: Page) -> None:
    page.locator("summary", has_text="Relations").click()
    page.locator("details[open] .facet .name").first.click()
    page.locator("details[open] .facet .name").first.click()
    expect(page.locator("details[open].popover")).to_have_count(1)
    page.keyboard.press("Escape")


def test_tabs_by_keyboard(page: Page) -> None:
    page.locator("#tab-prims").focus()
    for key, expected in (
        ("ArrowRight", "classes"),
        ("End", "facets"),
        ("ArrowRight", "prims"),
        ("ArrowLeft", "facets"),
    ):
        page.keyboard.press(key)
        expect(page.locator(f"#tab-{expected}")).to_be_focused()
        expect(page.get_by_role("tabpanel", name=expected.capitalize())).to_be_visible()
    page.keyboard.press("Home")
    expect(page.get_by_role("tabpanel", name="Prims")).to_be_visible()


def test_the_page_asks_once_for_what_it_shows(browser: Browser, shared: Client) -> None:
    page = browser.new_page()
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url.removeprefix(shared.address)))
    page.goto(f"{shared.address}#token={KEY}")
    expect(page.locator(".queue-row").first).to_be_visible()
    page.wait_for_selector("html[data-geometry=loaded]")
    data = [path for path in asked if path.startswith("api/")]
    assert sorted(data[:2]) == ["api/scene", "api/states"]
    assert len(set(data)) == len(data)
    # The code of the page is kept, its data are not.
    asked.clear()
    page.reload()
    page.wait_for_selector("html[data-geometry=loaded]")
    timings = page.evaluate(
        "performance.getEntriesByType('resource').map(({ name, transferSize }) => [name, transferSize])"
    )
    sizes = {name.removeprefix(shared.address): size for name, size in timings}
    assert {size for name, size in sizes.items() if name.startswith("assets/")} == {0}
    assert sizes["api/scene"] > 0
    page.close()
