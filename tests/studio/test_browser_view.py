"""The 3D view in a real browser: what its pixels show."""

import io
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Browser, Page, expect

from tests.browser import BROWSER_MARKS, close_page, open_page
from tests.studio.conftest import running_studio
from tests.studio.test_textures import poster
from usd2kg.demo import demo_scene

Image = pytest.importorskip("PIL.Image")
pytestmark = BROWSER_MARKS


def view_of(page: Page) -> NDArray[np.int16]:
    """Return the pixels (height, width, 3) of the 3D view."""
    with Image.open(io.BytesIO(page.locator("canvas").first.screenshot())) as opened:
        return np.asarray(opened.convert("RGB")).astype(np.int16)


def share(pixels: NDArray[np.int16], channel: int) -> float:
    """Return the share of pixels in which one channel is much brighter than the others."""
    others = np.delete(pixels, channel, axis=2).max(axis=2)
    return float((pixels[..., channel] > others + 60).mean())


RED, GREEN, BLUE = 0, 1, 2


@pytest.fixture
def board(tmp_path: Path) -> Path:
    """A board whose image is blue with a green quarter, and whose display colour is red."""
    image = Image.new("RGB", (64, 64), (0, 0, 255))
    image.paste((0, 255, 0), (0, 0, 32, 32))
    image.save(tmp_path / "picture.png")
    path = tmp_path / "poster.usda"
    path.write_text(poster("picture.png"), "utf-8")
    return path


