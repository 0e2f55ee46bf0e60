"""Measure the seconds from `pip install` to the first answer, for each format of scenes.

Usage: python -m benchmarks.install.run dist/usd2kg-*.whl

For each format, an empty environment gets the wheel with the extra that reads the format (and the converter, in an
environment of its own); then a small table with a cup is built into a graph and asked what is on the table. pip's cache
of downloads is used as it is; byte code is compiled as pip does.
"""

import os
import subprocess
import sys
import tempfile
import time
import venv
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from tests.convert.test_robots import DRAWERS, TABLE

SDF = """<sdf version="1.9"><world name="room">
  <model name="table"><static>true</static><pose>0 0 0.375 0 0 0</pose><link name="link"><visual name="top">
    <geometry><box><size>1.2 0.8 0.75</size></box></geometry></visual></link></model>
  <model name="cup"><pose>0 0 0.8 0 0 0</pose><link name="link"><visual name="body">
    <geometry><cylinder><radius>0.04</radius><length>0.1</length></cylinder></geometry></visual></link></model>
</world></sdf>
"""
USD = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Room"
{
    def Xform "table" (kind = "component")
    {
        def Cube "top"
        {
            double size = 1
            double3 xformOp:translate = (0, 0, 0.375)
            double3 xformOp:scale = (1.2, 0.8, 0.75)
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
        }
    }
    def Xform "cup" (kind = "component")
    {
        def Cube "body"
        {
            double size = 0.1
            double3 xformOp:translate = (0, 0, 0.8)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
}
"""


class Format(NamedTuple):
    """How a format is measured."""

    name: str
    file: str
    write: Callable[[Path], object]
    extra: str = ""
    converter: str = ""
    """Package of the program that converts the format."""
    question: str = "what is on the table?"


def text(content: str) -> Callable[[Path], object]:
    """Return a function that writes a text."""
    return lambda path: path.write_text(content, "utf-8")


def write_glb(path: Path) -> None:
    """Write a glTF file, whose up axis is y."""
    import trimesh  # noqa: PLC0415

    scene = trimesh.Scene()
    for name, size, height in (("table", (1.2, 0.75, 0.8), 0.375), ("cup", (0.08, 0.1, 0.08), 0.8)):
        move = trimesh.transformations.translation_matrix((0, height, 0))
        scene.add_geometry(trimesh.creation.box(size), name, name, transform=move)
    scene.export(path)


def write_ifc(path: Path) -> None:
    """Write an IFC file."""
    from tests.convert.test_ifc import House  # noqa: PLC0415 - needs IfcOpenShell

    house = House()
    house.put(house.add("IfcFurniture", "Table", (0, 0, 0), (1.2, 0.8, 0.75)), house.storey)
    house.put(house.add("IfcFurniture", "Cup", (0.5, 0.4, 0.75), (0.08, 0.08, 0.1)), house.storey)
    house.save(path)


FORMATS = (
    Format("USD", "room.usda", text(USD)),
    Format("glTF", "room.glb", write_glb, "convert"),
    Format("SDF", "room.sdf", text(SDF), "sdf"),
    Format("IFC", "room.ifc", write_ifc, "ifc"),
    Format("MJCF", "room.xml", text(TABLE), converter="mujoco-usd-converter"),
    Format("URDF", "table.urdf", text(DRAWERS), converter="urdf-usd-converter", question="what can be opened?"),
)


def main() -> None:
    """Measure all formats and print a table."""
    wheel = Path(sys.argv[1]).absolute()
    print(f"{'format':<6} {'install s':>9} {'answer s':>9}  answer")
    for entry in FORMATS:
        with tempfile.TemporaryDirectory() as name:
            install, answer, said = measure(entry, wheel, Path(name))
        print(f"{entry.name:<6} {install:>9.1f} {answer:>9.1f}  {said}", flush=True)


def measure(entry: Format, wheel: Path, folder: Path) -> tuple[float, float, str]:
    """Return the seconds of the installation and from then to the answer, and the answer."""
    entry.write(folder / entry.file)
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    start = time.perf_counter()
    wanted = f"{wheel}[{entry.extra}]" if entry.extra else str(wheel)
    programs = [_install(folder / "venv", wanted)]
    if entry.converter:
        programs.append(_install(folder / "converter", entry.converter))
    installed = time.perf_counter()
    environment["PATH"] = os.pathsep.join([*map(str, programs), environment["PATH"]])
    for arguments in (["build", entry.file, "-o", "graph.ttl"], ["ask", "graph.ttl", entry.question]):
        command = [programs[0] / "usd2kg", *arguments]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
        if done.returncode:
            return installed - start, time.perf_counter() - installed, f"FAILED: {done.stderr.strip().splitlines()[-1]}"
    return installed - start, time.perf_counter() - installed, done.stdout.splitlines()[0]


def _install(folder: Path, package: str) -> Path:
    """Install a package in a new environment and return its folder of programs."""
    venv.create(folder, with_pip=True)
    programs = folder / "bin"
    subprocess.run([programs / "python", "-m", "pip", "install", "--quiet", package], check=True, capture_output=True)
    return programs


if __name__ == "__main__":
    main()
