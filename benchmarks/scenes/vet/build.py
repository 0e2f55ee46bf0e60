"""Write the stage of the veterinary practice, from gprims and meshes by formula.

Usage: python -m benchmarks.scenes.vet.build [-o FILE]
"""

from pathlib import Path

from benchmarks.scenes.command import run_command
from benchmarks.scenes.vet.building import build_shell
from benchmarks.scenes.vet.cabinets import build_cabinets
from benchmarks.scenes.vet.consult import build_consult
from benchmarks.scenes.vet.kennels import build_kennels
from benchmarks.scenes.vet.kitchen import build_kitchen
from benchmarks.scenes.vet.reception import build_reception
from benchmarks.scenes.vet.shop import build_shop
from benchmarks.scenes.vet.stage import Practice, write
from benchmarks.scenes.vet.stores import build_stores
from benchmarks.scenes.vet.theatre import build_theatre

__all__ = ["STAGE", "build", "furnish"]

STAGE = Path(__file__).parent / "vet.usdc"


def furnish() -> Practice:
    """Return all objects at their places."""
    practice = Practice()
    build_shell(practice)
    build_reception(practice)
    build_shop(practice)
    build_consult(practice)
    build_cabinets(practice)
    build_theatre(practice)
    build_stores(practice)
    build_kennels(practice)
    build_kitchen(practice)
    return practice


def build(out: Path) -> int:
    """Write the stage; return the number of its objects."""
    practice = furnish()
    write(practice, out)
    return len(practice.objects)


def main() -> None:
    """Write the stage and print the number of its objects."""
    run_command(__doc__ or "", STAGE, build)


if __name__ == "__main__":
    main()
