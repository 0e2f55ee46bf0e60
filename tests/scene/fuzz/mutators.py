"""Mutators of stages: lines, tokens, prims and values of text, and storage faults of bytes."""

import random
import re
from collections.abc import Callable

Mutator = Callable[[str, random.Random, list[str]], str]
"""Text → mutated text; the list holds the texts of other stages to take pieces from."""

_LINE = re.compile(r"[^\n]+")
_TOKEN = re.compile(r'"[^"\n]*"|@[^@\n]*@|<[^<>\n]*>|[\w:.+-]+|[^\w\s]')
_NUMBER = re.compile(r'(?<!#usda )(?<![\w"@/:.<])-?\d+(?:\.\d+)?(?![\w".:/@])')
_STRING = re.compile(r'"[^"\n]*"')
_PATH = re.compile(r"(?<=<)[^<>\n]*(?=>)")
_ASSET = re.compile(r"(?<=@)[^@\n ,\]]+(?=@)")
_HEAD = re.compile(r'^[ \t]*(?:def|over|class)\b([^"\n]*)"([^"\n]*)"', re.MULTILINE)
_SCOPE = re.compile(r'(?:def|over|class)\b[^"\n{]*"([^"\n]*)"|[{}]')
_PROPERTY = re.compile(
    r"^[ \t]*((?:custom |uniform )*)([a-z]\w*(?:\[\])?) ([\w:]+)((?:\.timeSamples|\.connect)?)( = .*)?$", re.MULTILINE
)

_NUMBERS = """
nan inf -inf -0 0 -1 1e308 -1e308 3.5e38 1e30 1e-320 1e400 2147483648 4294967296 -9223372036854775809
18446744073709551616 0.1 7 None 1e-9
""".split()
_CHARACTERS = (
    "\0\a\b\r\v\x1b\x7f\x85\xa0\u00e9\u0301\u200b\u2028\u202e\ufeff\uffff\ud800\u6905\U0001f600\"'\\\n\t{}()<>@#"
)
_VALUES = {
    "string": ['"x"', '""', '"""two\nlines"""', "'q'"],
    "token": ['"X"', '"invisible"', '"guide"', '"partition"', '"class"'],
    "token[]": ['["a", ""]', "[]"],
    "string[]": ['["a", "\\t"]'],
    "bool": ["1", "false"],
    "int": ["-1", "2147483647"],
    "int[]": ["[]", "[-1, 2147483647, 0]"],
    "int64[]": ["[-1, 9223372036854775807]", "[8, 8]"],
    "uchar": ["255"],
    "half": ["inf", "65504"],
    "float": ["nan", "1e39", "-0"],
    "float[]": ["[nan]", "[]"],
    "double": ["inf", "1e308", "0"],
    "timecode": ["3"],
    "double2": ["(1, nan)"],
    "double3": ["(nan, 0, 0)", "(1e308, 1e308, 1e308)", "(0, 0, 0)"],
    "float3": ["(0, 1, 1e38)", "(inf, inf, -inf)"],
    "float4": ["(1, 2, 3, 4)"],
    "color3f": ["(nan, 0, 0)", "(2, -1, 0)"],
    "color3f[]": ["[]", "[(nan, 0, 0)]"],
    "point3f[]": ["[(nan, 0, 0), (1, 1, 1)]", "[]", "[(1e38, 0, 0), (-1e38, 0, 0), (1, 2, 3)]"],
    "point3d[]": ["[(1e308, 0, 0), (-1e308, 2, 3)]"],
    "quatf": ["(0, 0, 0, 0)", "(nan, 0, 0, 1)", "(1e38, 1e38, 1e38, 1e38)"],
    "quath[]": ["[(0, 0, 0, 0)]", "[]"],
    "matrix4d": ["( (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0) )"],
    "asset": ["@x.png@", "@@", "@./scene.usda@"],
    "asset[]": ["[@a@, @b@]"],
    "rel": ["</>", "</World>", "[]", "[</World>, </World.a>]", "<..>", "None"],
    "opaque": [""],
    "dictionary": ["{ int a = 1 }"],
    "pathExpression": ['"//*"'],
}
"""Type → unusual values."""
_TYPES = """
Xform Scope Cube Sphere Cone Capsule Cylinder Plane Mesh Points BasisCurves NurbsPatch TetMesh PointInstancer
GeomSubset Camera Material Shader NodeGraph PhysicsRevoluteJoint PhysicsPrismaticJoint PhysicsFixedJoint PhysicsScene
SphereLight SkelRoot Skeleton Volume OpenVDBAsset HermiteCurves Bogus
""".split()
_METADATA = (
    "active = false", "instanceable = true", "hidden = true", 'kind = "component"', 'kind = "assembly"', 'kind = ""',
    "references = None", "references = </World>", "payload = @./scene.usda@", "inherits = </World>", "clips = {}",
    "specializes = [</World>, </World>]", "references = @./scene.usda@</World> (offset = nan; scale = 0)",
    'apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "SemanticsLabelsAPI:", "SemanticsAPI:a:b", ""]',
    'prepend apiSchemas = ["PhysicsArticulationRootAPI", "Bogus", "CollectionAPI", "MaterialBindingAPI"]',
    'variants = { string shape = "" }', 'prepend variantSets = "shape"', 'displayName = ""', 'displayName = "\\n"',
    'doc = "\\x01"', "assetInfo = { int name = 3\ndouble identifier = nan }", "assetInfo = { string[] name = [] }",
    "customData = { dictionary a = {}\ntoken t = \"\" }", "permission = private", 'customData = { int "a b" = 1 }',
    'metersPerUnit = "1"', "metersPerUnit = 0", "metersPerUnit = 1e-320", "kilogramsPerUnit = nan", "upAxis = 3",
    'defaultPrim = "None"', "startTimeCode = nan", "endTimeCode = -1e308", "subLayers = [@./scene.usda@]",
)  # fmt: skip


