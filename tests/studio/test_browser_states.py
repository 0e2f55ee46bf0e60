"""The states without a class, of a language model's answers, in a real browser."""

import csv
import json
from collections import Counter
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.grounding.llm.servers import Reply, openai_reply, refuse, serve
from tests.studio.conftest import running_studio
from usd2kg.cli.app import make_app

pytestmark = BROWSER_MARKS


def answer(name: str) -> Reply:
    return openai_reply(json.dumps({"1": {"class": name}}))


@pytest.fixture
def mapping(stage: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A mapping of a model: a floor, a failed call (table), an unreadable answer (cups), and a refusal (Zxqv)."""
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "completions.sqlite"))
    monkeypatch.setenv("OPENAI_API_KEY", "sk-test")
    target = tmp_path / "mapping.json"
    repaired = answer("Teapot9")
    replies = [answer("Floor"), refuse(400, "too long"), answer("Teapot9"), repaired, answer("none")]
    with serve(*replies) as server:
        model = f"llm-B:openai:m@{server.url}/v1"
        make_app()(
            ["ground", str(stage), "--grounder", model, "--concurrency", "1", "-o", str(target)], standalone_mode=False
        )
    return target


def badge(page: Page, name: str) -> str:
    """Select an object in the tree and return the state on its page."""
    page.locator(".tree-row", has_text=name).click()
    expect(page.locator(".object-panel h1, .object-panel h2").first).to_contain_text(name)
    return page.locator(".object-panel .badge").inner_text().strip()


def test_each_reason_for_no_class_is_a_state_of_its_own(browser: Browser, stage: Path, mapping: Path, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(stage, folder, mapping=mapping) as client:
        page = open_page(browser, client)
        rows = [row.inner_text() for row in page.locator(".queue-row").all()]
        assert [text.splitlines()[-1] for text in rows] == [
            "no class, unreadable",
            "floor",
            "no class, failed call",
            "no class, refused",
        ]
        assert badge(page, "Table") == "Failed call"
        expect(page.locator(".object-panel")).to_contain_text("too long")
        assert badge(page, "Cup_2") == "Unreadable"
        expect(page.locator(".object-panel")).to_contain_text("is not a class of the list")
        assert badge(page, "Zxqv") == "Refused"
        assert badge(page, "Floor") == "Suggested"

        page.get_by_label("Color by").select_option("state")
        legend = page.locator(".legend").inner_text()
        assert all(label in legend for label in ("Suggested", "Refused", "Unreadable", "Failed call"))
        close_page(page)


def test_an_object_without_a_suggestion_is_not_confirmed_but_decided(
    browser: Browser, stage: Path, mapping: Path, tmp_path: Path
):
    folder = tmp_path / "project"
    with running_studio(stage, folder, mapping=mapping) as client:
        page = open_page(browser, client)
        expect(page.locator(".group-card h2")).to_contain_text("no class, unreadable")
        page.keyboard.press("Enter")
        expect(page.locator(".notice").last).to_contain_text("no suggestion to confirm")
        assert Counter(state["state"] for state in client.ask("api/states").json()["states"]) == {
            "suggested": 1, "failed": 1, "unreadable": 2, "refused": 1,
        }  # fmt: skip
        page.keyboard.press("/")
        page.keyboard.type("cup")
        page.keyboard.press("Enter")
        expect(page.locator(".queue-row")).to_have_count(3)
        expect(page.locator(".status-bar .saving")).to_have_text("Saved")
        states = Counter(state["state"] for state in client.ask("api/states").json()["states"])
        assert states == {"corrected": 2, "suggested": 1, "failed": 1, "refused": 1}
        page.keyboard.press("Control+z")
        expect(page.locator(".queue-row")).to_have_count(4)
        expect(page.locator(".queue-row").first).to_contain_text("no class, unreadable")
        page.keyboard.press("Control+Shift+z")
        expect(page.locator(".queue-row")).to_have_count(3)

        assert badge(page, "Cup_2") == "Corrected"
        page.keyboard.press("Backspace")
        expect(page.locator(".object-panel .badge")).to_have_text("Unreadable")
        expect(page.locator(".queue-row").first).to_contain_text("no class, unreadable")
        close_page(page)
    with (folder / "decisions.sssom.tsv").open(encoding="utf-8") as file:
        written = list(csv.DictReader((line for line in file if not line.startswith("#")), delimiter="\t"))
    assert {row["object_label"].lower() for row in written if row["subject_id"].endswith("Cup_2")} >= {"cup"}
