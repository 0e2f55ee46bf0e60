"""Measure `usd2kg validate`: false alarms on real scenes, and detection of corruptions.

Usage: python -m benchmarks.validation.run [alarms] [detection] [--seed N]

Scenes and ontologies that may not be redistributed are read from the folder that the variable USD2KG_SHARED names,
`../shared` by default; a missing one is skipped. Writes `alarms.csv` and `detection.csv` beside this file.
"""

import argparse
import csv
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import NamedTuple

from pxr import Usd, UsdGeom, UsdUtils

from benchmarks.intervals import wilson
from benchmarks.validation.corruptions import GRAPH, OPTIONS, STAGE, StageCorruption, copy_store
from benchmarks.validation.samples import ONTOLOGIES, SCENES, Key, build_store, find, open_ontology, present
from usd2kg.ontology import TBox
from usd2kg.query import Dataset, GraphStore
from usd2kg.validation import Finding, GraphObject, read_graph_objects

HERE = Path(__file__).parent
JUDGED = HERE / "judged.csv"
DETECTION_ONTOLOGIES = ("built-in", "twelve classes")
ROUNDS = 3
PER_ROUND = 4
"""Objects that are corrupted at once, as far as they are unrelated."""


class Judgement(NamedTuple):
    """A row of `judged.csv`: whether a finding is true; `*` stands for any scene, ontology or prim."""

    scene: str
    ontology: str
    rule: str
    prim_path: str
    is_true: str
    reason: str

    def covers(self, scene: str, ontology: str, key: Key) -> bool:
        """Return whether the row judges a finding."""
        pairs = zip((scene, ontology, key.rule, key.prim_path), self[:4], strict=True)
        return all(stated in {"*", found} for found, stated in pairs)


def read_judgements() -> list[Judgement]:
    """Return the rows of `judged.csv`."""
    with JUDGED.open(encoding="utf-8", newline="") as file:
        return [Judgement(**row) for row in csv.DictReader(file)]


# --- false alarms -------------------------------------------------------------------------------------


def measure_alarms() -> None:
    """Print and write how many findings on the scenes are true, by rule; list those that nobody has judged."""
    judgements = read_judgements()
    counts: Counter[tuple[str, str]] = Counter()
    rows, open_rows, objects = [], [], 0
    for scene, ontology, graph in _graphs():
        objects += len(read_graph_objects(graph.store))
        for key, findings in find(graph).items():
            judged = next((row for row in judgements if row.covers(scene, ontology, key)), None)
            verdict = judged.is_true if judged is not None else "open"
            counts[key.rule, verdict] += len(findings)
            rows.append((scene, ontology, key.rule, key.prim_path, verdict))
            if judged is None:
                open_rows += [f"{scene} | {ontology} | {key.rule} | {key.prim_path} | {f.found}" for f in findings]
    _write("alarms.csv", ("scene", "ontology", "rule", "prim_path", "is_true"), sorted(rows))
    print("| rule | findings | true | false | open | false alarms per 100 objects |")
    print("| --- | --- | --- | --- | --- | --- |")
    for rule in [*sorted({rule for rule, _ in counts}), "all"]:
        chosen = {v: sum(n for (r, w), n in counts.items() if w == v and rule in (r, "all")) for v in _VERDICTS}
        verdicts = " | ".join(map(str, chosen.values()))
        print(f"| {rule} | {sum(chosen.values())} | {verdicts} | {_per_100(chosen, objects)} |")
    print(f"\n{objects} objects", *open_rows, sep="\n")


_VERDICTS = ("yes", "no", "open")


def _per_100(counts: dict[str, int], objects: int) -> str:
    return f"{100 * counts['no'] / objects:.2f}"


def _graphs() -> Iterator[tuple[str, str, GraphStore]]:
    """Yield scene, ontology and graph."""
    for ontology in present(ONTOLOGIES):
        tbox = open_ontology(ontology)
        for scene in present(dict(SCENES)):
            with TemporaryDirectory() as folder:
                yield scene, ontology, build_store(SCENES[scene], tbox, Path(folder))


# --- detection ----------------------------------------------------------------------------------------


class Trial(NamedTuple):
    """One corruption."""

    scene: str
    ontology: str
    corruption: str
    target: str
    found_by: str
    """Rules that name it, separated by spaces; empty if it was missed."""


def measure_detection(seed: int) -> None:
    """Print and write how many corruptions are found."""
    trials: list[Trial] = []
    for ontology in DETECTION_ONTOLOGIES:
        tbox = open_ontology(ontology)
        for scene in present(dict(SCENES)):
            with TemporaryDirectory() as folder:
                bench = _Bench(scene, ontology, tbox, Path(folder), Random(f"{seed} {scene}"))
                trials += [*bench.options(), *bench.stages(), *bench.graphs()]
            print(f"{ontology}, {scene}: {len(trials)} trials", file=sys.stderr)
    _write("detection.csv", Trial._fields, trials)
    print("| corruption | " + " | ".join(f"{name}: found of n (95 %)" for name in DETECTION_ONTOLOGIES) + " | rules |")
    print("| --- |" + " --- |" * (len(DETECTION_ONTOLOGIES) + 1))
    for corruption in dict.fromkeys(trial.corruption for trial in trials):
        same = [trial for trial in trials if trial.corruption == corruption]
        rules = Counter(rule for trial in same for rule in trial.found_by.split())
        cells = [_recall([trial for trial in same if trial.ontology == name]) for name in DETECTION_ONTOLOGIES]
        print(f"| {corruption} | {' | '.join(cells)} | {', '.join(f'{r} {n}' for r, n in rules.most_common())} |")