def _spans(text: str, rng: random.Random) -> tuple[str, list[tuple[int, int]]]:
    """Return a separator and the spans of all lines or all tokens; at least one."""
    joint, pattern = ("\n", _LINE) if rng.random() < 0.5 else (" ", _TOKEN)
    return joint, [match.span() for match in pattern.finditer(text)] or [(0, 0)]


def _delete(text, rng, others):
    start, end = rng.choice(_spans(text, rng)[1])
    return text[:start] + text[end:]


def _duplicate(text, rng, others):
    joint, spans = _spans(text, rng)
    start, end = rng.choice(spans)
    return text[:end] + joint + text[start:end] + text[end:]


def _swap(text, rng, others):
    _, spans = _spans(text, rng)
    (a, b), (c, d) = sorted(rng.choices(spans, k=2))
    return text if b > c else text[:a] + text[c:d] + text[b:c] + text[a:b] + text[d:]


def _replace(pattern: re.Pattern[str], text: str, rng: random.Random, new: Callable[[re.Match[str]], str]) -> str:
    """Replace one match, sometimes several."""
    found = list(pattern.finditer(text))
    for match in sorted(rng.sample(found, min(len(found), rng.choice((1, 1, 1, 4)))), key=re.Match.start, reverse=True):
        text = text[: match.start()] + new(match) + text[match.end() :]
    return text


def _number(text, rng, others):
    return _replace(_NUMBER, text, rng, lambda _: rng.choice(_NUMBERS))


def _string(text, rng, others):
    strings = [*_STRING.findall(text), '""', '"none"', '"' + "long " * 1000 + '"']
    return _replace(_STRING, text, rng, lambda _: rng.choice(strings))


def _quote(text, rng, others):
    marks = ("'{}'", '"""{}"""', "'{}\"", '"""{}\n"""', "{}", '"{}', '"{}\\', "@{}@")
    return _replace(_STRING, text, rng, lambda match: rng.choice(marks).format(match[0][1:-1]))


