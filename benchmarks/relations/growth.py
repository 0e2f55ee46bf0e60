"""Fit how the time of the default relations grows with the number of objects, in rooms and in dense heaps.

Usage: python -m benchmarks.relations.growth [--plot FILE.png] [OBJECTS...] (default 1000 4000 16000 64000 100000)

Seconds are processor time, one run each. The last slope is that between the two largest scenes; 1 is linear.
"""

import argparse
import gc
import math
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from benchmarks.relations.run import exponent, make_scene
from usd2kg.ontology import load_home_tbox
from usd2kg.relations import find_relations

LAYOUTS = ("boxes", "pile", "tower")


def measure(sizes: Sequence[int]) -> dict[str, list[float]]:
    """Print a table, and return layout → seconds at each size."""
    tbox = load_home_tbox()
    found: dict[str, list[float]] = {}
    columns = " | ".join(f"{size:,} objects, s" for size in sizes)
    print(f"| scene | {columns} | exponent | last slope | relations |")
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
        print(f"| {layout} | {row} | {exponent(list(sizes), seconds):.2f} | {last:.2f} | {count:,} |", flush=True)
        found[layout] = seconds
    return found


def draw(sizes: Sequence[int], seconds: Mapping[str, Sequence[float]], path: Path) -> None:
    """Write a plot of seconds over objects with logarithmic axes, beside linear growth."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only for --plot

    figure = Figure(figsize=(6, 4), layout="constrained")
    axes = figure.add_subplot()
    for layout, values in seconds.items():
        label = f"{layout}: exponent {exponent(list(sizes), list(values)):.2f}"
        axes.plot(sizes, values, marker="o", label=label)
    first = min(values[0] for values in seconds.values())
    axes.plot(sizes, [first * size / sizes[0] for size in sizes], "--", color="grey", label="linear")
    axes.set(xscale="log", yscale="log", xlabel="objects", ylabel="processor time, s", title="Default relations")
    axes.grid(visible=True, which="major", alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=120)


def main() -> None:
    """Measure, print a table, and draw."""
    parser = argparse.ArgumentParser(description="Fit how the time of the default relations grows.")
    parser.add_argument("objects", nargs="*", type=int, default=[1_000, 4_000, 16_000, 64_000, 100_000])
    parser.add_argument("--plot", type=Path, help="PNG to write.")
    arguments = parser.parse_args()
    seconds = measure(arguments.objects)
    if arguments.plot is not None:
        draw(arguments.objects, seconds, arguments.plot)


if __name__ == "__main__":
    main()
