"""Decisions beyond a class of an object, in a real browser and by keyboard alone."""

from pathlib import Path

from playwright.sync_api import Browser, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.studio.conftest import HOSTILE, running_studio
from tests.studio.test_disagreement import write_second
from usd2kg.demo import demo_scene
from usd2kg.ontology import load_tbox

pytestmark = BROWSER_MARKS


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


def test_a_random_sample_is_audited(browser: Browser, tmp_path: Path):
    with running_studio(demo_scene(), tmp_path / "project") as client:
        page = open_page(browser, client)
        expect(page.locator(".queue-row .confidence").first).not_to_be_empty()
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
        page.keyboard.press("Control+z")
        expect(note).to_contain_text("3 of 30 judged")
        page.locator("#tab-run").click()
        figures = page.get_by_role("region", name="Random audit")
        expect(figures).to_contain_text("2 of 3 right: 67 %, 95 % interval 21 to 94 %")
        expect(figures).to_contain_text("n = 3")
        page.keyboard.press("v")
        expect(note).to_be_hidden()
        expect(page.locator(".queue-row .confidence").first).not_to_be_empty()
        close_page(page)
