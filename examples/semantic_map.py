"""Robotics: from a USD kitchen to a semantic map in SOMA, and the questions that a robot asks of it.

Run: python examples/semantic_map.py [FOLDER]     (default: build/examples)
"""

# %% Build the map: objects, their SOMA classes, poses, and spatial relations
import sys
from pathlib import Path

import usd2kg
from usd2kg.demo import demo_scene

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "build/examples")
folder.mkdir(parents=True, exist_ok=True)
result = usd2kg.build(demo_scene(), base="https://example.org/kitchen#")
graph = result.graph
print(f"{graph.individuals} objects, {len(graph.relations)} relations, {len(graph.triples)} triples")

# %% Write it as an OWL ABox that imports SOMA: KnowRob, Protégé or any triple store reads it
path = folder / "kitchen.ttl"
usd2kg.write_graph(graph, path)
print(f"{path}: imports {', '.join(graph.imports)}")

# %% Ask in words
world = usd2kg.load_graph(path)
for question in ("what is on the dining table?", "in refrigerator", "all of cutlery"):
    answer = world.ask(question.split())
    print(f"{question}  →  {', '.join(str(row[0]) for row in answer.rows[:6])}  ({len(answer.rows)} in all)")
where = world.ask("where is toaster".split())
print(dict(zip(where.columns, where.rows[0], strict=True)))

# %% Ask in SPARQL: the cups, where their centres are in the map frame, and what they are on or inside
cups = world.sparql("""
    SELECT ?cup ?position ?place WHERE {
      ?o a [ rdfs:subClassOf* soma:Cup ] ; rdfs:label ?cup .
      ?o soma:hasShape/dul:hasRegion/u2k:boxCenter ?position .
      OPTIONAL { ?o (soma:isSupportedBy|soma:isInsideOf)/rdfs:label ?place }
    } ORDER BY ?cup""")
for name, position, place in cups.rows:
    print(f"{name}: {position} m, {place}")

# %% Before acting, look at the classes that the grounder is least sure of
by_confidence = sorted(result.grounding.predictions, key=lambda prediction: prediction.confidence or 0.0)
for prediction in by_confidence[:5]:
    print(f"{prediction.prim_path}: {prediction.class_iri}, confidence {prediction.confidence:.2f}")
