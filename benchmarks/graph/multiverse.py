"""Compare the graph that Multiverse wrote of a kitchen with that of usd2kg for the same stage, by the same SPARQL.

Usage: python -m benchmarks.graph.multiverse SHARED

SHARED is the folder of scenes and ontologies that may not be redistributed. In scenes/dlr_kitchen,
tagged_flattened.usda is the stage tagged with Multiverse's dictionary, and multiverse_abox.owl is Multiverse's ABox of
it. Prints a Markdown table. Where the graphs use different terms for the same fact, a query names both.
"""

import sys
from pathlib import Path

import pyoxigraph as ox
from pxr import Usd

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.graph import serialize_graph
from usd2kg.graph.vocabulary import PREFIXES

MINTED = 'STRSTARTS(STR(?o), STR(usd:)) || STRSTARTS(STR(?o), "http://www.ontologydesignpatterns.org/")'
RELATIONS = (
    "soma:isOntopOf soma:isSupportedBy soma:isInsideOf knowrob:isAboveOf knowrob:isBelowOf knowrob:isNextTo dul:nearTo "
    "dul:hasCommonBoundary u2k:inRoom u2k:nextTo u2k:touching"
)
JOINT = "?o soma:hasParentLink|soma:hasChildLink|u2k:jointAxis|usd:physics_body1 ?x"
ROWS = {
    "triples": "SELECT (COUNT(*) AS ?n) { ?s ?p ?o }",
    "individuals for prims": "?o a usd:Prim",
    "… with the prim's path": "?o a usd:Prim ; u2k:primPath ?x",
    "… with a label": "?o a usd:Prim ; rdfs:label ?x",
    "… below several prims at once": (
        "{ SELECT ?o { ?x dul:hasPart ?o . ?x a usd:Prim . ?o a usd:Prim } GROUP BY ?o HAVING(COUNT(?x) > 1) }"
    ),
    "individuals in the namespace of an ontology": f"?o a owl:NamedIndividual . FILTER({MINTED})",
    "individuals for prims with a class of things": "?o a usd:Prim , ?c . FILTER({kind})",
    "classes of things": "SELECT (COUNT(DISTINCT ?c) AS ?n) { ?o a usd:Prim , ?c . FILTER({kind}) }",
    "classes with a confidence": "?o owl:annotatedProperty rdf:type ; sssom:confidence ?x",
    "classes with a reason": "?o owl:annotatedProperty rdf:type ; u2k:explanation ?x",
    "extents of a box, metres": "?o soma:hasHeight|u2k:height ?x",
    "positions and orientations in the world": "?o soma:hasPositionData|u2k:position ?x",
    "transforms relative to the prim above": "?o usd:xformOp_transform ?x",
    "spatial relations": f"SELECT (COUNT(*) AS ?n) {{ VALUES ?p {{ {RELATIONS} }} ?s ?p ?o }}",
    "… with the rule and numbers behind them": "?o owl:annotatedSource ?s ; u2k:rule ?x",
    "parts of what is above on the stage": "SELECT (COUNT(*) AS ?n) { ?x a usd:Prim ; dul:hasPart ?o . ?o a usd:Prim }",
    "real parts (doors, handles)": "?o u2k:primPath ?p ; ^soma:hasPhysicalComponent|u2k:partOf ?x",
    "joints with their two ends": JOINT,
    "… with an axis and limits": "?o u2k:jointAxis ?x ; soma:hasJointLimit ?y",
    "masses": "?o soma:hasMassValue|u2k:mass|usd:physics_mass ?x",
    "centres of mass": "?o u2k:centerOfMass|usd:physics_centerOfMass ?x",
    "colours": "?o usd:primvars_displayColor ?x",
    "opacities": "?o usd:primvars_displayOpacity ?x",
    "collision flags": "?o usd:physics_collisionEnabled ?x",
    "API schemas of prims, as restrictions": "?o owl:onProperty ?x",
    "tool, settings and hashes of the run": "?o a prov:Activity",
}
KIND = "isIRI(?c) && ?c NOT IN (usd:Prim, owl:NamedIndividual)"


def count(store: ox.Store, query: str) -> int:
    """Return the count of a query; for a bare pattern, the number of distinct ?o."""
    text = query if query.startswith("SELECT") else f"SELECT (COUNT(DISTINCT ?o) AS ?n) {{ {query} }}"
    (row,) = store.query(text.replace("{kind}", KIND), prefixes=PREFIXES)
    return int(row["n"].value)


def open_ours(stage: Path, ontology: Path) -> ox.Store:
    """Return our graph of a stage, re-read from its serialisation."""
    store = ox.Store()
    graph = usd2kg.build(stage, ontology, profile="soma").graph
    store.load(serialize_graph(graph, ox.RdfFormat.TURTLE), format=ox.RdfFormat.TURTLE)
    return store


def main() -> None:
    """Print the table."""
    shared = Path(sys.argv[1])
    folder = shared / "scenes/dlr_kitchen"
    theirs = ox.Store()
    theirs.load(path=folder / "multiverse_abox.owl", format=ox.RdfFormat.RDF_XML)
    ours = open_ours(folder / "tagged_flattened.usda", shared / "ontologies/soma/SOMA-HOME.owl")
    stage = Usd.Stage.Open(str(folder / "tagged_flattened.usda"))
    prims = list(stage.TraverseAll())
    names = {prim.GetName() for prim in prims}
    print(f"The stage has {len(prims)} prims with {len(names)} names.")
    objects = usd2kg.read_scene(demo_scene()).objects
    names = {obj.prim_path.rpartition("/")[2] for obj in objects}
    print(f"The demo kitchen has {len(objects)} objects with {len(names)} names.\n")
    print("| | Multiverse | usd2kg |\n| --- | --- | --- |")
    for name, query in ROWS.items():
        print(f"| {name} | {count(theirs, query):,} | {count(ours, query):,} |")


if __name__ == "__main__":
    main()
