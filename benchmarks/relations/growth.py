"""Fit how the time of the default relations grows with the number of objects, in rooms and in dense heaps.

Usage: python -m benchmarks.relations.growth [OBJECTS...] (default 1000 4000 16000 64000 100000)

Seconds are processor time, one run each. The last slope is that between the two largest scenes; 1 is linear.
"""

import gc
import math
import sys
import time

from benchmarks.relations.run import exponent, make_scene
from usd2kg.ontology import load_home_tbox
from usd2kg.relations import find_relations

LAYOUTS = ("boxes", "pile", "tower")


def main() -> None:
    """Measure and print a table."""
    sizes = [int(argument) for argument in sys.argv[1:]] or [1_000, 4_000, 16_000, 64_000, 100_000]
    tbox = load_home_tbox()
    print(
        "| scene | " + " | ".join(f"{size:,} objects, s" for size in sizes) + " | exponent | last slope | relations |"
    )
    print("| --- |" + " --- |" * (len(sizes) + 3))
    for layout in LAYOUTS:
        seconds, count = [], 0
        for size in sizes:
            scene, grounding = make_scene(size, tbox, layout)
            gc.collect()
            start = time.process_time()
            count = len(find_relations(scene, tbox, grounding))
            seconds.append(time.process_time() - start)
        last = math.log(seconds[-1] / seconds[-2]) / math.log(sizes[-1] / sizes[-2])
        row = " | ".join(f"{value:.3g}" for value in seconds)
        print(f"| {layout} | {row} | {exponent(sizes, seconds):.2f} | {last:.2f} | {count:,} |", flush=True)


if __name__ == "__main__":
    main()