def _retype(text, rng, others):
    """Change the type and value of a property, sometimes to time samples or a connection."""

    def new(match: re.Match[str]) -> str:
        type_name = rng.choice(list(_VALUES))
        value = rng.choice(_VALUES[type_name])
        if rng.random() < 0.2 and type_name != "rel":
            return f"{type_name} {match[3]}.timeSamples = {{ 0: {value}, {rng.choice(_NUMBERS)}: {value} }}"
        if rng.random() < 0.1:
            return f"{type_name} {match[3]}.connect = <{rng.choice(paths_of(text))}.{match[3]}>"
        return f"{match[1]}{type_name} {match[3]}" + (f" = {value}" if value else "")

    return _replace(_PROPERTY, text, rng, new)


def _move_property(text, rng, others):
    """Insert a line of some stage after a line of this one."""
    lines = rng.choice([text, *others]).splitlines()
    here = text.splitlines() or [""]
    here.insert(rng.randrange(len(here)) + 1, rng.choice(lines or [""]))
    return "\n".join(here)


def _prim_type(text, rng, others):
    return _replace(_HEAD, text, rng, lambda match: match[0].replace(match[1], f" {rng.choice(_TYPES)} ", 1))


def _rename(text, rng, others):
    names = [match[2] for match in _HEAD.finditer(text)] + ["", "1a", "a b", "\u6905\u5b50", "a-b", "x" * 300]
    return _replace(_HEAD, text, rng, lambda match: match[0].replace(f'"{match[2]}"', f'"{rng.choice(names)}"'))


def _retarget(text, rng, others):
    paths = [*paths_of(text), "/", "..", ".", "/Gone/Away", "/World.a", "/World{a=b}C", "relative/path", "", "//"]
    return _replace(_PATH, text, rng, lambda _: rng.choice(paths))


def _asset(text, rng, others):
    assets = ("./scene.usda", "./base.usda", "scene.usda:SDF_FORMAT_ARGS:a=b", "", "/", "/dev/null", "x" * 5000, ".",
              "./missing.usdz[a.usd]", "http://x.invalid/a.usd", "%zz", "\u6905.usda", "`${A}`", "a.png")  # fmt: skip
    return _replace(_ASSET, text, rng, lambda _: rng.choice(assets))


def _metadata(text, rng, others):
    """Add metadata to a prim or the layer."""

    def new(match: re.Match[str]) -> str:
        return f"{match[0]} (\n{rng.choice(_METADATA)}\n)"

    bare = re.compile(r'(?m)^[ \t]*(?:def|over|class)\b[^"\n]*"[^"\n]*"(?=\s*\{)')
    if rng.random() < 0.6 and bare.search(text):
        return _replace(bare, text, rng, new)
    return _replace(re.compile(r"(?m)^.*\($|#usda 1\.0\n\($"), text, rng, lambda m: f"{m[0]}\n{rng.choice(_METADATA)}")


def _truncate(text, rng, others):
    return text[: rng.randrange(len(text) + 1)]


def _characters(text, rng, others):
    """Insert unusual characters into strings, or anywhere."""
    odd = "".join(rng.choices(_CHARACTERS, k=rng.choice((1, 1, 1, 5))))
    if rng.random() < 0.7:
        return _replace(_STRING, text, rng, lambda match: match[0][:-1] + odd + '"')
    place = rng.randrange(len(text) + 1)
    return text[:place] + odd + text[place:]


def _nest(text, rng, others):
    """Nest prims below a few hundred others, or a value in as many brackets."""
    depth = rng.choice((10, 200, 500))
    first = _HEAD.search(text)
    if first and rng.random() < 0.6:
        heads = "".join(f'def {rng.choice(["Xform ", "Scope ", ""])}"n"\n{{\n' for _ in range(depth))
        return text[: first.start()] + heads + text[first.start() :] + "\n}\n" * depth
    opening, closing = rng.choice((("[", "]"), ("(", ")"), ("{ dictionary d = ", "}")))
    value = opening * depth + closing * depth
    return _replace(_PROPERTY, text, rng, lambda match: f"{match[0]} ( customData = {value} )")


def _blocks(text: str) -> list[tuple[int, int]]:
    """Return the spans of whole prims."""
    found: list[tuple[int, int]] = []
    opened: list[int | None] = []
    start: int | None = None
    for match in _SCOPE.finditer(text):
        if match[0] == "{":
            opened.append(start)
            start = None
        elif match[0] == "}":
            began = opened.pop() if opened else None
            if began is not None:
                found.append((began, match.end()))
        else:
            start = match.start()
    return found


