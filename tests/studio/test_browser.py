"""The studio in a real browser, by keyboard alone."""

from pathlib import Path

from playwright.sync_api import Browser, Page, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.studio.conftest import HOSTILE, KEY, STAGE, running_studio
from usd2kg.demo import demo_scene
from usd2kg.graph import write_graph
from usd2kg.grounding import read_decisions
from usd2kg.ontology import load_home_tbox
from usd2kg.pipeline import build
from usd2kg.query import load_graph

pytestmark = BROWSER_MARKS


def group_title(page: Page) -> str:
    return page.locator(".group-card h2").inner_text()


def wait_for_group(page: Page, before: str) -> None:
    expect(page.locator(".group-card h2")).not_to_have_text(before)


def press_and_wait(page: Page, key: str) -> None:
    before = group_title(page)
    page.keyboard.press(key)
    wait_for_group(page, before)


def test_a_scene_is_reviewed_with_the_keyboard_alone(browser: Browser, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(demo_scene(), folder) as client:
        page = open_page(browser, client)
        # An exception: the second member stays open.
        members = page.locator(".member").count()
        assert members > 1
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Space")
        expect(page.locator(".group-card header p")).to_contain_text(f"{members - 1} of {members} ticked")
        page.keyboard.press("Enter")
        expect(page.locator(".group-card header p")).to_contain_text("1 of 1 ticked")
        press_and_wait(page, "j")
        press_and_wait(page, "1")
        press_and_wait(page, "u")
        before = group_title(page)
        page.keyboard.press("/")
        page.keyboard.type("wine bottle")
        expect(page.locator("[role=option] strong").first).to_have_text("wine bottle")
        page.keyboard.press("Enter")
        wait_for_group(page, before)
        press_and_wait(page, "n")
        press_and_wait(page, "q")
        expect(page.locator(".status-bar .saving")).to_have_text("Saved")
        states = client.ask("api/states").json()
        counts = {state["state"] for state in states["states"]}
        assert {"suggested", "confirmed", "corrected", "no-class", "unsure"} <= counts
        assert states["version"] == 6
        for _ in range(6):
            page.keyboard.press("Control+z")
            page.wait_for_timeout(150)
        expect(page.get_by_role("button", name="Undo")).to_be_disabled()
        assert {state["state"] for state in client.ask("api/states").json()["states"]} == {"suggested"}
        for _ in range(6):
            page.keyboard.press("Control+Shift+z")
            page.wait_for_timeout(150)
        expect(page.get_by_role("button", name="Redo")).to_be_disabled()
        again = client.ask("api/states").json()["states"]
        assert [(one["class"], one["state"]) for one in again] == [
            (one["class"], one["state"]) for one in states["states"]
        ]
        close_page(page)
    check_follow_up(browser, folder)


def check_follow_up(browser: Browser, folder: Path) -> None:
    """After a restart, a second reviewer goes on; the graph is that of a build with the decisions."""
    tbox = load_home_tbox()
    with running_studio(demo_scene(), folder) as client:
        page = open_page(browser, client, "https://orcid.org/0000-0002-1825-0097")
        expect(page.get_by_role("button", name="Undo")).to_be_disabled()
        decided = int(page.locator(".status-bar").inner_text().partition(" of ")[0].split()[-1])
        press_and_wait(page, "Enter")
        expect(page.get_by_role("button", name="Undo")).to_be_enabled()
        now = client.ask("api/states?reviewer=x").json()["states"]
        assert sum(state["state"] in {"confirmed", "corrected", "no-class"} for state in now) > decided
        page.keyboard.press("Control+k")
        page.keyboard.type("cup")
        expect(page.locator(".search .chip")).to_contain_text("shown")
        page.keyboard.press("Escape")
        page.keyboard.press("?")
        expect(page.get_by_role("dialog", name="Keys")).to_be_visible()
        page.keyboard.press("Escape")
        expect(page.get_by_role("dialog", name="Keys")).to_be_hidden()
        close_page(page)
    decisions = read_decisions(folder / "decisions.sssom.tsv", tbox)
    built = build(demo_scene(), decisions=decisions)
    graph = load_graph(folder / "graph.ttl")
    query = "SELECT ?p ?c { ?o u2k:primPath ?p ; a ?c . ?c a owl:Class } ORDER BY ?p ?c"
    expected = {(p.prim_path, p.class_iri) for p in built.grounding.predictions if p.class_iri}
    assert expected <= set(graph.sparql(query).rows)
    assert "0000-0002-1825-0097" in (folder / "graph.ttl").read_text()


def test_reviewers_see_each_other(browser: Browser, stage: Path, tmp_path: Path):
    with running_studio(stage, tmp_path / "project") as client:
        ann, bob = open_page(browser, client, "Ann"), open_page(browser, client, "Bob")
        press_and_wait(ann, "Enter")
        expect(bob.locator(".notice")).to_contain_text("Ann: confirm")
        expect(bob.locator(".status-bar")).to_contain_text("1 of 5 decided")
        close_page(ann)
        close_page(bob)


def test_names_stay_text(browser: Browser, stage: Path, tmp_path: Path):
    with running_studio(stage, tmp_path / "project") as client:
        page = open_page(browser, client)
        page.get_by_label("Filter objects").fill("cup")
        for button in ("Labels",):
            page.get_by_role("button", name=button).click()
        page.locator(".tree-row", has_text="<img").click()
        expect(page.locator(".object-panel h2")).to_have_text(HOSTILE)
        page.locator("#tab-ask").click()
        page.get_by_label("Question").fill("what is on the table?")
        page.keyboard.press("Enter")
        expect(page.locator(".answer-table")).to_contain_text("<img src=x", timeout=30_000)
        assert page.title() == "kitchen.usda · usd2kg studio"
        assert page.locator("img[src=x]").count() == 0
        close_page(page)


def test_a_click_selects_in_all_panels_and_questions_select_in_the_picture(
    browser: Browser, stage: Path, tmp_path: Path
):
    with running_studio(stage, tmp_path / "project") as client:
        page = open_page(browser, client)
        page.keyboard.press("t")
        page.wait_for_timeout(600)
        box = page.locator("canvas").bounding_box()
        assert box is not None
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        expect(page.locator(".object-panel h2")).to_have_text("Table")
        expect(page.locator(".tree-row[aria-selected=true]")).to_contain_text("Table")
        page.locator("#tab-sparql").click()
        page.get_by_label("SPARQL query").fill('SELECT ?p { ?o u2k:primPath ?p FILTER(STRENDS(?p, "Zxqv")) }')
        page.get_by_role("button", name="Run").click()
        # The first query starts a process.
        expect(page.locator(".object-panel h2")).to_have_text("Zxqv", timeout=30_000)
        page.get_by_label("SPARQL query").fill("SELECT nonsense")
        page.get_by_role("button", name="Run").click()
        expect(page.get_by_role("alert")).to_contain_text("query", timeout=30_000)
        page.problems.clear()  # type: ignore[attr-defined]
        close_page(page)


def test_a_wrong_key_is_asked_for_again(browser: Browser, stage: Path, tmp_path: Path):
    with running_studio(stage, tmp_path / "project") as client:
        page = browser.new_page()
        page.goto(f"{client.address}#token=wrong")
        expect(page.get_by_role("alert")).to_have_text("This key is wrong.")
        page.get_by_label("Password").fill(KEY)
        page.keyboard.press("Enter")
        expect(page.locator(".queue-row").first).to_be_visible()
        assert KEY not in page.url
        page.close()


def test_a_graph_is_shown_as_boxes_and_says_why(browser: Browser, stage: Path, tmp_path: Path):
    graph = tmp_path / "kitchen.ttl"
    write_graph(build(stage).graph, graph)
    with running_studio(graph, tmp_path / "project") as client:
        page = open_page(browser, client)
        expect(page.locator(".boxes-only")).to_contain_text("kitchen.usda is not beside the graph")
        page.get_by_label("Color by").select_option("class")
        for width in (1440, 1000, 600):
            page.set_viewport_size({"width": width, "height": 500})
            note, legend = (page.locator(name).bounding_box() for name in (".boxes-only", ".legend"))
            assert note is not None
            assert legend is not None
            assert note["x"] + note["width"] <= legend["x"], f"the legend covers the note in {width} pixels"
        expect(page.get_by_role("button", name="Ground again")).to_be_disabled()
        page.locator("summary", has_text="Export").click()
        expect(page.get_by_role("button", name="Labels (USD layer)")).to_be_disabled()
        expect(page.get_by_role("button", name="Knowledge graph (Turtle)")).to_be_enabled()
        page.keyboard.press("r")
        expect(page.locator(".notice")).to_contain_text("open the stage")
        press_and_wait(page, "n")
        expect(page.locator(".saving")).to_have_text("Saved")
        close_page(page)
    assert len(read_decisions(tmp_path / "project" / "decisions.sssom.tsv", load_home_tbox())) == 1


def test_changes_are_listed_filtered_and_looked_at_with_the_keyboard(browser: Browser, tmp_path: Path):
    now, before = tmp_path / "kitchen.usda", tmp_path / "before.usda"
    now.write_text(STAGE)
    # Before, Cup_2 was 0.3 m farther, there was a plate, and no Zxqv.
    earlier = STAGE.replace("(-0.2, 0, 0.75)", "(-0.2, 0.3, 0.75)").replace('"Zxqv"', '"Plate"')
    before.write_text(earlier.replace("(1.5, 1.5, 0.15)", "(-1.5, -1.5, 0.15)").replace("size = 0.3", "size = 0.4"))
    with running_studio(now, tmp_path / "project", compared=before) as client:
        page = open_page(browser, client)
        changes = page.get_by_role("listbox", name="Changes")
        rows = changes.get_by_role("option")
        expect(rows).to_have_count(3)
        expect(page.locator(".legend")).to_contain_text("Disappeared1")
        changes.focus()
        for _ in range(3):
            page.keyboard.press("ArrowDown")
        expect(changes.get_by_role("option", selected=True)).to_contain_text("moved 0.30 m")
        expect(page.locator(".object-panel h2")).to_have_text("Cup_2")
        page.keyboard.press("ArrowUp")
        expect(changes.get_by_role("option", selected=True)).to_contain_text("gone: plate")
        moved = page.get_by_role("group", name="Kinds of change").get_by_role("button", name="Moved")
        moved.press("Space")
        expect(moved).to_have_attribute("aria-pressed", "false")
        expect(rows).to_have_count(2)
        close_page(page)
