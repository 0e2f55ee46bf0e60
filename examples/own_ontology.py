"""Ontology engineering: check an ontology of your own, ground a scene to it, and validate the graph.

Run: python examples/own_ontology.py [FOLDER]     (default: build/examples)
"""

# %% Load the ontology: all its classes of physical objects are candidates
import sys
from collections import Counter
from pathlib import Path

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.ontology import linearize_tree, read_closure
from usd2kg.readiness import OntologyReport, check_ontology
from usd2kg.validation import Severity, validate_graph

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "build/examples")
folder.mkdir(parents=True, exist_ok=True)
source = Path(__file__).with_name("pantry.ttl")
print(linearize_tree(usd2kg.load_tbox(source)))


# %% Check how well objects will ground to it, and what to add
def print_report(report: OntologyReport) -> None:
    """Print the counts and the errors and warnings of a check."""
    print(f"{report.classes} classes, {report.labelled} with a label, {report.meant} with a known meaning")
    for finding in report.findings:
        if finding.severity is not Severity.NOTE:
            print(f"{finding.severity.value}: {finding.label}: {finding.found}. {finding.advice}")


print_report(check_ontology(usd2kg.load_tbox(source)))

# %% Repair it: give the class a label, and check again
ontology = folder / "pantry.ttl"
ontology.write_text(source.read_text("utf-8") + ':PKG_07 rdfs:label "package"@en .\n', "utf-8")
tbox = usd2kg.load_tbox(ontology)
print_report(check_ontology(tbox))

# %% Ground the scene; an object without a class of its own goes to the nearest class above
result = usd2kg.build(demo_scene(), tbox)
counts = Counter(tbox.by_iri[p.class_iri].label for p in result.grounding.predictions if p.class_iri)
for label, count in counts.most_common():
    print(f"{count:4}  {label}")

# %% Look at the reasons for one class
mug = result.grounding.by_path["/KitchenDining/counterRun/mug_dirty"]
print(f"{mug.prim_path}: {mug.explanation}")

# %% Validate the graph: SHACL shapes, clashes with the ontology's axioms, implausible sizes and supports
path = folder / "pantry_graph.ttl"
usd2kg.write_graph(result.graph, path)
validation = validate_graph(usd2kg.load_graph(path), read_closure(tbox))
print(f"{path}: {validation.objects} objects, findings {validation.counts()}")
for finding in validation.findings[:5]:
    print(f"{finding.severity.value}: {finding.label}: {finding.found}; expected {finding.expected}")
