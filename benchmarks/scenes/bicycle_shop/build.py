"""Write the stage of the bicycle shop, from primitives and meshes by formula.

Usage: python -m benchmarks.scenes.bicycle_shop.build [-o FILE]
"""

from pathlib import Path

from benchmarks.scenes.bicycle_shop.building import build_house
from benchmarks.scenes.bicycle_shop.cafe import build_cafe
from benchmarks.scenes.bicycle_shop.office import build_office
from benchmarks.scenes.bicycle_shop.stage import Shop
from benchmarks.scenes.bicycle_shop.store import build_store
from benchmarks.scenes.bicycle_shop.workbench import build_bench, build_tool_cabinet
from benchmarks.scenes.bicycle_shop.workshop import build_workshop
from benchmarks.scenes.command import run_command

__all__ = ["STAGE", "build"]

STAGE = Path(__file__).parent / "bicycle_shop.usdc"


def build(out: Path) -> int:
    """Write the stage; return the number of its objects."""
    shop = Shop(out)
    build_house(shop)
    build_bench(shop)
    build_tool_cabinet(shop)
    build_workshop(shop)
    build_office(shop)
    build_store(shop)
    build_cafe(shop)
    shop.stage.Save()
    return len(shop.things)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_command(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
