"""Draw the pictures of the README: the classes of objects in the demo kitchen, and one object in its graph.

Usage: python tools/draw_readme_pictures.py
"""

import base64
from collections.abc import Iterator
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.diagrams import draw_surroundings, to_png
from usd2kg.diagrams.svg import FONT
from usd2kg.render import Renderer

IMAGES = Path(__file__).parent.parent / "docs/images"
SIZE = (1000, 720)
LARGEST_FONT = 15
LABELLED = (
    "breakfastBar/barStool_1",
    "breakfastBar/fruitBowl",
    "cleaningCorner/Bucket_blue",
    "cleaningCorner/stepladder",
    "coldStore/Fridge_01",
    "counterRun/cookerHood",
    "counterRun/ovenGrp/oven_builtIn",
    "counterRun/sink_steel",
    "diningArea/rug",
    "diningArea/silla_3",
    "pantry/Regal_hoch",
    "readingCorner/Sessel_01",
    "readingCorner/shoppingBasket",
    "shell/window_02",
    "sideboard/Cuboard",
    "sideboard/layerCake",
    "wallUnits/cab_up_01/carcass",
)
"""Visible objects with names in several languages, abbreviated and misspelt ones among them."""
CENTRE = "fruitBowl"


class Tag(NamedTuple):
    """A tag of an object; pixels from the top left corner."""

    x: float
    y: float
    left: float
    top: float
    width: float
    text: str

    def overlaps(self, other: "Tag") -> bool:
        """Return whether the boxes of two tags overlap or nearly touch."""
        is_level = abs(self.top - other.top) < 26
        return is_level and self.left < other.left + other.width + 6 and other.left < self.left + self.width + 6


def main() -> None:
    """Write both pictures."""
    result = usd2kg.build(demo_scene())
    IMAGES.mkdir(exist_ok=True)
    (IMAGES / "kitchen_classes.png").write_bytes(to_png(tagged_scene(result), scale=1.0))
    with TemporaryDirectory() as folder:
        file = Path(folder) / "kitchen.ttl"
        usd2kg.write_graph(result.graph, file)
        store = usd2kg.load_graph(file)
    (individual,) = store.find(CENTRE)
    drawing = draw_surroundings(store, individual.value, "fruit bowl in kitchen.ttl")
    (IMAGES / "fruit_bowl.png").write_bytes(to_png(drawing, scale=1.0))


def tagged_scene(result: usd2kg.BuildResult) -> str:
    """Return an SVG of the scene with the name, class and confidence of the labelled objects."""
    renderer = Renderer(demo_scene())
    picture = base64.b64encode(renderer.render_scene(size=SIZE)).decode("ascii")
    width, height = SIZE
    shapes = "\n".join(map(tag_svg, place_tags(renderer, result)))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="{escape(FONT)}" '
        f'font-size="{LARGEST_FONT}">\n<image href="data:image/png;base64,{picture}" width="{width}" '
        f'height="{height}"/>\n{shapes}\n</svg>\n'
    )


def tag_svg(tag: Tag) -> str:
    """Return the SVG of a tag with a line to its object."""
    middle, bottom = tag.left + tag.width / 2, tag.top + 22
    return (
        f'<path d="M{tag.x:.0f} {tag.y:.0f}L{middle:.0f} {bottom:.0f}" stroke="#1b2230" stroke-width="1.3"/>'
        f'<circle cx="{tag.x:.0f}" cy="{tag.y:.0f}" r="3" fill="#1b2230"/>'
        f'<rect x="{tag.left:.0f}" y="{tag.top:.0f}" width="{tag.width:.0f}" height="22" rx="5" fill="white" '
        'stroke="#1b2230"/>'
        f'<text x="{tag.left + 7:.0f}" y="{tag.top + 16:.0f}" fill="#1b2230">{escape(tag.text)}</text>'
    )


def place_tags(renderer: Renderer, result: usd2kg.BuildResult) -> Iterator[Tag]:
    """Yield one tag per labelled object: above it, or where it overlaps no other tag."""
    boxes = {item.prim_path: item.box for item in result.scene.objects}
    placed: list[Tag] = []
    for answer in result.grounding.predictions:
        box = boxes.get(answer.prim_path)
        if not answer.prim_path.endswith(LABELLED) or box is None or answer.class_iri is None:
            continue
        centre = (np.array(box.lower) + np.array(box.upper)) / 2
        ((x, y),) = renderer.project_scene(centre[None], size=SIZE)
        text = f"{answer.prim_path.rpartition('/')[2]}: {result.tbox.by_iri[answer.class_iri].label}"
        width = 14 + 0.6 * LARGEST_FONT * len(text)
        for rise, shift in ((r, s) for r in (44, 70, -30, 96) for s in (0, -60, 60, -120, 120)):
            left = min(max(x - width / 2 + shift, 4), SIZE[0] - width - 4)
            tag = Tag(x, y, left, y - rise, width, text)
            if tag.top > 2 and not any(tag.overlaps(other) for other in placed):
                placed.append(tag)
                yield tag
                break


if __name__ == "__main__":
    main()
