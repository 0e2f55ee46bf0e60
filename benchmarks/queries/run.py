"""Time questions about large graphs from the shell: the first one, which indexes the file, and the next ones.

Usage: python benchmarks/queries/run.py [OBJECTS...]

The graphs are those of the furnished flats in `benchmarks/scale`; the default is 1000, 10000 and 100000 objects.
Seconds are wall time, start of the process included.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "scale"))
from stage import write_place

COMMAND = (sys.executable, "-m", "usd2kg")
GIVEN = {"class": "cup", "position": "1 1 1"}
ASKED = (
    "how many objects are there?",
    "how many cups are there?",
    "where is X?",
    "what is on X?",
    "what is on the table?",
    "list all kettles",
    "is there a piano?",
)
FLOOR = """
import sys, pyoxigraph as ox
store = ox.Store.read_only(sys.argv[1])
print(len(list(store.query("SELECT ?s { ?s <https://w3id.org/usd2kg#primPath> '" + sys.argv[2] + "' }"))))
"""
"""What no question can do without: Python, the engine, and one lookup in the index."""
THING = "SELECT ?p { ?x u2k:on|soma:isOntopOf ?o . ?o u2k:primPath ?p } ORDER BY ?p LIMIT 1"


def main() -> None:
    """Measure and print a table for each size."""
    parser = argparse.ArgumentParser(description="Time questions about large graphs.")
    parser.add_argument("objects", nargs="*", type=int, default=[1_000, 10_000, 100_000])
    for count in parser.parse_args().objects:
        with tempfile.TemporaryDirectory() as folder:
            os.environ["USD2KG_GRAPH_CACHE"] = str(Path(folder) / "cache")
            measure(Path(folder), count)


def measure(folder: Path, count: int) -> None:
    """Build one graph and time what is asked about it."""
    stage, graph, store = folder / "flats.usdc", folder / "flats.ttl", folder / "store"
    write_place(stage, "flats", count)
    run("build", stage, "-o", graph)
    print(f"\n{count} objects, {graph.stat().st_size / 1e6:.0f} MB of Turtle", flush=True)
    seconds, text = run("query", graph, "--sparql", THING)
    report("the first question, which indexes the file", seconds)
    thing = text.splitlines()[1].strip()
    for words in (["on", thing], ["where", "is", thing], ["near", thing], ["all", "of", "kettle"], ["in", "kettle"]):
        shown = " ".join("X" if word == thing else word for word in words)
        report(shown, run("query", graph, *words)[0])
    for question, parameters in list_questions():
        given = [f"{name}={GIVEN.get(name, thing)}" for name in parameters]
        options = [option for value in given for option in ("--with", value)]
        report(f"--question {question}", run("query", graph, "--question", question, *options)[0])
    report("floor: start Python", time_python("pass"))
    (index,) = (folder / "cache").glob("*/index")
    report("floor: open the index and look X up", time_python(FLOOR, str(index), thing))
    report_asked(graph, thing, "")
    report("serve, until it answers", time_serving(graph))
    report("store load", run("store", "load", graph, "--store", store)[0])
    report("on X, in the store", run("query", store, "on", thing)[0])
    report_asked(store, thing, ", in the store")
    report("serve the store, until it answers", time_serving(store))


def report_asked(place: Path, thing: str, where: str) -> None:
    """Print a row for each question in words; the first of each place makes the tables, the second finds them."""
    for question in (ASKED[0], *ASKED):
        report(f"ask “{question}”{where}", run("ask", place, question.replace("X", thing))[0])


def time_python(script: str, *arguments: str) -> float:
    """Return the seconds of a script."""
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", script, *arguments], check=True, capture_output=True)
    return time.perf_counter() - start


def list_questions() -> list[tuple[str, list[str]]]:
    """Return the id and the required parameters of each ready question."""
    lines = run("query", "--list")[1].splitlines()[1:]
    rows = (re.split(r"\s{2,}", line) for line in lines)
    return [(row[0], re.findall(r"(?<!\[)\b(\w+)=[A-Z]+", row[1]) if len(row) > 2 else []) for row in rows]


def time_serving(graph: Path) -> float:
    """Return the seconds until `usd2kg serve` answers a query."""
    start = time.perf_counter()
    with subprocess.Popen([*COMMAND, "serve", str(graph), "--port", "0"], stderr=subprocess.PIPE, text=True) as server:
        assert server.stderr is not None
        address = next(found[0] for line in server.stderr if (found := re.search(r"http://\S+/", line)))
        with urllib.request.urlopen(f"{address}sparql?query=ASK%7B%7D") as answer:
            answer.read()
        seconds = time.perf_counter() - start
        server.terminate()
    return seconds


def run(*arguments: object) -> tuple[float, str]:
    """Return the seconds and the output of a command."""
    start = time.perf_counter()
    done = subprocess.run([*COMMAND, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode:
        return time.perf_counter() - start, f"failed: {done.stderr}"
    return time.perf_counter() - start, done.stdout


def report(what: str, seconds: float) -> None:
    """Print one row."""
    print(f"| {what} | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()
