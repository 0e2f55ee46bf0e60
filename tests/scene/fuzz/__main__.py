"""A fuzz test of the stage reader: small stages are mangled at random and read, each in a child process.

`python -m tests.scene.fuzz --seconds 600 --seed 1 [--keep DIR]` prints what happened to how many stages and
returns 1 if the reader broke its promise: a sane Scene or a SceneError of one line, in time and in silence. Mangled
files may crash OpenUSD itself, or keep it busy for ever; this is counted apart. The same seed makes the same files.
"""

import argparse
import sys
from pathlib import Path

from tests.scene.fuzz.loop import all_cases, fuzz


def main() -> int:
    """Fuzz for a while; return 1 if the reader did something wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.scene.fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600, help="how long (default: 600)")
    parser.add_argument("--seed", type=int, default=1, help="same seed, same files (default: 1)")
    parser.add_argument("--keep", type=Path, help="folder for the files of all faults")
    arguments = parser.parse_args()
    tally = fuzz(all_cases(arguments.seed), arguments.seconds)
    print(tally)
    if arguments.keep:
        tally.keep(arguments.keep)
    return 1 if tally.failures else 0


if __name__ == "__main__":
    sys.exit(main())
