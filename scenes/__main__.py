"""Write the scenes: `python -m scenes [NAME …] [--out FOLDER]`."""

import argparse
from importlib import import_module
from pathlib import Path

FOLDERS = {
    "kitchen": Path("src/usd2kg/demo/kitchen"),
    "office": Path("benchmarks/scenes/office"),
    "warehouse": Path("benchmarks/scenes/warehouse"),
    "flat": Path("benchmarks/scenes/flat"),
}
"""Where the scenes are kept, relative to the root of the repository."""


def main() -> None:
    """Write the named scenes."""
    parser = argparse.ArgumentParser(prog="python -m scenes", description="Write scenes from their scripts.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(FOLDERS)}; default: all")
    parser.add_argument("--out", type=Path, help="folder for one scene; default: where the repository keeps it")
    args = parser.parse_args()
    names = args.names or list(FOLDERS)
    if unknown := [name for name in names if name not in FOLDERS]:
        parser.error(f"unknown scene {unknown[0]!r}; expected one of {', '.join(FOLDERS)}")
    if args.out and len(names) != 1:
        parser.error("--out needs exactly one scene")
    for name in names:
        folder = args.out or FOLDERS[name]
        print(f"{folder}: {import_module(f'scenes.{name}').write(folder)}")


if __name__ == "__main__":
    main()
