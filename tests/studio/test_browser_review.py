"""Decisions beyond a class of an object, in a real browser and by keyboard alone."""

import re
from collections import Counter
from pathlib import Path

from playwright.sync_api import Browser, Page, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.studio.conftest import HOSTILE, running_studio
from tests.studio.test_disagreement import write_second
from usd2kg.demo import demo_scene
from usd2kg.ontology import load_tbox

pytestmark = BROWSER_MARKS
CONFIDENCE = re.compile(r"\d\.\d\d")


def test_a_concept_is_decided_in_one_stroke(browser: Browser, tmp_path: Path):
    with running_studio(demo_scene(), tmp_path / "project") as client:
        page = open_page(browser, client)
        page.keyboard.press("Control+k")
        page.keyboard.type("cup")
        page.keyboard.press("Escape")
        page.keyboard.press("j")
        page.keyboard.press("k")
        page.keyboard.press("e")
        dialog = page.get_by_role("dialog")
        expect(dialog).to_be_visible()
        boxes = dialog.get_by_role("checkbox")
        members = boxes.count()
        assert members > 1
        page.keyboard.type("bowl")
        expect(dialog.get_by_role("option").first).to_contain_text("bowl")
        # One exception stays open.
        while not boxes.last.evaluate("box => box === document.activeElement"):
            page.keyboard.press("Tab")
        page.keyboard.press("Space")
        expect(dialog).to_contain_text(f"{members - 1} of {members} open ticked")
        page.keyboard.press("Enter")
        expect(dialog).to_be_hidden()
        expect(page.locator(".notice").last).to_contain_text(f"set {members - 1} objects")
        expect(page.locator(".status-bar .saving")).to_have_text("Saved")
        changed = [s for s in client.ask("api/states").json()["states"] if s["state"] != "suggested"]
        assert {state["state"] for state in changed} == {"corrected"}
        assert len(changed) == members - 1
        page.keyboard.press("Control+z")
        expect(page.get_by_role("button", name="Undo")).to_be_disabled()
        close_page(page)


