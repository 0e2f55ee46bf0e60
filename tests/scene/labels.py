"""Shorthands for prims with semantic labels."""

from pxr import Usd

from tests.scene.usda import cube, prim, xform

EARLIEST = Usd.TimeCode.EarliestTime()
DFL = "http://www.ease-crc.org/ont/SOMA_DFL.owl#"


def usd(taxonomy, *values):
    """Return a label property of OpenUSD's encoding."""
    listed = ", ".join(f'"{value}"' for value in values)
    return f"token[] semantics:labels:{taxonomy} = [{listed}]"


def isaac(taxonomy, value, instance="Semantics"):
    """Return the two label properties of Isaac's encoding."""
    stem = f"string semantic:{instance}:params:semantic"
    return "\n".join([f'{stem}Type = "{taxonomy}"', f'{stem}Data = "{value}"'])


def tag(*paths, kind="Labels"):
    """Return a tag of Multiverse's encoding; `kind` is Labels or Reports."""
    return f"rel semanticTag:semantic{kind} = [{', '.join(f'<{path}>' for path in paths)}]"


def class_prim(name, concept=None, namespace=DFL):
    lines = [f'string rdf:conceptName = "{concept}"'] if concept else []
    lines += [f'string rdf:namespace = "{namespace}"'] if namespace else []
    return prim("", f"_class_{name}", *lines, specifier="class")


def ontology(*classes):
    return prim("", "Onto", *classes)


def thing(*body, apis=(), name="Thing"):
    """Return a prim with geometry."""
    return xform(name, *body, cube("geometry"), apis=apis)


def labelled(*lines):
    """Return a prim with label properties and all their schemas applied."""
    apis = []
    for line in "\n".join(lines).splitlines():
        name = line.split()[1]
        if name.startswith("semantics:labels:"):
            apis.append("SemanticsLabelsAPI:" + name.removeprefix("semantics:labels:"))
        elif name.startswith("semantic:"):
            apis.append("SemanticsAPI:" + name.split(":")[1])
        elif name.startswith("semanticTag:"):
            apis.append("SemanticTagAPI")
    return thing(*lines, apis=list(dict.fromkeys(apis)))


def values_of(labels):
    """Return (encoding, taxonomy, value) of each label."""
    return [(label.encoding, label.taxonomy, label.value) for label in labels]
