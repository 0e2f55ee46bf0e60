"""Write the stage of the pottery school, from meshes by formula.

Usage: python -m benchmarks.scenes.pottery.build [-o FILE]
"""

from pathlib import Path

from benchmarks.scenes.command import run_command
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


def build(out: Path) -> int:
    """Write the stage; return the number of its objects."""
    pottery = Pottery(out)
    build_house(pottery)
    build_hall(pottery)
    build_drying(pottery)
    build_glaze_kitchen(pottery)
    build_kiln_room(pottery)
    build_wash_area(pottery)
    build_shop(pottery)
    pottery.stage.Save()
    return len(pottery.things)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_command(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
