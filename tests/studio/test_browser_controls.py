"""Controls of the page by keyboard: lists, tabs, popovers; and what is loaded when it starts."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.studio.conftest import KEY, Client, running_studio

pytestmark = BROWSER_MARKS


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
    # Nothing on the stage has a colour or a material.
    expect(colors).to_have_value("class")
    colors.focus()
    for expected in ("concept", "confidence"):
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


FOCUSED = """() => {
  const element = document.activeElement;
  const style = getComputedStyle(element);
  const labels = [...(element.labels ?? [])].map((label) => label.textContent).join(" ");
  return {
    tag: element.tagName,
    name: (element.getAttribute("aria-label") || labels || element.textContent || element.title || "").trim(),
    outline: style.outlineStyle === "none" ? 0 : parseFloat(style.outlineWidth),
  };
}"""


def test_tab_reaches_named_controls_with_a_visible_focus(page: Page) -> None:
    page.locator(".top-bar h1").click()
    seen = set()
    for _ in range(80):
        page.keyboard.press("Tab")
        found = page.evaluate(FOCUSED)
        if found["tag"] == "BODY":
            break
        assert found["name"], found
        assert found["outline"] >= 1, found
        seen.add(found["name"].split("\n")[0])
    controls = {"Filter objects", "Color by", "Export", "Prims", "Cutaway", "Relations", "Order", "Reviewer"}
    assert controls <= seen, controls - seen
    assert any(name.startswith("Confirm") for name in seen), seen


def test_with_reduced_motion_the_camera_does_not_fly(browser: Browser, shared: Client) -> None:
    context = browser.new_context(reduced_motion="reduce")
    page = context.new_page()
    page.goto(f"{shared.address}#token={KEY}")
    page.wait_for_selector("html[data-geometry=loaded]")
    position = "window.studioViewer.cameras.active.position.toArray()"
    # The keys act in the same task as the jump.
    moved = page.evaluate(
        f"""() => {{
          const before = {position};
          dispatchEvent(new KeyboardEvent("keydown", {{ key: "j", bubbles: true }}));
          const after = {position};
          return new Promise((resolve) => setTimeout(() => resolve([before, after, {position}]), 500));
        }}"""
    )
    assert moved[0] != moved[1] == moved[2]
    assert page.evaluate("document.getAnimations().length") == 0
    context.close()


def test_reviewers_who_disagree_are_shown_settled_and_counted(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        table = client.ask("api/scene").json()["objects"]["path"].index("/Kitchen/Table")
        for reviewer, action in (("Ann", "confirm"), ("Bob", "no-class")):
            # Neither has seen the other.
            body = {"objects": [table], "action": action, "reviewer": reviewer, "seen": 0}
            assert client.ask("api/decisions", body).status == 200
        page = open_page(browser, client, "Cleo")
        page.locator(".tree-row", has_text="Table").click()
        expect(page.locator(".conflict")).to_contain_text("Reviewers disagree")
        expect(page.locator(".history li")).to_have_count(2)
        page.keyboard.press("1")
        expect(page.locator(".conflict")).to_have_count(0)
        expect(page.locator(".history li").last).to_contain_text("by Cleo")
        page.locator("#tab-run").click()
        expect(page.locator(".drawer-body")).to_contain_text("Agreement of Ann and Bob")
        expect(page.locator(".drawer-body")).to_contain_text("0 of 1")
        close_page(page)


def ticks(page: Page) -> list[bool]:
    """Return whether each member of the group is ticked."""
    return [box.is_checked() for box in page.locator(".member input").all()]


def test_after_a_click_the_keys_act_on_the_review(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        page = open_page(browser, client)
        saved = page.locator(".status-bar .saving")

        def last_state(name: str) -> str:
            expect(saved).to_have_text("Saved")
            scene, states = client.ask("api/scene").json(), client.ask("api/states").json()["states"]
            state: str = states[scene["objects"]["path"].index(f"/Kitchen/{name}")]["state"]
            return state

        # A checkbox: Space ticks the member that the arrows have moved to.
        page.locator(".queue-row", has_text="cup").first.click()
        page.locator(".member input").first.click()
        assert ticks(page) == [False, True]
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Space")
        assert ticks(page) == [False, False]
        expect(page.locator(".member.focused")).to_have_attribute("title", "/Kitchen/Cup_2")
        page.keyboard.press("Space")

        # A row of the tree: Enter confirms, until arrows move on in the tree.
        page.locator(".tree-row", has_text="Table").click()
        page.keyboard.press("Enter")
        expect(page.locator(".status-bar")).to_contain_text("1 of 5 decided")
        assert last_state("Table") == "confirmed"
        page.keyboard.press("ArrowDown")
        page.keyboard.press("Enter")
        expect(page.locator(".tree-row[aria-selected=true]")).to_contain_text("<img")
        expect(page.locator(".status-bar")).to_contain_text("1 of 5 decided")

        # A button: Enter confirms the next group.
        page.locator(".queue-row", has_text="cup").first.click()
        page.locator(".actions button", has_text="No class fits").click()
        page.keyboard.press("Enter")
        expect(page.locator(".status-bar")).to_contain_text("4 of 5 decided")
        states = [last_state(name) for name in ("Floor", "Table", "Cup_1", "Cup_2", "Zxqv")]
        assert sorted(states) == ["confirmed", "confirmed", "no-class", "no-class", "suggested"]
        # With the keyboard alone, a button keeps its Enter.
        page.locator(".actions button", has_text="Skip").focus()
        page.keyboard.press("Enter")
        expect(page.locator(".status-bar")).to_contain_text("4 of 5 decided")
        close_page(page)


def test_what_the_page_knows_follows_the_server(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        page, other = open_page(browser, client, "Ann"), open_page(browser, client, "Ann")
        undo = other.get_by_role("button", name="Undo")
        expect(undo).to_be_disabled()
        page.locator(".tree-row", has_text="Zxqv").click()
        summary = page.locator("summary", has_text="Statements")
        # The first graph is written.
        summary.click(timeout=20_000)
        statements = page.locator(".object-panel pre")
        expect(statements).not_to_contain_text("Cupboard")
        page.keyboard.press("/")
        page.keyboard.type("cupboard")
        page.keyboard.press("Enter")
        # The same reviewer can undo in both tabs.
        expect(undo).to_be_enabled()
        page.locator(".tree-row", has_text="Zxqv").click()
        expect(statements).to_contain_text("Cupboard", timeout=20_000)
        close_page(page)
        close_page(other)


def test_each_tab_keeps_its_reviewer(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        page = open_page(browser, client, "Bob")
        other = page.context.new_page()
        other.goto(f"{client.address}#token={KEY}")
        # The name of the browser is that with which a tab begins.
        expect(other.get_by_label("Reviewer")).to_have_value("Bob")
        other.get_by_label("Reviewer").fill("Cleo")
        other.keyboard.press("Enter")
        page.reload()
        expect(page.get_by_label("Reviewer")).to_have_value("Bob")
        close_page(page)
