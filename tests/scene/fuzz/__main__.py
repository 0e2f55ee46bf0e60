"""Fuzz tests: small files are mutated at random and used in child processes.

`python -m tests.scene.fuzz --seconds 600 [--seed 1] [--what stages|chain|inputs] [--keep DIR]` prints the seed and the
number of files per outcome, and returns 1 if usd2kg failed to return a result or an error of one line, in time and
without output. Crashes and endless loops of OpenUSD itself are counted separately. The same seed gives the same files.
"""

import argparse
import random
import sys
from pathlib import Path

from tests.scene.fuzz.inputs import input_cases
from tests.scene.fuzz.loop import all_cases, fuzz, scaled_cases
from tests.scene.fuzz.worker import CHECK_CHAIN, CHECK_INPUT, READ_STAGE

KINDS = {
    "stages": (all_cases, READ_STAGE),
    "chain": (scaled_cases, CHECK_CHAIN),
    "inputs": (input_cases, CHECK_INPUT),
}
"""What is fuzzed → the cases, and what is done with them."""


def main() -> int:
    """Run the fuzz tests; return 1 if usd2kg failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.scene.fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600, help="duration of each kind (default: 600)")
    parser.add_argument("--seed", type=int, help="the same seed gives the same files (default: a random one)")
    parser.add_argument(
        "--what", choices=KINDS, action="append", help="stages, chain or inputs; repeatable (default: all)"
    )
    parser.add_argument("--keep", type=Path, help="folder for the files of failing cases")
    arguments = parser.parse_args()
    seed = random.SystemRandom().randrange(1 << 32) if arguments.seed is None else arguments.seed
    has_failed = False
    for kind in arguments.what or KINDS:
        print(f"{kind}: seed {seed}", flush=True)
        make, examine = KINDS[kind]
        tally = fuzz(make(seed), arguments.seconds, examine)
        print(tally, flush=True)
        if arguments.keep:
            tally.keep(arguments.keep)
        has_failed |= bool(tally.failures)
    return int(has_failed)


if __name__ == "__main__":
    sys.exit(main())
