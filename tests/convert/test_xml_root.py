"""The format of an XML file follows from its root element."""

from pathlib import Path

import pytest

from usd2kg.convert import SourceFormat, find_format, formats, is_stage
from usd2kg.convert.write import convert_file
from usd2kg.convert.xml_root import read_root_tag
from usd2kg.errors import SceneError
from usd2kg.scene import read_scene

BOMB = """<?xml version="1.0"?>
<!DOCTYPE mujoco [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>
<mujoco model="&b;"/>
"""


def write(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


@pytest.mark.parametrize(
    ("text", "tag"),
    [
        ("<mujoco/>", "mujoco"),
        ("\n<?xml version='1.0'?>\n<!-- a licence -->\n<mujoco model='arm'>", "mujoco"),
        ("\ufeff<mujoco/>", "mujoco"),
        ("<mujoco>".encode("utf-16"), "mujoco"),
        ("<!DOCTYPE mujoco><mujoco/>", "mujoco"),
        (f"<!--{'x' * 300_000}--><mujoco/>", "mujoco"),
        ("<mujocoinclude/>", "mujocoinclude"),
        ("<package><mujoco/></package>", "package"),
        ("<a:mujoco xmlns:a='x'/>", "a:mujoco"),
        ("", None),
        ("mujoco", None),
        ("<!-- <mujoco/> -->", None),
        (BOMB, None),
        ('<!DOCTYPE m [<!ENTITY x SYSTEM "other.xml">]><mujoco/>', None),
        (f"<!--{'x' * 2_000_000}--><mujoco/>", None),
        ("<?xml version='1.0' encoding='no-such'?><mujoco/>", None),
        (b"\0" * 100, None),
    ],
)
def test_root_elements(tmp_path: Path, text: str | bytes, tag: str | None):
    assert read_root_tag(write(tmp_path / "a.xml", text)) == tag


def test_only_the_beginning_is_read(tmp_path: Path):
    assert read_root_tag(write(tmp_path / "a.xml", "<mujoco>" + " " * 100_000 + "<<<")) == "mujoco"


def test_a_file_that_cannot_be_read_has_none(tmp_path: Path):
    assert read_root_tag(tmp_path) is None
    assert read_root_tag(tmp_path / "missing.xml") is None


def test_mjcf_is_a_stage_and_other_xml_is_not(tmp_path: Path):
    assert is_stage(write(tmp_path / "arm.xml", "<mujoco/>"))
    assert not is_stage(write(tmp_path / "package.xml", "<package/>"))
    # What is wrong with a missing file is said where it is read.
    assert find_format(tmp_path / "missing.xml") is not None


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("<package/>", "the root element <package>"),
        ("<mujocoinclude/>", "the root element <mujocoinclude>"),
        ("nothing", "no root element"),
        (BOMB, "no root element"),
    ],
)
def test_other_xml_is_refused(tmp_path: Path, text: str, found: str):
    path = write(tmp_path / "note.xml", text)
    message = rf"has {found}, expected <mujoco> \(MJCF\); name the file of the whole model"
    with pytest.raises(SceneError, match=message):
        read_scene(path)
    with pytest.raises(SceneError, match=message):
        convert_file(path, tmp_path / "note.usdc")


def test_formats_share_an_ending(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    building = SourceFormat("gbXML", (".xml",), "gbxml", "pip install gbxml", "gbXML")
    monkeypatch.setattr(formats, "FORMATS", (*formats.FORMATS, building))
    assert find_format(write(tmp_path / "house.xml", "<gbXML/>")) == building
    assert find_format(write(tmp_path / "arm.xml", "<mujoco/>")).name == "MJCF"
    with pytest.raises(SceneError, match=r"expected <mujoco> \(MJCF\) or <gbXML> \(gbXML\)"):
        convert_file(write(tmp_path / "note.xml", "<note/>"), tmp_path / "note.usdc")
