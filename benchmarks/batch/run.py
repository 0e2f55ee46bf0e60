"""Measure many small scenes: a shell loop, one process, and usd2kg batch.

Usage: python -m benchmarks.batch.run [--scenes 1000] [--loop 20]

Each scene is a flat with furniture. The loop is measured on fewer scenes, since each takes as long as any other.
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from benchmarks.scale.stage import write_place
from usd2kg.scene import read_scene

OBJECTS = 60


def seconds_of(command: Sequence[str]) -> tuple[float, float]:
    """Return wall and processor time of a command, children included."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run([sys.executable, "-m", "usd2kg", *command], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.perf_counter() - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=1000)
    parser.add_argument("--loop", type=int, default=20, help="scenes of the shell loop")
    parser.add_argument("--ray", action="store_true", help="also on a local Ray cluster")
    asked = parser.parse_args()
    cores = len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        scenes = [folder / "scenes" / f"{number:05}.usda" for number in range(asked.scenes)]
        first = scenes[0]
        first.parent.mkdir()
        write_place(first, "flats", OBJECTS)
        pattern = str(first.parent / "*.usda")
        for scene in scenes[1:]:
            shutil.copyfile(first, scene)
        print(f"{asked.scenes} scenes of {len(read_scene(first).objects)} objects, {cores} cores")
        loop = scenes[: asked.loop]
        start = time.perf_counter()
        for scene in loop:
            seconds_of(["build", str(scene), "-o", str(folder / "loop.ttl")])
        each = (time.perf_counter() - start) / len(loop)
        rows = [("shell loop", each * len(scenes))]
        one = seconds_of(["build", *map(str, scenes), "-o", str(folder / "one")])[0]
        rows.append(("one process", one))
        for workers in sorted({1, cores}):
            out = str(folder / f"batch{workers}")
            command = ["batch", pattern, "-o", out, "--workers", str(workers)]
            rows.append((f"batch, {workers} workers", seconds_of(command)[0]))
            rows.append((f"batch, {workers} workers, again", seconds_of(command)[0]))
        if asked.ray:
            command = ["batch", pattern, "-o", str(folder / "ray"), "--ray", "--workers", str(cores)]
            rows.append((f"Ray, {cores} actors", seconds_of(command)[0]))
        print("| | seconds | scenes an hour | shell loop = 1 | one process = 1 |\n| --- | --- | --- | --- | --- |")
        for name, seconds in rows:
            rate, ratio = 3600 * len(scenes) / seconds, rows[0][1] / seconds
            print(f"| {name} | {seconds:.1f} | {rate:,.0f} | {ratio:.1f} | {one / seconds:.2f} |")


if __name__ == "__main__":
    main()
