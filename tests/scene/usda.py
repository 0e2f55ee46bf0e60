"""Functions that write small stages as text: one call per prim, nested like the prims."""

METRES = '(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
"""Layer metadata of most test stages."""


def header(**metadata):
    """Return layer metadata; strings are quoted."""
    lines = [f"    {key} = {_value(value)}" for key, value in metadata.items()]
    return "(\n" + "\n".join(lines) + "\n)\n"


def _value(value):
    return f'"{value}"' if isinstance(value, str) else str(value)


def prim(type_name, name, *body, meta=(), specifier="def"):
    """Return a prim; `body` holds property lines and nested prims, `meta` its metadata lines."""
    metadata = f" (\n{chr(10).join(meta)}\n)" if meta else ""
    inside = "\n".join(body)
    return f'{specifier} {type_name} "{name}"{metadata}\n{{\n{inside}\n}}\n'


def xform(name, *body, meta=(), apis=(), kind=None):
    """Return an Xform, optionally with API schemas and a model kind."""
    metadata = list(meta)
    if apis:
        metadata.append(f"prepend apiSchemas = [{', '.join(f'{chr(34)}{api}{chr(34)}' for api in apis)}]")
    if kind:
        metadata.append(f'kind = "{kind}"')
    return prim("Xform", name, *body, meta=metadata)


def component(name, *body, meta=()):
    """Return an Xform of kind component."""
    return xform(name, *body, meta=meta, kind="component")


def rigid(name, *body, meta=()):
    """Return an Xform that is a rigid body."""
    return xform(name, *body, meta=meta, apis=["PhysicsRigidBodyAPI"])


def cube(name, *body, size=1, at=None, purpose=None, meta=()):
    """Return a cube of `size` stage units, centred at `at`."""
    lines = [f"double size = {size}", *body]
    if at is not None:
        lines.append(move(*at))
    if purpose is not None:
        lines.append(f'uniform token purpose = "{purpose}"')
    return prim("Cube", name, *lines, meta=meta)


def box(name, center, sides, meta=()):
    """Return a component that is a box, with its centre and sides in stage units."""
    shape = cube("shape", ops(("double3", "translate", center), ("double3", "scale", sides)))
    return component(name, shape, meta=meta)


def move(x, y, z):
    """Return the lines that translate a prim."""
    return ops(("double3", "translate", (x, y, z)))


def ops(*steps):
    """Return the lines of a transform stack of (type, op, value), the outermost first."""
    lines = [f"{type_name} xformOp:{op} = {value}" for type_name, op, value in steps]
    order = ", ".join(f'"xformOp:{op}"' for _, op, _ in steps)
    return "\n".join([*lines, f"uniform token[] xformOpOrder = [{order}]"])
