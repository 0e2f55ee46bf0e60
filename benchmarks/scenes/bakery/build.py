"""Write the stage of the bakery, from gprims and meshes by formula.

Usage: python -m benchmarks.scenes.bakery.build [-o FILE]
"""

from pathlib import Path

from benchmarks.scenes.bakery.bakehouse import build_bakehouse
from benchmarks.scenes.bakery.bread import build_bread_wall, build_coffee
from benchmarks.scenes.bakery.building import build_shell
from benchmarks.scenes.bakery.cafe import build_cafe, build_shop_walls
from benchmarks.scenes.bakery.counter import build_counter
from benchmarks.scenes.bakery.layout import new_stage, save
from benchmarks.scenes.bakery.office import build_office
from benchmarks.scenes.bakery.store import build_store
from benchmarks.scenes.bakery.washroom import build_washroom
from benchmarks.scenes.bakery.worktable import build_worktable
from benchmarks.scenes.command import run_command

__all__ = ["STAGE", "build"]

STAGE = Path(__file__).parent / "bakery.usdc"


def build(out: Path) -> int:
    """Write the stage; return the number of its objects."""
    world = new_stage()
    build_shell(world)
    shop = world.area("Shop")
    build_counter(shop)
    build_bread_wall(shop)
    build_coffee(shop)
    build_cafe(shop)
    build_shop_walls(shop)
    house = world.area("Bakehouse")
    build_bakehouse(house)
    build_worktable(house)
    build_store(world)
    build_office(world)
    build_washroom(world)
    return save(world, out)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_command(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