def test_a_missing_class_is_proposed(browser: Browser, stage: Path, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(stage, folder) as client:
        page = open_page(browser, client)
        for _ in range(10):
            if "cup" in page.locator(".group-card h2").inner_text().lower():
                break
            page.keyboard.press("j")
        page.keyboard.press("m")
        dialog = page.get_by_role("dialog")
        expect(dialog.get_by_label("Label of the class")).to_have_value("cup")
        expect(dialog.get_by_label("Label of the class")).to_be_focused()
        page.keyboard.type(HOSTILE)
        page.keyboard.press("Tab")
        page.keyboard.type("found in many kitchens")
        page.keyboard.press("Enter")
        expect(dialog).to_be_hidden()
        expect(page.locator(".notice").last).to_contain_text(f"Proposed “{HOSTILE}” below cup for 2 objects")
        expect(page.locator(".status-bar .saving")).to_have_text("Saved")
        page.locator("#tab-run").click()
        expect(page.get_by_text(f"Proposed class “{HOSTILE}”")).to_be_visible()
        assert page.title() == "kitchen.usda · usd2kg studio"
        assert page.locator("img[src=x]").count() == 0
        close_page(page)
    (proposed,) = [cls for cls in load_tbox(folder / "proposals.ttl").classes if cls.label == HOSTILE]
    assert proposed.comment == ""
    assert 'skos:example "/Kitchen/Cup_1"' in (folder / "proposals.ttl").read_text("utf-8")


def test_the_queue_begins_where_the_grounders_disagree(browser: Browser, stage: Path, tmp_path: Path):
    second = write_second(stage, tmp_path / "second.json")
    with running_studio(stage, tmp_path / "project", second=second) as client:
        page = open_page(browser, client)
        order = page.get_by_label("Order")
        while not order.evaluate("select => select === document.activeElement"):
            page.keyboard.press("Tab")
        # The first letter chooses, and the keys of the review work again at once.
        page.keyboard.press("d")
        expect(page.locator(".queue-row .class-name").first).to_have_text("cup ≠ bowl")
        expect(page.locator(".object-panel .disputed")).to_contain_text("bowl (0.50): disagrees")
        page.keyboard.press("Enter")
        expect(page.locator(".queue-row .class-name").first).to_have_text("table ≠ no class")
        close_page(page)


def hover(page: Page) -> None:
    """Move the mouse over the object in the middle of the picture."""
    page.mouse.move(0, 0)
    page.wait_for_timeout(600)
    page.locator("canvas").hover()
    expect(page.locator(".hover-line")).to_be_visible()


def test_a_random_sample_is_audited(browser: Browser, tmp_path: Path):
    with running_studio(demo_scene(), tmp_path / "project") as client:
        page = open_page(browser, client)
        expect(page.locator(".queue-row .confidence").first).not_to_be_empty()
        hover(page)
        expect(page.locator(".hover-line")).to_contain_text(CONFIDENCE)
        page.keyboard.press("v")
        note = page.locator(".audit-note")
        expect(note).to_contain_text("0 of 30 judged, drawn at random from 294")
        expect(page.locator(".object-panel h2")).to_be_visible()
        for key, done in (("Enter", 1), ("Enter", 2), ("n", 3), ("q", 4)):
            page.keyboard.press(key)
            expect(note).to_contain_text(f"{done} of 30 judged")
        expect(page.locator(".queue-row .confidence").first).to_be_empty()
        expect(page.locator(".object-panel .share")).to_have_count(0)
        expect(page.locator(".object-panel")).not_to_contain_text("confidence")
        expect(page.get_by_label("Color by").locator("option", has_text="Confidence")).to_have_count(0)
        page.locator("#tab-facets").click()
        expect(page.locator(".facets")).not_to_contain_text("Confidence")
        hover(page)
        expect(page.locator(".hover-line")).not_to_contain_text(CONFIDENCE)
        page.keyboard.press("Control+z")
        expect(note).to_contain_text("3 of 30 judged")
        page.locator("#tab-run").click()
        figures = page.get_by_role("region", name="Random audit")
        expect(figures).to_contain_text("2 of 3 right: 67 %, 95 % interval 21 to 94 %")
        expect(figures).to_contain_text("n = 3")
        page.keyboard.press("v")
        expect(note).to_be_hidden()
        expect(page.locator(".queue-row .confidence").first).not_to_be_empty()
        expect(page.locator(".facets")).to_contain_text("Confidence")
        close_page(page)


def test_what_the_filter_hides_is_not_decided(browser: Browser, stage: Path, tmp_path: Path):
    with running_studio(stage, tmp_path / "project") as client:
        page = open_page(browser, client)
        page.locator(".queue-row", has_text="cup").first.click()
        page.get_by_label("Filter objects").fill("Cup_2")
        page.keyboard.press("Escape")
        expect(page.locator(".member")).to_have_count(1)
        expect(page.locator(".group-card header")).to_contain_text("1 of 1 ticked · 1 filtered out")
        page.keyboard.press("b")
        expect(page.get_by_role("dialog")).to_contain_text("Confirm 1 object")
        page.keyboard.press("Escape")
        page.keyboard.press("Enter")
        expect(page.locator(".status-bar")).to_contain_text("1 of 5 decided · 4 groups open")
        empty = page.locator(".review .empty")
        expect(empty).to_have_text("No open object matches the filter; 4 groups open.")
        page.locator(".search .chip").click()
        expect(page.locator(".queue-row")).to_have_count(4)
        states = [state["state"] for state in client.ask("api/states").json()["states"]]
        assert Counter(states) == {"confirmed": 1, "suggested": 4}
        close_page(page)


def test_a_decision_without_an_answer_comes_back(browser: Browser, stage: Path, tmp_path: Path):
    with running_studio(stage, tmp_path / "project") as client:
        page = open_page(browser, client)
        cups = page.locator(".queue-row", has_text="cup").first
        saving, notices = page.locator(".status-bar .saving"), page.locator(".notices")
        # First without the stream of changes, then without any answer.
        gone = ["api/events"]
        page.route("**/api/**", lambda route: route.abort() if gone[-1] in route.request.url else route.continue_())
        page.reload()
        expect(saving).to_contain_text("Offline")
        expect(cups).to_be_visible()
        gone.append("api/")
        cups.click()
        expect(page.locator(".member .thumbnail").first).to_have_text("not loaded")
        page.keyboard.press("Space")
        page.keyboard.press("c")
        expect(notices).to_contain_text("Not saved: Cup_2 (the server does not answer")
        expect(page.locator(".group-card header")).to_contain_text("1 of 2 ticked")
        expect(page.locator(".queue-row")).to_have_count(4)
        page.keyboard.press("r")
        expect(saving).to_contain_text("Offline")
        gone.append("nothing")
        expect(notices).to_contain_text("Not saved while the server did not answer: Cup_2", timeout=20_000)
        expect(saving).to_have_text("Not saved")
        expect(page.locator(".member .thumbnail img")).to_have_count(2)
        page.keyboard.press("c")
        expect(saving).to_have_text("Saved")
        states = [state["state"] for state in client.ask("api/states").json()["states"]]
        assert Counter(states) == {"confirmed": 1, "suggested": 4}
        # The browser reports each request that failed.
        page.problems.clear()  # type: ignore[attr-defined]
        close_page(page)