def paths_of(text: str) -> list[str]:
    """Return the paths of the prims in a text layer, found heuristically; the root path if there are none."""
    paths, stack = [], []
    name = None
    for match in _SCOPE.finditer(text):
        if match[0] == "{":
            stack.append(name)
            if name is not None:
                paths.append("/" + "/".join(filter(None, stack)))
            name = None
        elif match[0] == "}":
            del stack[-1:]
        else:
            name = match[1]
    return paths or ["/"]


def _copy_prim(text, rng, others):
    """Copy a prim of some stage into or beside a prim of this one, possibly renamed."""
    source = rng.choice([text, text, *others])
    blocks = _blocks(source)
    if not blocks:
        return text
    start, end = rng.choice(blocks)
    block = source[start:end]
    if rng.random() < 0.7:
        block = _SCOPE.sub(lambda match: match[0].replace(f'"{match[1]}"', f'"copy{rng.randrange(9)}"'), block, count=1)
    places = [match.end() for match in re.finditer(r"(?m)^\s*\}$", text)] or [len(text)]
    place = rng.choice(places)
    return f"{text[:place]}\n{block}\n{text[place:]}"


MUTATORS: dict[Mutator, int] = {
    _delete: 3, _duplicate: 2, _swap: 2, _number: 8, _string: 5, _quote: 1, _retype: 10, _move_property: 4,
    _prim_type: 6, _rename: 4, _retarget: 6, _asset: 4, _metadata: 8, _truncate: 1, _characters: 4, _nest: 1,
    _copy_prim: 6,
}  # fmt: skip
"""Mutators of text with their weights."""


def mangle_text(text: str, rng: random.Random, others: list[str]) -> str:
    """Return the text after one to five mutations."""
    for mutate in rng.choices(list(MUTATORS), weights=list(MUTATORS.values()), k=rng.choice((1, 1, 1, 2, 2, 3, 5))):
        text = mutate(text, rng, others) if text else text
    return text


def mangle_bytes(data: bytes, rng: random.Random) -> bytes:
    """Return the bytes with one to four faults: flipped, zeroed, set, spliced, removed, inserted or truncated."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        at, elsewhere = rng.randrange(len(data) + 1), rng.randrange(len(data) + 1)
        if rng.random() < 0.3:
            # Offsets and lengths have 64 bits.
            at &= ~7
        size = rng.choice((1, 1, 2, 4, 8, 64))
        there = data[at : at + size]
        flipped = bytes(byte ^ (1 << rng.randrange(8)) for byte in there)
        noise = rng.randbytes(size)
        pieces = (flipped, bytes(size), b"\xff" * size, noise, data[elsewhere : elsewhere + size], b"", there + noise)
        data = data[:at] + rng.choice(pieces) + data[at + size :]
    return data[: rng.randrange(len(data) + 1)] if rng.random() < 0.05 else data


def multiply(text: str, rng: random.Random) -> str:
    """Return a stage with many copies of a prim in one place, nested instances, or many levels around a cube."""
    kind = rng.choice(("copies", "instances", "levels"))
    count = rng.choice((3, 30, 300))
    if kind == "copies":
        cubes = "".join(
            f'def Xform "same{i}" (kind = "component")\n{{\n def Cube "g"\n {{\n }}\n}}\n' for i in range(count)
        )
        return f'{text}\ndef Xform "Copies"\n{{\n{cubes}}}\n'
    if kind == "levels":
        return f"{text}\n" + 'def Xform "level"\n{\n' * count + 'def Cube "g"\n{\n}\n' + "}\n" * count
    levels = rng.randrange(2, 10)
    use = 'def Xform "i{}" (\n instanceable = true\n prepend references = </P{}>\n)\n{{\n}}\n'
    text += "\n" + use.format("nested", levels - 1)
    for level in range(levels):
        inside = "".join(use.format(i, level - 1) for i in range(10)) if level else 'def Cube "g"\n{\n}\n'
        text += f'class Xform "P{level}"\n{{\n{inside}}}\n'
    return text
