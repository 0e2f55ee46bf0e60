"""Measure the studio in a real browser: pictures, frames, decisions, memory, and keystrokes to review a scene.

The first picture is the one of the boxes that the page draws on the CPU, the picture of the view the first frame of
WebGL. Both are timed from before the tab is opened.

Usage: python -m benchmarks.studio.run [--objects 1000 10000] [--gold SCENE GOLD]...
"""

import argparse
import csv
import os
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from playwright.sync_api import Browser, Page, sync_playwright

from benchmarks.scale.stage import write_place
from benchmarks.studio.server import KEY, ask, studio
from usd2kg.demo import demo_scene

SOFTWARE_GL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--no-sandbox"]
FRAMES = 30
HAS_MESHES = """() => document.documentElement.dataset.geometry === "loaded"
  || /^Meshes [1-9]/.test(document.querySelector(".loading")?.textContent ?? "")"""
DECISIONS = 100
CONFIRM_FROM = 0.9
"""Confidence from which the reviewer confirms all groups on one page."""
ORBIT = """frames => {
  const viewer = window.studioViewer, controls = viewer.cameras.controls, times = [];
  for (let i = 0; i < frames; i++) {
    const camera = viewer.cameras.active, offset = camera.position.clone().sub(controls.target);
    offset.applyAxisAngle(camera.up, 0.05);
    camera.position.copy(controls.target).add(offset);
    controls.update();
    times.push(viewer.drawAndWait());
  }
  return times;
}"""


BLANK = """<canvas></canvas><script>
  const gl = document.querySelector("canvas").getContext("webgl2", { antialias: true });
  gl.clear(gl.COLOR_BUFFER_BIT);
</script>"""
LINE_OF_TEXT = "<p>a line of text</p>"
TWO_FRAMES = "new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))"
REPEATS = 9
FIRST_PAINT = """() => new Promise((resolve) => {
  const report = (list) => {
    const paint = list.getEntries().find((entry) => entry.name === "first-contentful-paint");
    if (paint !== undefined) resolve(performance.timeOrigin + paint.startTime);
  };
  new PerformanceObserver(report).observe({ type: "paint", buffered: true });
})"""
"""Milliseconds since the epoch; nothing is painted before the first picture (tests/studio/test_browser_start.py)."""


def new_page(browser: Browser) -> Page:
    """Return an empty page."""
    return browser.new_page(viewport={"width": 1440, "height": 900}, bypass_csp=True)


class Start(NamedTuple):
    """Seconds from before the tab is opened."""

    first: float
    """Until the first picture is on the screen."""
    view: float
    """Until WebGL has drawn its first frame."""


def open_page(browser: Browser, address: str) -> tuple[Page, Start]:
    """Open the page and wait for the first frame of the view."""
    began, start = time.time(), time.perf_counter()
    page = new_page(browser)
    page.goto(f"{address}#token={KEY}", wait_until="commit")
    page.wait_for_function("window.studioViewer?.frameMs > 0", timeout=60_000)
    view = time.perf_counter() - start
    return page, Start(page.evaluate(FIRST_PAINT) / 1000 - began, view)


def open_blank(browser: Browser) -> None:
    """Show a page with nothing but an empty WebGL canvas."""
    page = new_page(browser)
    page.set_content(BLANK)
    page.evaluate(TWO_FRAMES)


def measure_start(launch: Callable[[], Browser], scene: Path) -> None:
    """Print seconds to the pictures in a new browser and in one that runs, and what a nearly empty page takes."""
    fresh, running, blank, text = [], [], [], []
    with studio(scene) as address:
        for _ in range(REPEATS):
            with launch() as browser:
                fresh.append(open_page(browser, address)[1])
            with launch() as browser:
                start = time.perf_counter()
                open_blank(browser)
                blank.append(time.perf_counter() - start)
                running.append(open_page(browser, address)[1])
            with launch() as browser:
                began = time.time()
                page = new_page(browser)
                page.set_content(LINE_OF_TEXT)
                text.append(page.evaluate(FIRST_PAINT) / 1000 - began)
    print("| | median, s | least, s | most, s |\n| --- | --- | --- | --- |")
    for name, starts in {"new browser": fresh, "running browser": running}.items():
        print_times(f"first picture, {name}", [start.first for start in starts])
        print_times(f"picture of the view, {name}", [start.view for start in starts])
    print_times("first paint of a line of text, new browser", text)
    print_times("empty WebGL canvas, new browser", blank)


def print_times(name: str, times: list[float]) -> None:
    """Print one row of seconds."""
    print(f"| {name} | {statistics.median(times):.2f} | {min(times):.2f} | {max(times):.2f} |")


def measure_view(launch: Callable[[], Browser], scene: Path, name: str) -> None:
    """Print seconds to the pictures, the largest and all meshes, and milliseconds of a frame while orbiting."""
    with launch() as browser, studio(scene) as address:
        start = time.perf_counter()
        page, pictures = open_page(browser, address)
        page.wait_for_function(HAS_MESHES, timeout=300_000)
        largest = time.perf_counter() - start
        page.wait_for_selector("html[data-geometry=loaded]", timeout=300_000)
        meshes = time.perf_counter() - start
        times = page.evaluate(ORBIT, FRAMES)
        calls = page.evaluate("window.studioViewer.drawCalls")
        triangles = page.evaluate("window.studioViewer.triangles")
        heap = page.evaluate("performance.memory.usedJSHeapSize") / 2**20
        page.close()
    median, slowest = statistics.median(times), max(times)
    print(
        f"| {name} | {pictures.first:.2f} | {pictures.view:.2f} | {largest:.2f} | {meshes:.2f} | {median:.0f} "
        f"| {slowest:.0f} | {calls} | {triangles:,} | {heap:.0f} |"
    )


