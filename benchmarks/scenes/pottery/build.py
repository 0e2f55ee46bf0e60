"""Write the stage of the pottery school, from meshes by formula.

Usage: python -m benchmarks.scenes.pottery.build [-o FILE]
"""

import argparse
from pathlib import Path

from benchmarks.scenes.pottery.building import build_house
from benchmarks.scenes.pottery.drying import build_drying
from benchmarks.scenes.pottery.glaze import build_glaze_kitchen
from benchmarks.scenes.pottery.hall import build_hall
from benchmarks.scenes.pottery.kiln import build_kiln_room
from benchmarks.scenes.pottery.shop import build_shop
from benchmarks.scenes.pottery.stage import Pottery
from benchmarks.scenes.pottery.wash import build_wash_area

__all__ = ["STAGE", "build"]

STAGE = Path(__file__).parent / "pottery.usdc"


def build(out: Path) -> list[str]:
    """Write the stage; return the prim paths of its objects."""
    pottery = Pottery(out)
    build_house(pottery)
    build_hall(pottery)
    build_drying(pottery)
    build_glaze_kitchen(pottery)
    build_kiln_room(pottery)
    build_wash_area(pottery)
    build_shop(pottery)
    pottery.stage.Save()
    return pottery.things


def main() -> None:
    """Write the stage and print the number of its objects."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("-o", dest="out", type=Path, default=STAGE, help="stage to write (default: %(default)s)")
    out = parser.parse_args().out
    print(f"{out}: {len(build(out))} objects")


if __name__ == "__main__":
    main()
