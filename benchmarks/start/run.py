"""Time commands on a small scene as processes, start included, against opening the stage with OpenUSD.

Usage: python -m benchmarks.start.run [--turns N] [STAGE]

All commands run in turn, so that the ratio of one turn is under one load. Seconds are processor time. The default stage
is the house with 87 objects in ../shared.
"""

import argparse
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.labelled_scenes import SHARED

STAGE = SHARED / "scenes/aws_robomaker/small_house.usdc"
PROGRAM = (sys.executable, "-m", "usd2kg")
QUESTION = "what is on the table?"


def commands(stage: Path, graph: Path) -> dict[str, tuple[str, ...]]:
    """Return the commands, the yardstick first."""
    opening = f"from pxr import Usd; Usd.Stage.Open({str(stage)!r})"
    return {
        "open the stage": (sys.executable, "-c", opening),
        "--help": (*PROGRAM, "--help"),
        "build": (*PROGRAM, "build", str(stage), "-o", str(graph)),
        "ground": (*PROGRAM, "ground", str(stage)),
        "query": (*PROGRAM, "query", str(graph), "on table"),
        "ask": (*PROGRAM, "ask", str(graph), QUESTION),
    }


def processor_time(command: tuple[str, ...]) -> float:
    """Return the seconds of processor time that a command takes; its exit code does not matter."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main() -> None:
    """Print a table of the medians, after a turn that is not counted."""
    parser = argparse.ArgumentParser(description="Time commands on a small scene, start included.")
    parser.add_argument("stage", nargs="?", type=Path, default=STAGE)
    parser.add_argument("--turns", type=int, default=7)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        timed = commands(options.stage, Path(folder) / "graph.ttl")
        turns = [[processor_time(command) for command in timed.values()] for _ in range(options.turns + 1)][1:]
    print("| command | seconds | ratio |\n| --- | --- | --- |")
    for name, seconds in zip(timed, zip(*turns, strict=True), strict=True):
        ratios = [one / turn[0] for one, turn in zip(seconds, turns, strict=True)]
        print(f"| {name} | {statistics.median(seconds):.2f} | {statistics.median(ratios):.1f} |")


if __name__ == "__main__":
    main()