def measure_decisions(scene: Path) -> None:
    """Print milliseconds from a decision's request to its answer, after it is on disk."""
    with studio(scene) as address:
        count = len(ask(address, "states")["states"])
        times = []
        for number in range(DECISIONS):
            start = time.perf_counter()
            ask(address, "decisions", {"objects": [number % count], "action": "confirm", "reviewer": "benchmark"})
            times.append(1000 * (time.perf_counter() - start))
    times.sort()
    print(f"Decision on disk: median {statistics.median(times):.1f} ms, 99 % {times[int(0.99 * len(times))]:.1f} ms")


def count_keystrokes(scene: Path, gold: Path) -> None:
    """Review a scene with keys as somebody who knows the gold labels, and print how many it took.

    The reviewer first confirms what is confident on one page (B), unticking wrong groups with Tab and Space, then goes
    through the groups that are left: Enter, a digit, or / with the name of the class, counted letter by letter.
    """
    with gold.open(encoding="utf-8") as file:
        right = {
            row["path"]: {row["class"], *filter(None, row.get("also", "").split("|"))} for row in csv.DictReader(file)
        }
    with studio(scene) as address:
        data = ask(address, "scene")
        paths, classes = data["objects"]["path"], data["classes"]
        states = ask(address, "states")["states"]
        named = [{cls["iri"], cls["name"], cls["iri"].rpartition("#")[2]} for cls in classes]

        def is_right(index: int, chosen: int) -> bool:
            known = right.get(paths[index])
            return known is None or (
                chosen >= 0
                and bool(named[chosen] & {name.rpartition(":")[2] for name in known} | named[chosen] & known)
            )

        labelled = [i for i, path in enumerate(paths) if path in right]
        correct = sum(is_right(i, states[i]["suggested"]) for i in labelled)
        keys = 1  # B
        queue = ask(address, "queue")["groups"]
        sure = [g for g in queue if g["suggested"] >= 0 and (g["confidence"] or 0) >= CONFIRM_FROM]
        wrong = [g for g in sure if not all(is_right(i, g["suggested"]) for i in g["objects"])]
        keys += 2 * len(wrong) + 1
        left = [g for g in queue if g not in sure] + wrong
        for group in left:
            keys += keys_for(group, is_right, address, classes, named, right, paths)
        decided = len(paths)
    share = correct / len(labelled)
    print(
        f"| {scene.stem} | {decided} | {share:.0%} | {len(queue)} | {len(sure) - len(wrong)} | {len(left)} | {keys} "
        f"| {125 * keys / decided:.0f} |"
    )


def keys_for(
    group: dict[str, Any],
    is_right: Callable[[int, int], bool],
    address: str,
    classes: list[dict[str, Any]],
    named: list[set[str]],
    right: dict[str, set[str]],
    paths: list[str],
) -> int:
    """Return the keystrokes that settle one group, its exceptions one by one."""
    keys, first = 0, True
    waiting = list(group["objects"])
    while waiting:
        lead = waiting[0]
        if is_right(lead, group["suggested"]):
            same = [i for i in waiting if is_right(i, group["suggested"])]
            cost = 1
        else:
            candidates = [c["class"] for c in ask(address, f"object/{lead}")["candidates"]]
            digit = next((n for n, chosen in enumerate(candidates) if is_right(lead, chosen)), None)
            chosen = candidates[digit] if digit is not None else None
            wanted = right.get(paths[lead], set())
            same = [i for i in waiting if right.get(paths[i], wanted) == wanted]
            label = next((c["label"] for c, names in zip(classes, named, strict=True) if names & wanted), "artifact")
            # A digit, or the search box: /, about four letters, Enter.
            cost = 1 if chosen is not None else 2 + min(4, len(label))
        # Exceptions are unticked: an arrow and a space each.
        keys += cost + 2 * (len(waiting) - len(same)) * first
        waiting = [i for i in waiting if i not in same]
        first = False
    return keys


def main() -> None:
    """Run all measurements."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--objects", type=int, nargs="*", default=[1000, 10_000])
    parser.add_argument("--gold", nargs=2, action="append", type=Path, metavar=("SCENE", "GOLD"), default=[])
    options = parser.parse_args()
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        # A browser for each scene: closing the page of another one takes seconds in the background.
        launch = partial(
            playwright.chromium.launch,
            executable_path=chromium,
            args=[*SOFTWARE_GL, "--enable-precise-memory-info"],
        )
        print(
            "| scene | first picture, s | view, s | largest meshes, s | all meshes, s | frame, ms | slowest, ms "
            "| calls | triangles | page, MiB |"
        )
        print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
        measure_view(launch, demo_scene(), "demo kitchen")
        for objects in options.objects:
            stage = Path(folder) / f"flats{objects}.usdc"
            write_place(stage, "flats", objects)
            measure_view(launch, stage, f"flats, {objects:,} objects")
        measure_start(launch, demo_scene())
        measure_decisions(demo_scene())
        if options.gold:
            print("| scene | objects | right | groups | confirmed at once | one by one | keys | keys per 125 objects |")
            print("| --- | --- | --- | --- | --- | --- | --- | --- |")
        for scene, gold in options.gold:
            count_keystrokes(scene, gold)


if __name__ == "__main__":
    main()
