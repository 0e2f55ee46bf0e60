"""The query page of the endpoint in a real browser."""

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import quote

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import BROWSER_MARKS
from tests.endpoint.conftest import HOSTILE, PATHS

pytestmark = BROWSER_MARKS


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(accept_downloads=True)
    found = context.new_page()
    problems: list[str] = []
    found.on("pageerror", lambda error: problems.append(str(error)))
    yield found
    context.close()
    assert problems == []


def test_the_first_example_runs_and_names_with_markup_stay_text(page: Page, port: int):
    page.goto(f"http://127.0.0.1:{port}/")
    expect(page.locator("td").filter(has_text=HOSTILE.split("\t")[0]).first).to_be_visible()
    assert page.title() == "store: query the graph"
    assert page.locator("td img").count() == 0
    assert page.get_by_role("status").inner_text().endswith(" s")


def test_a_query_in_the_address_waits_for_the_user(page: Page, port: int):
    page.goto(f"http://127.0.0.1:{port}/#{quote(PATHS)}")
    expect(page.get_by_role("status")).to_have_text("Check the query, then run it.")
    assert page.locator("td").count() == 0
    page.get_by_label("SPARQL query").focus()
    page.keyboard.press("Control+Enter")
    expect(page.get_by_role("status")).to_contain_text("4 rows in")
    with page.expect_download() as download:
        page.get_by_role("button", name="Save as CSV").click()
    lines = Path(download.value.path()).read_text().splitlines()
    assert (lines[0], "/Mug" in lines, len(lines)) == ("path", True, 5)


def test_an_iri_leads_to_what_the_graph_states_about_it(page: Page, port: int):
    page.goto(f"http://127.0.0.1:{port}/#{quote('SELECT ?o { ?o u2k:primPath ?p } ORDER BY ?o LIMIT 1')}")
    page.get_by_role("button", name="Run").click()
    page.locator("td a").first.click()
    expect(page.locator("th")).to_have_text(["property", "value"])


def test_one_scene_can_be_asked(page: Page, port: int):
    page.goto(f"http://127.0.0.1:{port}/#{quote(PATHS)}")
    page.get_by_label("Scene").select_option("https://my.lab/a")
    expect(page.get_by_role("status")).to_contain_text("2 rows in")


def test_errors_and_cut_answers_are_said(page: Page, port: int):
    page.goto(f"http://127.0.0.1:{port}/#{quote('SELECT * {')}")
    page.get_by_role("button", name="Run").click()
    expect(page.get_by_role("alert")).to_contain_text("line 1")
    page.get_by_label("SPARQL query").fill("SELECT * { ?s ?p ?o }")
    page.get_by_role("button", name="Run").click()
    expect(page.locator(".note")).to_have_text("The answer is cut: the server returns at most 50 rows.")
    page.get_by_label("SPARQL query").fill("ASK { ?s ?p ?o }")
    page.get_by_role("button", name="Run").click()
    expect(page.locator(".scroll")).to_have_text("yes (true)")