def test_textures_are_shown_with_the_colours_of_materials_only(browser: Browser, board: Path, tmp_path: Path) -> None:
    with running_studio(board, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.wait_for_function("window.studioViewer.textureCount === 1")
        page.wait_for_timeout(300)
        pixels = view_of(page)
        assert share(pixels, BLUE) > 2 * share(pixels, GREEN) > 0.01
        assert share(pixels, RED) < 0.01
        page.get_by_label("Color by").select_option("confidence")
        page.wait_for_timeout(300)
        assert share(view_of(page), GREEN) < 0.001
        close_page(page)


def test_colours_by_support(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.get_by_label("Color by").select_option("support")
        legend = page.get_by_label("Legend")
        expect(legend.get_by_text("Table")).to_be_visible()
        # Both cups.
        legend.get_by_text("Table").click()
        expect(page.locator("[role=treeitem][aria-selected=true]")).to_have_count(2)
        close_page(page)


def test_the_picture_comes_back_after_the_context_is_lost(browser: Browser, board: Path, tmp_path: Path) -> None:
    with running_studio(board, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.wait_for_function("window.studioViewer.textureCount === 1")
        page.wait_for_timeout(300)
        before = view_of(page)
        page.evaluate(
            "window.lose = document.querySelector('canvas').getContext('webgl2').getExtension('WEBGL_lose_context');"
            "window.lose.loseContext()"
        )
        message = page.get_by_role("alert").filter(has_text="graphics memory")
        expect(message).to_be_visible()
        page.get_by_label("Color by").select_option("confidence")
        page.get_by_label("Color by").select_option("material")
        page.evaluate("window.lose.restoreContext()")
        expect(message).to_have_count(0)
        page.wait_for_timeout(500)
        after = view_of(page)
        # The picture is the same, with its texture.
        assert np.abs(after - before).mean() < 1
        assert share(after, BLUE) > 0.01
        close_page(page)


def test_without_an_image_the_display_colour_is_shown(browser: Browser, board: Path, tmp_path: Path) -> None:
    (tmp_path / "picture.png").write_bytes(b"no image")
    with running_studio(board, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.wait_for_timeout(500)
        pixels = view_of(page)
        assert share(pixels, RED) > 0.02
        assert share(pixels, BLUE) < 0.01
        close_page(page)


def test_the_first_picture_shows_the_scene_without_a_distant_outlier(browser: Browser, tmp_path: Path) -> None:
    cubes = [
        f"""def Cube "Box_{number}" (kind = "component") {{
        double size = 0.5
        color3f[] primvars:displayColor = [(1, 0, 0)]
        double3 xformOp:translate = ({number % 4}, {number // 4}, {343_582 if number == 5 else 0})
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}"""
        for number in range(16)
    ]
    header = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
    scene = tmp_path / "shelf.usda"
    scene.write_text(header + 'def Xform "Shelf" (kind = "group")\n{\n    ' + "\n    ".join(cubes) + "\n}\n", "utf-8")
    with running_studio(scene, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        assert share(view_of(page), RED) > 0.02
        # The group under review has the outlier, too.
        page.keyboard.press("j")
        page.keyboard.press("k")
        page.wait_for_timeout(600)
        assert share(view_of(page), RED) > 0.02
        close_page(page)


def test_messages_do_not_cover_the_review(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.keyboard.press("q")
        notice = page.locator(".notice")
        expect(notice).to_be_visible()
        box, picture = notice.bounding_box(), page.locator(".viewer").bounding_box()
        assert box is not None
        assert picture is not None
        assert picture["y"] <= box["y"]
        assert box["y"] + box["height"] <= picture["y"] + picture["height"]
        close_page(page)


def test_relations_of_the_selection_are_drawn_with_their_numbers(browser: Browser, tmp_path: Path) -> None:
    with running_studio(demo_scene(), tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.get_by_label("Filter objects").fill("wineGlass_04")
        page.locator(".tree-row", has_text="wineGlass_04").click()
        page.keyboard.press("f")
        # It is in the group under review, which has another current member.
        expect(page.locator(".object-panel h2")).to_have_text("wineGlass_04")
        labels = page.locator(".label-relation:not([hidden])")
        expect(labels.get_by_text("on", exact=True)).to_have_count(1)
        numbered = labels.filter(has_text="next to 0.0")
        expect(numbered.locator("visible=true").first).to_be_visible()
        page.locator("summary", has_text="Relations").click()
        page.get_by_label("next-to").uncheck()
        expect(numbered).to_have_count(0)
        expect(labels.get_by_text("on", exact=True)).to_have_count(1)
        close_page(page)


def camera_of(page: Page) -> dict[str, list[float]]:
    """Return the position and the target of the camera, (3,), metres."""
    found: dict[str, list[float]] = page.evaluate("""() => {
      const { active, controls } = window.studioViewer.cameras;
      return { position: active.position.toArray(), target: controls.target.toArray() };
    }""")
    return found


def test_the_keyboard_orbits_pans_and_zooms(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        start = camera_of(page)

        def offset(camera: dict[str, list[float]]) -> NDArray[np.float64]:
            return np.array(camera["position"]) - np.array(camera["target"])

        page.keyboard.press("Shift+ArrowRight")
        page.keyboard.press("Shift+ArrowUp")
        orbited = camera_of(page)
        assert orbited["target"] == pytest.approx(start["target"])
        assert np.linalg.norm(offset(orbited)) == pytest.approx(np.linalg.norm(offset(start)))
        # From the front left to the right is counterclockwise, seen from above.
        assert np.cross(offset(start), offset(orbited))[2] > 0
        assert orbited["position"][2] > start["position"][2]

        page.keyboard.press("Control+ArrowRight")
        panned = camera_of(page)
        assert panned["target"] != pytest.approx(orbited["target"])
        assert offset(panned) == pytest.approx(offset(orbited))

        page.keyboard.press("+")
        page.keyboard.press("=")
        assert np.linalg.norm(offset(camera_of(page))) < 0.8 * np.linalg.norm(offset(panned))
        for _ in range(2):
            page.keyboard.press("-")
        assert camera_of(page)["position"] == pytest.approx(panned["position"])

        page.keyboard.press("t")
        page.wait_for_timeout(500)
        zoom = page.evaluate("window.studioViewer.cameras.active.zoom")
        page.keyboard.press("+")
        assert page.evaluate("window.studioViewer.cameras.active.zoom") > zoom
        close_page(page)


def test_each_candidate_has_its_evidence(browser: Browser, stage: Path, tmp_path: Path) -> None:
    with running_studio(stage, tmp_path / "project") as studio:
        page = open_page(browser, studio)
        page.locator(".tree-row", has_text="Cup_2").click()
        summary = page.get_by_label("Evidence for cup", exact=True)
        expect(summary).to_contain_text("name 97 %")
        expect(summary).to_contain_text("size ×")
        sentence = page.locator(".candidate-evidence li", has_text="is the label of Cup")
        expect(sentence).to_be_hidden()
        summary.focus()
        page.keyboard.press("Enter")
        expect(sentence).to_be_visible()
        # The key belonged to the summary, and decided nothing.
        assert {state["state"] for state in studio.ask("api/states").json()["states"]} == {"suggested"}
        close_page(page)
