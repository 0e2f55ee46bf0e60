"""Fuzz test of the stage reader: small stages are mutated at random and read in child processes.

`python -m tests.scene.fuzz --seconds 600 --seed 1 [--keep DIR]` prints the number of stages per outcome and returns 1
if the reader failed to return a valid Scene or a SceneError of one line, in time and without output. Crashes and
endless loops of OpenUSD itself are counted separately. The same seed gives the same files.
"""

import argparse
import sys
from pathlib import Path

from tests.scene.fuzz.loop import all_cases, fuzz


def main() -> int:
    """Run the fuzz test; return 1 if the reader failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.scene.fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600, help="duration (default: 600)")
    parser.add_argument("--seed", type=int, default=1, help="the same seed gives the same files (default: 1)")
    parser.add_argument("--keep", type=Path, help="folder for the files of failing cases")
    arguments = parser.parse_args()
    tally = fuzz(all_cases(arguments.seed), arguments.seconds)
    print(tally)
    if arguments.keep:
        tally.keep(arguments.keep)
    return 1 if tally.failures else 0


if __name__ == "__main__":
    sys.exit(main())
