"""Diagrams: their content, text without overlaps, escaping, and PNG output."""

import struct
import sys
from functools import partial
from pathlib import Path
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import pytest
from typer.testing import CliRunner

from tests.graph.records import build_graph, open_store, thing
from usd2kg.cli.app import make_app
from usd2kg.diagrams import draw_room, draw_surroundings, rasterize, to_png
from usd2kg.diagrams.svg import FONT, shorten, text_width
from usd2kg.errors import OutputError
from usd2kg.graph import write_graph
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore, load_graph

SVG = "{http://www.w3.org/2000/svg}"
ROOM = [
    (thing("/Room/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
    (thing("/Room/Table", (0, 0, 0), (1.6, 0.8, 0.7)), "Table"),
    *((thing(f"/Room/Plate_{i}", (0.3 * i, 0.1, 0.7), (0.2, 0.2, 0.02)), "DinnerPlate") for i in range(4)),
    (thing("/Room/Bowl", (0.1, 0.4, 0.7), (0.3, 0.3, 0.1)), "Bowl"),
    (thing("/Room/Apple", (0.2, 0.5, 0.72), (0.08, 0.08, 0.08)), "DesignedArtifact"),
    (thing("/Room/Stool", (1.8, 0, 0), (0.3, 0.3, 0.5)), "DesignedChair"),
]


@pytest.fixture(scope="module")
def store(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM))


def texts(svg: str) -> list[tuple[float, float, float, str]]:
    """Return left end, baseline, right end and content of each text; widths are those of the layout."""
    found = []
    for element in ElementTree.fromstring(svg).iter(f"{SVG}text"):
        size = float(element.attrib["font-size"])
        own = "".join(child.tail or "" for child in element if child.tag == f"{SVG}title") + (element.text or "")
        spans = [child for child in element if child.tag == f"{SVG}tspan"]
        width = text_width(own, size) + sum(7 + text_width(s.text or "", float(s.attrib["font-size"])) for s in spans)
        x, y = float(element.attrib["x"]), float(element.attrib["y"])
        left = x - width / 2 if "text-anchor" in element.attrib else x
        content = " | ".join([own, *(span.text or "" for span in spans)])
        found.append((left, y, left + width, content))
    return found


def assert_apart(svg: str) -> None:
    width = float(ElementTree.fromstring(svg).attrib["width"])
    placed = texts(svg)
    for i, (left, y, right, content) in enumerate(placed):
        assert left >= 0 and right <= width + 1, content
        for other_left, other_y, other_right, other in placed[i + 1 :]:
            assert abs(y - other_y) >= 13 or right <= other_left or other_right <= left, (content, other)


def contents(svg: str) -> list[str]:
    return [content for *_, content in texts(svg)]


def test_room_is_a_tree_with_similar_objects_on_one_line(store: GraphStore):
    shown = contents(draw_room(store, "room"))
    assert shown[0] == "room | 9 objects"
    assert "Table | on · table 0.75" in shown
    assert "4 × dinner plate | Plate_0, Plate_1, …" in shown
    assert shown.index("Bowl | bowl 0.75") + 1 == shown.index("Apple | in · artifact 0.75")
    assert "Stool | chair 0.75" in shown
    assert not any(text.startswith("Plate_") for text in shown)


def test_surroundings_show_size_contents_supporter_and_neighbours(store: GraphStore):
    (table,) = store.find("table")
    shown = contents(draw_surroundings(store, table.value, "Table"))
    assert "table, confidence 0.75" in shown
    assert "160 × 80 × 70 cm" in shown
    assert {"on it: 5", "4 × dinner plate | Plate_0, Plate_1, …", "Bowl | bowl 0.75", "Floor | floor 0.75"} <= set(
        shown
    )
    # The gap from 1.6 to 1.8 m along x.
    assert "Stool | chair, 20 cm" in shown


def test_texts_do_not_overlap(store: GraphStore):
    assert_apart(draw_room(store, "room"))
    for name in ("table", "bowl", "apple", "floor"):
        (node,) = store.find(name)
        assert_apart(draw_surroundings(store, node.value, name))


def test_300_long_names_do_not_overlap(home_tbox: TBox):
    tables = [(thing(f"/R/Table_{i}", (3 * i, 0, 0), (2, 2, 0.7)), "Table") for i in range(20)]
    names = "Cup Bowl Fork Box DesignedChair Spoon Knife Bottle Jar Pan Pot Lid Tap Bread".split()
    cups = [
        (thing(f"/R/on_{i}_{j}", (3 * i + 0.13 * j, 0.5, 0.7), (0.1, 0.1, 0.1), display_name=f"W{j} " + "W" * 40), name)
        for i in range(20)
        for j, name in enumerate(names)
    ]
    svg = draw_room(open_store(build_graph(home_tbox, [*tables, *cups])), "many")
    assert len(contents(svg)) > 300
    assert_apart(svg)


def test_names_are_escaped(home_tbox: TBox):
    name = '</text><script>alert("1")</script>&<![CDATA['
    room = [(thing("/R/Table", (0, 0, 0), (1, 1, 0.7), display_name=name), "Table")]
    store = open_store(build_graph(home_tbox, room))
    for svg in (draw_room(store, name), draw_surroundings(store, store.find(name)[0].value, name)):
        tags = {element.tag.removeprefix(SVG) for element in ElementTree.fromstring(svg).iter()}
        assert tags <= {"svg", "title", "rect", "path", "circle", "text", "tspan"}
    assert shorten("a\x00b\u202ec\n") == "a\ufffdb\ufffdc\ufffd"


def test_what_is_attached_is_below_its_holder(tmp_path: Path):
    graph = tmp_path / "hook.ttl"
    graph.write_text(
        "@prefix u2k: <https://w3id.org/usd2kg#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        '<urn:wall> u2k:primPath "/wall" ; rdfs:label "wall" .\n'
        '<urn:hook> u2k:primPath "/hook" ; rdfs:label "hook" ; u2k:attachedTo <urn:wall> .\n'
        '<urn:coat> u2k:primPath "/coat" ; rdfs:label "coat" ; u2k:attachedTo <urn:hook> .\n',
        encoding="utf-8",
    )
    shown = contents(draw_room(load_graph(graph), "hook"))
    assert "coat | attached · no class" in shown
    assert "no known relation" not in shown


def test_draws_objects_with_cyclic_support(tmp_path: Path):
    graph = tmp_path / "cycle.ttl"
    graph.write_text(
        "@prefix u2k: <https://w3id.org/usd2kg#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        '<urn:a> u2k:primPath "/a" ; rdfs:label "a" ; u2k:on <urn:b> .\n'
        '<urn:b> u2k:primPath "/b" ; rdfs:label "b" ; u2k:on <urn:a> .\n',
        encoding="utf-8",
    )
    store = load_graph(graph)
    shown = contents(draw_room(store, "cycle"))
    assert sum(text.startswith(("a |", "b |")) or text == "2 × no class" for text in shown) in {1, 2}
    assert "a" in contents(draw_surroundings(store, "urn:a", "around"))


class TestCommand:
    @pytest.fixture
    def graph(self, home_tbox: TBox, tmp_path: Path) -> Path:
        path = tmp_path / "room.ttl"
        write_graph(build_graph(home_tbox, ROOM), path)
        return path

    def test_writes_svg(self, graph: Path, tmp_path: Path):
        target = tmp_path / "table.svg"
        result = CliRunner().invoke(make_app(), ["graph", "draw", str(graph), "table", "-o", str(target)])
        assert result.exit_code == 0
        assert "160 × 80 × 70 cm" in contents(target.read_text("utf-8"))

    def test_writes_png(self, graph: Path, tmp_path: Path):
        target = tmp_path / "table.png"
        result = CliRunner().invoke(make_app(), ["graph", "draw", str(graph), "table", "-o", str(target)])
        assert result.exit_code == 0
        assert target.read_bytes().startswith(b"\x89PNG\r\n\x1a\n")

    @pytest.mark.parametrize(
        ("arguments", "message"),
        [
            (["table", "-o", "x.gif"], "expected a file name ending in .svg or .png"),
            (["dinner plate", "-o", "x.svg"], "matches 4 objects; expected a prim path"),
            (["flurbl", "-o", "x.svg"], "'flurbl' is not a word"),
        ],
    )
    def test_rejects_what_cannot_be_drawn(self, graph: Path, tmp_path: Path, arguments: list[str], message: str):
        arguments[-1] = str(tmp_path / arguments[-1])
        result = CliRunner().invoke(make_app(), ["graph", "draw", str(graph), *arguments])
        assert message in str(result.exception)


class TestPng:
    SVG = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="20" viewBox="0 0 60 20" '
        f'font-family={quoteattr(FONT)}><rect width="100%" height="100%" fill="#ffffff"/>{{}}</svg>'
    )

    def test_has_two_pixels_per_unit(self):
        # The header of a PNG: width and height as big-endian integers at byte 16 (W3C PNG, 11.2.1).
        assert struct.unpack(">II", to_png(self.SVG.format(""))[16:24]) == (120, 40)

    def test_scales_large_diagrams_down(self):
        svg = self.SVG.replace('width="60" height="20"', 'width="12000" height="8000"', 1).format("")
        width, height = struct.unpack(">II", to_png(svg)[16:24])
        assert (width / height, width * height) == (pytest.approx(1.5, rel=1e-3), pytest.approx(60e6, rel=1e-3))

    def test_draws_text(self):
        empty, named = (to_png(self.SVG.format(text)) for text in ("", '<text x="5" y="15">Table</text>'))
        assert len(named) > len(empty) + 100

    def test_missing_font_error_names_the_package(self, monkeypatch: pytest.MonkeyPatch):
        # Without fonts, resvg omits text without an error.
        import resvg_py  # noqa: PLC0415

        draw = partial(resvg_py.svg_to_bytes, skip_system_fonts=True)
        monkeypatch.setattr(resvg_py, "svg_to_bytes", draw)
        rasterize._sans_serif.cache_clear()
        with pytest.raises(OutputError, match=r"no sans-serif font.*apt-get install fonts-dejavu-core.*or write SVG"):
            to_png(self.SVG.format("<text>Table</text>"))
        rasterize._sans_serif.cache_clear()

    def test_missing_resvg_error_names_the_install_command(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "resvg_py", None)
        rasterize._sans_serif.cache_clear()
        with pytest.raises(OutputError, match=r"pip install 'usd2kg\[pictures\]', or write SVG"):
            to_png(self.SVG.format(""))
        rasterize._sans_serif.cache_clear()


def test_shared_labels_are_qualified_by_the_parent_prim(home_tbox: TBox):
    cupboards = [(thing(f"/Room/unit_{i}/carcass", (i, 0, 0), (0.5, 0.5, 0.5)), "Cupboard") for i in range(4)]
    cups = [(thing(f"/Room/Cup_{i}", (i + 0.2, 0.2, 0.5), (0.1, 0.1, 0.1)), "Cup") for i in range(4)]
    shown = contents(draw_room(open_store(build_graph(home_tbox, [*cupboards, *cups])), "units"))
    assert [text.split(" | ")[0] for text in shown if "carcass" in text] == [f"unit_{i}/carcass" for i in range(4)]
