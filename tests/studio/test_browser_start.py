"""The first picture: boxes drawn on the CPU, in the place of the view, until WebGL has drawn its first frame."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, Page, Route, expect

from tests.browser import BROWSER_MARKS
from tests.studio.conftest import KEY, Client, running_studio
from usd2kg.demo import demo_scene
from usd2kg.graph import write_graph
from usd2kg.pipeline import build

pytestmark = BROWSER_MARKS

NO_MESHES = {"chunks": [], "triangles": 0, "source_triangles": 0}
FIRST_PAINT = "performance.getEntriesByName('first-contentful-paint').length > 0"
FIRST_FRAME = "window.studioViewer?.frameMs > 0"
HIDE_CONTROLS = """for (const each of document.querySelectorAll(".view-tools, .legend, .view-notes, .notices"))
  each.style.visibility = "hidden";"""
REMOVE_WEBGL = """() => {
  const get = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind.startsWith("webgl") ? null : get.call(this, kind, ...rest);
  };
}"""


class HeldStart:
    """A page whose main script is not delivered until it is released; no meshes arrive."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self._held: list[Route] = []
        page.route("**/assets/main-*.js", self._hold)
        page.route("**/api/geometry", lambda route: route.fulfill(json=NO_MESHES))

    def open(self, client: Client) -> NDArray[np.int64]:
        """Return the first picture, as it is on the screen."""
        self.page.goto(f"{client.address}#token={KEY}", wait_until="commit")
        expect(self.page.locator("canvas.first-picture")).to_be_visible()
        wait_until(self.page, FIRST_PAINT)
        return pixels_of(self.page, "canvas.first-picture")

    def _hold(self, route: Route) -> None:
        self._held.append(route)

    def release(self) -> None:
        for route in self._held:
            route.continue_()
        wait_until(self.page, FIRST_FRAME)

    def view(self) -> NDArray[np.int64]:
        """Return the picture of the view, without what is over it."""
        self.page.evaluate(HIDE_CONTROLS)
        self.page.wait_for_timeout(300)
        return pixels_of(self.page, ".canvas-host canvas")


@contextmanager
def held_page(
    browser: Browser, scheme: Literal["light", "dark"] = "light", width: int = 1440, ratio: float = 1
) -> Iterator[HeldStart]:
    context = browser.new_context(
        viewport={"width": width, "height": 900}, color_scheme=scheme, device_scale_factor=ratio
    )
    yield HeldStart(context.new_page())
    context.close()


def wait_until(page: Page, condition: str) -> None:
    """Wait for a JavaScript condition; the policy of the page forbids `wait_for_function`."""
    for _ in range(200):
        if page.evaluate(condition):
            return
        page.wait_for_timeout(50)
    raise AssertionError(condition)


def pixels_of(page: Page, selector: str) -> NDArray[np.int64]:
    """Return (h, w, 3) of what is on the screen where an element is."""
    box = page.locator(selector).bounding_box()
    assert box is not None
    picture = Image.open(io.BytesIO(page.screenshot(clip=box))).convert("RGB")
    return np.asarray(picture, dtype=np.int64)


def silhouette(pixels: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return where there is something else than the background, which is in the corner."""
    found: NDArray[np.bool_] = (np.abs(pixels - pixels[0, 0]) > 6).any(axis=2)
    return found


def check_alike(first: NDArray[np.int64], view: NDArray[np.int64]) -> None:
    """Check that two pictures differ at edges only, which WebGL smoothes."""
    assert first.shape == view.shape
    assert (first[0, 0] == view[0, 0]).all()
    one, other = silhouette(first), silhouette(view)
    assert one.mean() > 0.05
    assert (one & other).sum() / (one | other).sum() > 0.97
    different = np.abs(first - view).max(axis=2) > 6
    assert different.mean() < 0.08
    # No surface differs: an edge is at most two pixels wide.
    inside = different[1:-1, 1:-1].copy()
    for down, right in ((0, 1), (1, 0), (1, 2), (2, 1)):
        inside &= different[down : down + inside.shape[0], right : right + inside.shape[1]]
    assert inside.mean() < 0.01


@pytest.mark.parametrize(("scheme", "width", "ratio"), [("light", 1440, 1.0), ("dark", 1440, 2.0), ("light", 700, 1.0)])
def test_the_first_picture_is_that_of_the_view_and_gives_way_to_it(
    browser: Browser, tmp_path: Path, scheme: Literal["light", "dark"], width: int, ratio: float
) -> None:
    with running_studio(demo_scene(), tmp_path / "project") as client, held_page(browser, scheme, width, ratio) as held:
        first = held.open(client)
        held.release()
        page = held.page
        assert page.locator("canvas.first-picture").count() == 0
        assert page.locator(".first-page").count() == 0
        expect(page.locator(".queue-row").first).to_be_visible()
        view = held.view()
        if width > 1000:
            check_alike(first, view)
        else:
            # The bar above the view has its height when its fields are there.
            assert silhouette(first).mean() > 0.05
            assert silhouette(view).mean() > 0.05


def test_a_graph_has_a_first_picture_with_the_same_ghosts(browser: Browser, tmp_path: Path) -> None:
    graph = tmp_path / "kitchen.ttl"
    write_graph(build(demo_scene()).graph, graph)
    with running_studio(graph, tmp_path / "project") as client, held_page(browser) as held:
        first = held.open(client)
        held.release()
        check_alike(first, held.view())


def test_a_comparison_has_a_first_picture_without_the_colours_of_the_materials(
    browser: Browser, stage: Path, tmp_path: Path
) -> None:
    with (
        running_studio(stage, tmp_path / "project", compared=stage) as client,
        held_page(browser) as held,
    ):
        first = held.open(client)
        held.release()
        check_alike(first, held.view())


def test_without_the_key_there_is_neither_a_request_nor_a_picture(
    browser: Browser, stage: Path, tmp_path: Path
) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        page = browser.new_page()
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        page.goto(client.address)
        expect(page.get_by_label("Password")).to_be_visible()
        assert not [url for url in asked if "/api/" in url]
        assert page.locator("canvas").count() == 0
        page.goto(f"{client.address}?again#token=wrong")
        expect(page.get_by_role("alert")).to_have_text("This key is wrong.")
        assert page.locator("canvas").count() == 0
        page.get_by_label("Password").fill(KEY)
        page.keyboard.press("Enter")
        expect(page.locator(".queue-row").first).to_be_visible()
        expect(page.locator("canvas.first-picture")).to_have_count(0)
        page.close()


def test_without_webgl_the_page_says_so_and_works(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        page = browser.new_page()
        page.add_init_script(f"({REMOVE_WEBGL})()")
        page.goto(f"{client.address}#token={KEY}")
        expect(page.locator(".viewer")).to_contain_text("This browser has no WebGL 2")
        expect(page.locator(".queue-row").first).to_be_visible()
        assert page.locator("canvas").count() == 0
        page.close()


def test_a_new_key_in_the_address_opens_the_page(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as client:
        page = browser.new_page()
        page.goto(f"{client.address}#token=of-the-studio-before")
        expect(page.get_by_role("alert")).to_have_text("This key is wrong.")
        # Only the fragment differs, so that the browser itself loads nothing.
        page.goto(f"{client.address}#token={KEY}")
        expect(page.locator(".queue-row").first).to_be_visible()
        assert KEY not in page.url
        page.close()
