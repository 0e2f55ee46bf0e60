"""Measure whether the memory of the studio's page grows while a scene is reviewed in Chromium.

Usage: python -m benchmarks.studio.page_soak [--scene SCENE] [--steps 600]

A step decides about a group and looks at the next one; every second step is taken back, and half of those are made
again. In between, the reviewer selects an object in the tree, moves in the group, changes the colours, turns the view,
asks, searches a class, opens the help, the list of many groups, and the other panels, and filters. The heap is measured
after a garbage collection, every 10 steps; the counts of nodes and listeners are those of the document.
"""

import argparse
import os
import shutil
from pathlib import Path

from playwright.sync_api import CDPSession, Page, expect, sync_playwright

from benchmarks.studio.run import SOFTWARE_GL, new_page
from benchmarks.studio.server import KEY, studio
from benchmarks.studio.soak import watch
from usd2kg.demo import demo_scene

COLORS = ("class", "concept", "confidence", "state", "room", "support", "material")
DRAWERS = ("Ask", "SPARQL", "Diagnostics", "Run")
SAMPLE_STEPS = 10
MIB = 2**20


def heap_mib(session: CDPSession) -> float:
    """Return the used heap of the page after a garbage collection, MiB."""
    session.send("HeapProfiler.collectGarbage")
    used: float = session.send("Runtime.getHeapUsage")["usedSize"]
    return used / MIB


def counts(page: Page, session: CDPSession) -> str:
    """Return the number of nodes and listeners of the document, and of what the graphics memory holds."""
    found = session.send("Memory.getDOMCounters")
    memory = page.evaluate("({ ...window.studioViewer.renderer.info.memory })")
    return (
        f"{found['nodes']:,} nodes, {found['jsEventListeners']:,} listeners, "
        f"{memory['geometries']} geometries, {memory['textures']} textures"
    )


def act(page: Page, number: int) -> int:
    """Do one step of the review; return 1."""
    press = page.keyboard.press
    press("Enter" if number % 3 else "n")
    expect(page.locator(".saving")).to_have_text("Saved")
    press("ArrowDown")
    press("ArrowRight")
    if number % 2:
        press("Control+z")
    if number % 4 == 1:
        press("Control+Shift+z")
    if number % 5 == 0:
        rows = page.locator(".tree-row")
        rows.nth(number % rows.count()).click()
        press("Escape")
        page.get_by_label("Color by").select_option(COLORS[number // 5 % len(COLORS)])
    if number % 7 == 0:
        for key in ("f", "Shift+ArrowRight", "+", "x", "i", "l", "a", "x", "i", "l"):
            press(key)
    if number % 10 == 3:
        for key in ("/", "?", "b", "e"):
            press(key)
            page.wait_for_timeout(50)
            press("Escape")
    if number % 20 == 6:
        explore(page, number)
    expect(page.locator(".saving")).to_have_text("Saved")
    return 1


def explore(page: Page, number: int) -> None:
    """Ask, open another panel, filter, and return to the review; then take all decisions back."""
    page.get_by_role("tab", name="Ask").click()
    page.get_by_label("Question").fill("how many cups are there?")
    page.keyboard.press("Enter")
    page.get_by_role("tab", name=DRAWERS[number // 20 % len(DRAWERS)]).click()
    page.locator("#search").fill("cup")
    page.locator("#search").fill("")
    page.get_by_role("tab", name="Review").click()
    page.locator(".queue-row").first.click()
    while page.locator(".top-bar button", has_text="Undo").is_enabled():
        page.keyboard.press("z")
        expect(page.locator(".saving")).to_have_text("Saved")


def main() -> None:
    """Print the heap over time, and how fast it grows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--scene", type=Path, default=demo_scene())
    parser.add_argument("--steps", type=int, default=600)
    options = parser.parse_args()
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with (
        studio(options.scene) as address,
        sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=chromium, args=SOFTWARE_GL) as browser,
    ):
        page = new_page(browser)
        page.goto(f"{address}#token={KEY}")
        page.wait_for_selector("html[data-geometry=loaded]", timeout=300_000)
        session = page.context.new_cdp_session(page)
        print(f"At first {heap_mib(session):.1f} MiB, {counts(page, session)}", flush=True)
        watch("steps", options.steps, lambda number: act(page, number), SAMPLE_STEPS, lambda: heap_mib(session))
        print(f"At last {heap_mib(session):.1f} MiB, {counts(page, session)}", flush=True)


if __name__ == "__main__":
    main()
