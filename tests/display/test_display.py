"""Records as HTML and as text."""

import struct
from base64 import b64decode
from html.parser import HTMLParser
from pathlib import Path

import pytest
from IPython.core.formatters import DisplayFormatter

import usd2kg
from tests.scene.usda import METRES, box
from usd2kg.assistant import InterpretedAnswer
from usd2kg.display import make_view, pictures, to_html, to_text
from usd2kg.render import draw_thumbnail, thumbnail
from usd2kg.world import World

HOSTILE = "<img src=x onerror=alert(1)>"
ROOM = METRES + "\n".join((box("table", (0, 0, 0.4), (1.2, 0.8, 0.8)), box("cup", (0.2, 0.1, 0.85), (0.1, 0.1, 0.1))))


class Reader(HTMLParser):
    """Collects the elements and texts of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.rows: list[list[str]] = []
        self.text = ""
        self.feed(text)
        assert self.open == [], "every element is closed"

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag != "img":
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        elif tag in {"td", "th"}:
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data
        if self.open and self.open[-1] in {"td", "th"}:
            self.rows[-1][-1] += data

    def pictures(self) -> list[bytes]:
        prefix = "data:image/png;base64,"
        sources = [attributes["src"] or "" for tag, attributes in self.elements if tag == "img"]
        assert all(source.startswith(prefix) for source in sources)
        return [b64decode(source.removeprefix(prefix)) for source in sources]


@pytest.fixture(autouse=True)
def _without_cache():
    pictures._pictures.clear()


@pytest.fixture
def world(write_stage) -> World:
    return usd2kg.open(write_stage(ROOM, "kitchen.usda"))


def test_a_world_shows_a_picture_and_its_objects(world):
    page = Reader(world._repr_html_())
    (picture,) = page.pictures()
    assert struct.unpack(">II", picture[16:24]) == (280, 210)
    assert page.rows[0] == ["class", "name", "confidence", "size in m", "relations"]
    assert [[row[0], row[1], *row[3:]] for row in page.rows[1:]] == [
        ["cup", "cup", "0.10 × 0.10 × 0.10", "on table"],
        ["table", "table", "1.20 × 0.80 × 0.80", ""],
    ]
    assert "kitchen.usda: 2 objects of 2 classes" in page.text
    assert "1 on" in page.text
    assert str(world.source) not in page.text


def test_a_build_result_shows_the_same_objects(world):
    rows = Reader(world.built._repr_html_()).rows
    assert sorted(rows) == sorted(Reader(world._repr_html_()).rows)


def test_a_loaded_graph_shows_boxes(world, tmp_path):
    world.save(tmp_path / "kitchen.ttl")
    page = Reader(usd2kg.open(tmp_path / "kitchen.ttl")._repr_html_())
    assert page.pictures() == Reader(world.graph._repr_html_()).pictures()
    assert "■ cup 1 · ■ table 1" in page.text
    assert page.rows == Reader(world._repr_html_()).rows
    assert "kitchen.ttl: 2 objects, " in page.text


def test_scene_grounding_and_graph(world):
    scene = Reader(world.scene._repr_html_())
    assert "2 objects, 0 joints" in scene.text
    assert scene.rows[1] == ["table", "1.20 × 0.80 × 0.80", "", "", "/table"]
    assert len(scene.pictures()) == 1
    grounding = Reader(world.grounding._repr_html_())
    assert "2 predictions by lexical" in grounding.text
    assert grounding.rows[2][:2] == ["Cup", "cup"]
    assert grounding.pictures() == scene.pictures()
    graph = Reader(world.graph._repr_html_())
    assert ["Cup", "1", "http://www.ease-crc.org/ont/SOMA.owl#Cup"] in graph.rows
    (boxes,) = graph.pictures()
    assert struct.unpack(">II", boxes[16:24]) == (280, 210)
    assert boxes != scene.pictures()[0]
    assert f"{len(world.graph.triples)} triples" in graph.text


def test_answers(world):
    answer = world.ask("what is on the table?")
    asked = Reader(answer._repr_html_())
    assert answer.sentence.startswith("A cup is on the table")
    assert answer.sentence in asked.text
    assert "understood as: things on table" in asked.text
    assert asked.rows[1][:3] == ["cup", "cup", "/cup"]
    found = Reader(world.sparql("SELECT ?p { ?o u2k:primPath ?p } ORDER BY ?p")._repr_html_())
    assert found.rows == [["p"], ["/cup"], ["/table"]]
    assert "2 rows" in found.text


def test_an_answer_without_rows_is_its_sentence(world):
    page = Reader(world.ask("is there a fridge?")._repr_html_())
    assert "No" in page.text
    assert page.rows == []


def test_only_the_first_rows_are_shown(write_stage):
    prims = "\n".join(box(f"cup_{i:02}", (i, 0, 0.1), (0.1, 0.1, 0.1)) for i in range(25))
    world = usd2kg.open(write_stage(METRES + prims))
    for record in (world, world.built, world.scene, world.grounding):
        page = Reader(record._repr_html_())
        assert (len(page.rows), "and 5 more" in page.text) == (21, True)
        assert to_text(record).endswith("and 5 more")


def test_names_of_a_stage_are_escaped(write_stage):
    named = (f'displayName = "{HOSTILE}\\u202e"',)
    prims = box("cup", (0, 0, 0.1), (0.1, 0.1, 0.1), meta=named) + box("table", (0, 0, -0.4), (1.2, 0.8, 0.8))
    world = usd2kg.open(write_stage(METRES + prims, "<b>.usda"))
    assert HOSTILE in world.scene.objects[0].display_name
    answers = [world.sparql("SELECT ?l ?o { ?o u2k:primPath ?p ; rdfs:label ?l }"), world.ask("list all objects")]
    for record in (world, world.built, world.scene, world.grounding, world.graph, *answers):
        page = Reader(record._repr_html_())
        assert {tag for tag, _ in page.elements} <= {"div", "p", "b", "img", "table", "tr", "td", "th", "span"}
        assert not any("onerror" in attributes for _, attributes in page.elements)
        page.pictures()
        assert "\u202e" not in page.text
    assert HOSTILE in Reader(world._repr_html_()).text


def test_a_sentence_is_escaped(world):
    answer = InterpretedAnswer(HOSTILE, world.sparql("ASK {}"), sentence=HOSTILE)
    assert "<img" not in to_html(answer)
    assert "\x1b" not in to_text(InterpretedAnswer("a", world.sparql("ASK {}"), sentence="\x1b[2J"))


def test_ipython_shows_html_and_text_but_not_the_repr(world):
    for record in (world, world.built, world.scene, world.grounding, world.graph, world.sparql("ASK {}")):
        formats, _ = DisplayFormatter().format(record)
        assert set(formats) == {"text/plain", "text/html"}
        assert formats["text/plain"] == to_text(record)
        assert formats["text/html"] == to_html(record)
        assert len(formats["text/plain"]) < 2000
    assert to_text(world).splitlines()[2].split() == ["class", "name", "confidence", "size", "in", "m", "relations"]


def test_ipython_on_a_terminal_draws_nothing(world, monkeypatch):
    monkeypatch.setattr(pictures, "draw_thumbnail", lambda *_: pytest.fail("drawn"))
    formatter = DisplayFormatter()
    formatter.active_types = ["text/plain"]
    assert formatter.format(world)[0] == {"text/plain": to_text(world)}


def test_long_cells_are_cut(world):
    answer = world.sparql(f"SELECT ?x {{ BIND('{'a' * 500}' AS ?x) }}")
    assert Reader(to_html(answer)).rows[1] == ["a" * 79 + "…"]


def test_other_objects_have_no_view():
    with pytest.raises(TypeError, match="no view of int"):
        make_view(3)


# Pictures.


def test_the_picture_is_drawn_once(world, monkeypatch):
    drawn: list[str] = []

    def draw(scene, size) -> bytes:
        drawn.append(scene.source)
        return b"png"

    monkeypatch.setattr(pictures, "draw_thumbnail", draw)
    assert to_html(world) == to_html(world)
    to_html(world.scene)
    assert drawn == [world.source]


def test_few_pictures_are_kept(write_stage, monkeypatch):
    monkeypatch.setattr(pictures, "draw_thumbnail", lambda scene, size: b"png")
    monkeypatch.setattr(pictures, "_MAX_KEPT", 2)
    for number in range(4):
        to_html(usd2kg.read_scene(write_stage(ROOM, f"{number}.usda")))
    assert [Path(key[0]).name for key in pictures._pictures] == ["2.usda", "3.usda"]


def test_a_failure_to_draw_leaves_the_picture_out(world, monkeypatch, caplog):
    def fail(*_: object) -> bytes:
        raise RuntimeError("broken mesh")

    monkeypatch.setattr(pictures, "draw_thumbnail", fail)
    caplog.set_level("INFO", "usd2kg")
    page = Reader(world._repr_html_())
    assert page.pictures() == []
    assert len(page.rows) == 3
    assert "no picture: broken mesh" in caplog.text


@pytest.mark.parametrize("name", ["_MAX_PRIMS", "_MAX_TRIANGLES"])
def test_a_large_scene_is_not_drawn(world, monkeypatch, name):
    monkeypatch.setattr(thumbnail, name, 1)
    assert draw_thumbnail(world.scene, (40, 30)) is None


def test_a_stage_that_has_changed_is_not_drawn(world, write_stage):
    assert draw_thumbnail(world.scene, (40, 30)) is not None
    write_stage(METRES + box("wardrobe", (0, 0, 0), (1, 1, 1)), "kitchen.usda")
    assert draw_thumbnail(world.scene, (40, 30)) is None


def test_a_stage_that_is_gone_is_not_drawn(world):
    Path(world.source).unlink()
    assert Reader(world._repr_html_()).pictures() == []


def test_a_scene_without_geometry_is_not_drawn(write_stage):
    scene = usd2kg.read_scene(write_stage('def Xform "lamp" (kind = "component") {}'), paths=["/lamp"])
    assert draw_thumbnail(scene, (40, 30)) is None


def test_a_grounding_shows_its_stage_alone(world, monkeypatch):
    (picture,) = Reader(world.grounding._repr_html_()).pictures()
    assert [*pictures._pictures] == [(world.grounding.scene, world.grounding.scene_hash)]
    pictures._pictures.clear()
    assert Reader(world.scene._repr_html_()).pictures() == [picture]
    pictures._pictures.clear()
    monkeypatch.setattr(pictures, "_MAX_PREDICTIONS", 1)
    assert Reader(world.grounding._repr_html_()).pictures() == []


def test_a_grounding_of_a_changed_stage_has_no_picture(world, write_stage):
    write_stage(METRES + box("wardrobe", (0, 0, 0), (1, 1, 1)), "kitchen.usda")
    assert Reader(world.grounding._repr_html_()).pictures() == []


def test_a_large_graph_is_not_drawn(world, monkeypatch, tmp_path):
    world.save(tmp_path / "g.ttl")
    loaded = usd2kg.open(tmp_path / "g.ttl")
    monkeypatch.setattr(pictures, "MAX_BOXES", 1)
    for record in (world.graph, loaded):
        page = Reader(record._repr_html_())
        assert page.pictures() == []
        assert "■" not in page.text


def test_a_graph_without_boxes_is_not_drawn(write_stage):
    path = write_stage('def Xform "lamp" (kind = "component") {}')
    graph = usd2kg.build(path, paths=["/lamp"]).graph
    assert Reader(graph._repr_html_()).pictures() == []


def test_labels_of_a_legend_are_escaped(world, monkeypatch):
    picture = pictures.Picture(b"png", HOSTILE, (("#ff0000", HOSTILE + "\u202e", 3),))
    monkeypatch.setattr("usd2kg.display.html.draw_picture", lambda _: picture)
    text = world.graph._repr_html_()
    page = Reader(text)
    assert [attributes["alt"] for tag, attributes in page.elements if tag == "img"] == [HOSTILE]
    assert f"■ {HOSTILE}\ufffd 3" in page.text
    assert HOSTILE not in text
