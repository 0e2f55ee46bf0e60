"""Write the stage of the hotel floor, from gprims and meshes by formula.

Usage: python -m benchmarks.scenes.hotel.build [-o FILE]
"""

from pathlib import Path

from benchmarks.scenes.command import run_command
from benchmarks.scenes.hotel.bathroom import build_bathroom
from benchmarks.scenes.hotel.bed import build_bed
from benchmarks.scenes.hotel.buffet import build_buffet
from benchmarks.scenes.hotel.building import build_corridor, build_shell
from benchmarks.scenes.hotel.desk import build_desk, build_minibar
from benchmarks.scenes.hotel.kitchen import build_kitchen
from benchmarks.scenes.hotel.linen import build_linen_room
from benchmarks.scenes.hotel.living import build_living
from benchmarks.scenes.hotel.stage import Hotel, write
from benchmarks.scenes.hotel.trolley import build_trolley
from benchmarks.scenes.hotel.wardrobe import build_wardrobe

__all__ = ["STAGE", "build", "furnish"]

STAGE = Path(__file__).parent / "hotel.usdc"


def furnish() -> Hotel:
    """Return all objects at their places."""
    hotel = Hotel()
    build_shell(hotel)
    build_corridor(hotel)
    hotel.group("guest_room")
    build_bed(hotel)
    build_wardrobe(hotel)
    build_desk(hotel)
    build_minibar(hotel)
    build_living(hotel)
    build_bathroom(hotel)
    build_trolley(hotel)
    build_linen_room(hotel)
    build_kitchen(hotel)
    build_buffet(hotel)
    return hotel


def build(out: Path) -> int:
    """Write the stage; return the number of its objects."""
    hotel = furnish()
    write(hotel, out)
    return len(hotel.objects)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_command(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
