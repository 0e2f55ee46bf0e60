"""Write the stage of the salon, from shapes by formula and models of the Debian package sweethome3d-furniture.

Usage: apt-get install sweethome3d-furniture
       python -m benchmarks.scenes.salon.build [-o FILE] [--models FOLDER]

The models may not be part of the repository.
"""

from pathlib import Path

from benchmarks.scenes.salon.back import build_back_room
from benchmarks.scenes.salon.front import build_front
from benchmarks.scenes.salon.kitchenette import build_kitchenette
from benchmarks.scenes.salon.rooms import build_rooms
from benchmarks.scenes.salon.shop import build_shop
from benchmarks.scenes.salon.stage import Salon, write
from benchmarks.scenes.salon.stations import build_stations
from benchmarks.scenes.salon.toilet import build_toilet
from benchmarks.scenes.sweet_home import DEFAULT_MODELS, run_build

__all__ = ["COMMAND", "STAGE", "build", "furnish"]

STAGE = Path(__file__).parent / "salon.usdc"
"""Where the stage is written by default; git ignores it."""
COMMAND = "apt-get install sweethome3d-furniture && python -m benchmarks.scenes.salon.build"
"""How to write it."""


def furnish(models: Path = DEFAULT_MODELS) -> Salon:
    """Return all objects at their poses, with the models of the `.sh3f` files of a folder.

    Raises `ModelError` if a library or a model is missing.
    """
    salon = Salon(models)
    build_rooms(salon)
    build_shop(salon)
    build_stations(salon)
    build_front(salon)
    build_kitchenette(salon)
    build_back_room(salon)
    build_toilet(salon)
    return salon


def build(out: Path, models: Path = DEFAULT_MODELS) -> int:
    """Write the stage and its assets; return the number of its objects."""
    salon = furnish(models)
    write(salon, out)
    return len(salon.objects)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_build(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
