"""Digital twins: label a USD stage with the classes of its objects, without touching the source files.

Run: python examples/label_stage.py [FOLDER]     (default: build/examples)
"""

# %% Ground the objects of a stage
import csv
import sys
from pathlib import Path

from pxr import Usd

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.labels import label_maker, survey_labels, write_labels

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "build/examples")
folder.mkdir(parents=True, exist_ok=True)
result = usd2kg.build(demo_scene())
print(f"{len(result.scene.objects)} objects grounded to {len(result.graph.classes)} classes")

# %% Queue the uncertain ones for review: a person fills in the last column
queue = [p for p in result.grounding.predictions if p.class_iri is None or (p.confidence or 0.0) < 0.8]
with (folder / "review.csv").open("w", newline="", encoding="utf-8") as file:
    writer = csv.writer(file)
    writer.writerow(("path", "suggested", "confidence", "class"))
    writer.writerows((p.prim_path, p.class_iri, p.confidence, "") for p in queue)
print(f"{len(queue)} objects for review")

# %% Write the others back as a layer over the stage: UsdSemantics labels with class name, IRI and Wikidata item
make_label = label_maker(result.tbox)
review = {p.prim_path for p in queue}
labels = {
    p.prim_path: make_label(p.class_iri)
    for p in result.grounding.predictions
    if p.class_iri is not None and p.prim_path not in review
}
layer = folder / "kitchen_labelled.usda"
report = write_labels(demo_scene(), labels, layer)
print(f"{layer}: {dict(report.counts)}")

# %% The layer opens in any USD tool, with the source as a sublayer
stage = Usd.Stage.Open(str(layer))
fridge = stage.GetPrimAtPath("/KitchenDining/coldStore/Fridge_01")
for attribute in fridge.GetAttributes():
    if attribute.GetName().startswith("semantics:"):
        print(f"{fridge.GetName()}  {attribute.GetName()} = {list(attribute.Get())}")
print(f"{len(survey_labels(stage).labelled)} labelled prims")