def _recall(trials: list[Trial]) -> str:
    found = sum(bool(trial.found_by) for trial in trials)
    if not trials:
        return "0 of 0"
    low, high = wilson(found, len(trials))
    return f"{found} of {len(trials)}, {100 * found / len(trials):.0f} % ({100 * low:.0f} to {100 * high:.0f})"


class _Bench:
    """The corruptions of one scene under one ontology."""

    def __init__(self, scene: str, ontology: str, tbox: TBox, folder: Path, random: Random) -> None:
        self._names = scene, ontology
        self._path, self._tbox, self._folder, self._random = SCENES[scene], tbox, folder, random
        self._clean = build_store(self._path, tbox, folder)
        self._known = find(self._clean)
        self._objects = read_graph_objects(self._clean.store)

    def _trial(
        self, name: str, target: str, rules: tuple[str, ...], graph: GraphStore, paths: set[str] | None
    ) -> Trial:
        """Return the trial of a corruption of the objects `paths`; of the whole scene for None."""
        new = [f for key, found in find(graph).items() if len(found) > len(self._known.get(key, ())) for f in found]
        hits = {finding.rule for finding in new if finding.rule in rules and _names(finding, paths)}
        return Trial(*self._names, name, target, " ".join(sorted(hits)))

    def options(self) -> Iterator[Trial]:
        """Yield the trials of wrong options."""
        unit = UsdGeom.GetStageMetersPerUnit(Usd.Stage.Open(str(self._path)))
        for corruption in OPTIONS:
            graph = build_store(self._path, self._tbox, self._folder, corruption.change(unit))
            yield self._trial(corruption.name, "", corruption.rules, graph, None)

    def stages(self) -> Iterator[Trial]:
        """Yield the trials of edited stages."""
        for corruption in STAGE:
            candidates = [obj for obj in self._objects if corruption.may(obj)]
            for _ in range(ROUNDS):
                chosen = self._choose(candidates)
                if chosen:
                    yield from self._edit_stage(corruption, chosen)

    def _choose(self, candidates: list[GraphObject]) -> list[GraphObject]:
        """Return a few objects, none of which is on, in, part of or below another."""
        chosen: list[GraphObject] = []
        for obj in self._random.sample(candidates, len(candidates)):
            ties = {*obj.supporters, *obj.containers, *obj.holders}
            is_free = all(
                other.iri not in ties
                and obj.iri not in {*other.supporters, *other.containers, *other.holders}
                and not obj.prim_path.startswith(f"{other.prim_path}/")
                and not other.prim_path.startswith(f"{obj.prim_path}/")
                for other in chosen
            )
            if is_free and len(chosen) < PER_ROUND:
                chosen.append(obj)
        return chosen

    def _edit_stage(self, corruption: StageCorruption, chosen: list[GraphObject]) -> Iterator[Trial]:
        stage = Usd.Stage.Open(str(self._path))
        edited = []
        for obj in chosen:
            prim = stage.GetPrimAtPath(obj.prim_path)
            # Prims of instances cannot be edited.
            if prim and not prim.IsInstanceProxy() and prim.IsA(UsdGeom.Xformable):
                corruption.edit(stage, obj, self._objects)
                edited.append(obj)
        if edited:
            graph = build_store(stage, self._tbox, self._folder)
            for obj in edited:
                path = obj.prim_path
                yield self._trial(corruption.name, path, corruption.rules, graph, {path, f"{path}_copied"})

    def graphs(self) -> Iterator[Trial]:
        """Yield the trials of edited graphs."""
        for corruption in GRAPH:
            for _ in range(ROUNDS * PER_ROUND):
                store = copy_store(self._clean.store)
                paths = corruption.edit(store, self._objects, self._random)
                if paths is not None:
                    graph = GraphStore(Dataset(store), "corrupted")
                    yield self._trial(corruption.name, " ".join(sorted(paths)), corruption.rules, graph, paths)


def _names(finding: Finding, paths: set[str] | None) -> bool:
    """Return whether a finding is about one of the objects, or names it as an example or as the other of two."""
    if paths is None:
        return finding.prim_path == ""
    return finding.prim_path in paths or any(f"({path})" in finding.found for path in paths)


def _write(name: str, header: tuple[str, ...], rows: list[tuple[str, ...]]) -> None:
    with (HERE / name).open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([header, *rows])


def main() -> None:
    """Run the parts that are named, by default both."""
    parser = argparse.ArgumentParser(description="Measure false alarms and detection of usd2kg validate.")
    parser.add_argument("parts", nargs="*", metavar="PART", help="alarms, detection; default: both")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    parts = args.parts or ["alarms", "detection"]
    if unknown := sorted(set(parts) - {"alarms", "detection"}):
        parser.error(f"unknown part {unknown[0]!r}; expected alarms or detection")
    if "alarms" in parts:
        measure_alarms()
    if "detection" in parts:
        # Missing assets of the scenes are known.
        diagnostics = UsdUtils.CoalescingDiagnosticDelegate()
        measure_detection(args.seed)
        diagnostics.TakeUncoalescedDiagnostics()


if __name__ == "__main__":
    main()
