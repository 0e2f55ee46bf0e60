"""The page in windows of several sizes: no control is cut off or covered."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, ViewportSize, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.studio.conftest import Client, running_studio

pytestmark = BROWSER_MARKS

SIZES = [(1920, 1080), (1400, 860), (1100, 700), (1000, 700), (800, 900), (600, 900)]
LONG_REVIEWER = "https://orcid.org/0000-0002-1825-0097"

FIND_CLIPPED = """() => {
  // Lists scroll; what is below their edge is not cut off.
  const scrolling = ".members, .virtual, .object-panel, .facets, .ask, .result, .tabs, .compare, .legend";
  const problems = [];
  const describe = (element) => {
    const name = element.getAttribute("aria-label") || element.textContent || element.className || element.type;
    return `${element.tagName.toLowerCase()} “${name.trim().slice(0, 40)}”`;
  };
  const isShown = (element) => element.checkVisibility({ contentVisibilityAuto: true });
  for (const element of document.querySelectorAll("button, select, input, h1, h2, .status-bar > *")) {
    const box = element.getBoundingClientRect();
    if (box.width === 0 || !isShown(element) || element.closest(scrolling) !== null) continue;
    const panel = element.closest("header.top-bar, nav, main, .queue, .group-card, section.drawer, footer");
    const edges = panel.getBoundingClientRect();
    const isOutside = box.left < edges.left - 1 || box.right > edges.right + 1 ||
      box.top < edges.top - 1 || box.bottom > edges.bottom + 1;
    if (isOutside) problems.push(`${describe(element)} reaches out of ${panel.className || panel.tagName}`);
    // A folder and names end with an ellipsis.
    if (element.matches("button, .status-bar > :not(.folder)") && element.scrollWidth > element.clientWidth + 1)
      problems.push(`${describe(element)} is cut off`);
    if (element.matches("select")) {
      const copy = element.cloneNode(true);
      copy.style.cssText = "position: absolute; width: max-content; visibility: hidden";
      document.body.append(copy);
      if (copy.offsetWidth > element.offsetWidth + 1)
        problems.push(`${describe(element)} needs ${copy.offsetWidth} pixels and has ${element.offsetWidth}`);
      copy.remove();
    }
  }
  const controls = [...document.querySelectorAll("button, select, input")].filter(
    (element) => element.closest(scrolling) === null && isShown(element));
  for (const element of controls) {
    element.scrollIntoView({ block: "nearest" });
    const box = element.getBoundingClientRect();
    const top = document.elementFromPoint((box.left + box.right) / 2, (box.top + box.bottom) / 2);
    const isReached = top !== null && (element.contains(top) || top.contains(element) || top.closest(".notices"));
    if (!isReached && box.top < innerHeight) problems.push(`${describe(element)} is covered by ${top?.className}`);
  }
  scrollTo(0, 0);
  if (document.documentElement.scrollWidth > innerWidth) problems.push("the page is wider than the window");
  return problems;
}"""


@pytest.fixture(scope="module")
def shared(stage: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    with running_studio(stage, tmp_path_factory.mktemp("layout") / "project") as client:
        yield client


@pytest.fixture(scope="module")
def page(browser: Browser, shared: Client) -> Iterator[Page]:
    found = open_page(browser, shared, LONG_REVIEWER)
    # The legend is in the picture, as the switches are.
    found.get_by_label("Color by").select_option("class")
    yield found
    close_page(found)


@pytest.mark.parametrize(("width", "height"), SIZES)
@pytest.mark.parametrize("is_drawer_open", [True, False])
def test_nothing_is_cut_off(page: Page, width: int, height: int, is_drawer_open: bool) -> None:
    page.set_viewport_size(ViewportSize(width=width, height=height))
    drawer = page.get_by_role("button", name=f"{'Close' if is_drawer_open else 'Open'} the tools")
    if (page.locator(".drawer-body").is_visible()) != is_drawer_open:
        page.keyboard.press("d")
    expect(drawer).to_be_visible()
    page.wait_for_timeout(200)
    problems = page.evaluate(FIND_CLIPPED)
    assert problems == [], json.dumps(problems, indent=1, ensure_ascii=False)


@pytest.mark.parametrize(("width", "height"), [(1024, 700), (1280, 720), (1366, 768), (1920, 1080), (420, 800)])
def test_a_row_of_members_is_shown_with_its_names(page: Page, width: int, height: int) -> None:
    page.set_viewport_size(ViewportSize(width=width, height=height))
    if not page.locator(".drawer-body").is_visible():
        page.keyboard.press("d")
    page.locator(".queue-row", has_text="cup").first.click()
    page.wait_for_timeout(200)
    members, name, actions = (
        page.locator(found).first.bounding_box() for found in (".members", ".member label", ".actions")
    )
    assert members is not None
    assert name is not None
    assert actions is not None
    assert name["height"] >= 16
    assert members["y"] <= name["y"]
    assert name["y"] + name["height"] <= members["y"] + members["height"] <= actions["y"]


def test_the_fields_of_a_proposal_are_in_its_dialog(page: Page) -> None:
    page.set_viewport_size(ViewportSize(width=420, height=800))
    page.keyboard.press("m")
    dialog = page.locator("dialog").bounding_box()
    assert dialog is not None
    for field in page.locator("dialog input").all():
        box = field.bounding_box()
        assert box is not None
        assert dialog["x"] <= box["x"]
        assert box["x"] + box["width"] <= dialog["x"] + dialog["width"]
    page.keyboard.press("Escape")
