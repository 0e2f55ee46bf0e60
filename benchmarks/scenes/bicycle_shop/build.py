"""Write the stage of the bicycle shop, from primitives and meshes by formula.

Usage: python -m benchmarks.scenes.bicycle_shop.build [-o FILE]
"""

import argparse
from pathlib import Path

from benchmarks.scenes.bicycle_shop.building import build_house
from benchmarks.scenes.bicycle_shop.cafe import build_cafe
from benchmarks.scenes.bicycle_shop.office import build_office
from benchmarks.scenes.bicycle_shop.stage import Shop
from benchmarks.scenes.bicycle_shop.store import build_store
from benchmarks.scenes.bicycle_shop.workbench import build_bench, build_tool_cabinet
from benchmarks.scenes.bicycle_shop.workshop import build_workshop

__all__ = ["STAGE", "build"]

STAGE = Path(__file__).parent / "bicycle_shop.usdc"


def build(out: Path) -> list[str]:
    """Write the stage; return the prim paths of its objects."""
    shop = Shop(out)
    build_house(shop)
    build_bench(shop)
    build_tool_cabinet(shop)
    build_workshop(shop)
    build_office(shop)
    build_store(shop)
    build_cafe(shop)
    shop.stage.Save()
    return shop.things


def main() -> None:
    """Write the stage and print the number of its objects."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("-o", dest="out", type=Path, default=STAGE, help="stage to write (default: %(default)s)")
    out = parser.parse_args().out
    print(f"{out}: {len(build(out))} objects")


if __name__ == "__main__":
    main()
