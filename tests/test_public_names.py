"""`__all__` of every module: complete, sorted, without private names."""

import ast
import importlib
import pkgutil
import tomllib
from itertools import chain
from pathlib import Path
from types import ModuleType

import pytest

import usd2kg

FOUND = list(pkgutil.walk_packages(usd2kg.__path__, "usd2kg."))
MODULES = ["usd2kg", *(found.name for found in FOUND)]
PACKAGES = ["usd2kg", *(found.name for found in FOUND if found.ispkg)]


def as_sorted(names: list[str]) -> list[str]:
    """Return names in the order of import sorters: CONSTANTS, Classes, functions."""
    return sorted(names, key=lambda name: (0 if name.isupper() else 1 if name[0].isupper() else 2, name))


def listed(module: ModuleType) -> list[str]:
    return list(getattr(module, "__all__", []))


def syntax(module: ModuleType) -> ast.Module:
    assert module.__file__ is not None
    return ast.parse(Path(module.__file__).read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", MODULES)
def test_all_is_sorted_and_resolves(name: str):
    module = importlib.import_module(name)
    names = listed(module)
    assert names == as_sorted(names)
    assert len(names) == len(set(names))
    assert [public for public in names if not hasattr(module, public)] == []
    assert [public for public in names if public.startswith("_")] == []


@pytest.mark.parametrize("name", MODULES)
def test_all_lists_public_functions_and_classes(name: str):
    module = importlib.import_module(name)
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    defined = {node.name for node in syntax(module).body if isinstance(node, kinds) and not is_command(node)}
    assert {item for item in defined if not item.startswith("_")} <= set(listed(module))


def is_command(node: ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) -> bool:
    """Return whether a function is a command, which no module imports."""
    return any(ast.unparse(decorator).startswith("app.command(") for decorator in node.decorator_list)


@pytest.mark.parametrize("name", [name for name in PACKAGES if name != "usd2kg"])
def test_all_of_a_package_lists_its_imports(name: str):
    module = importlib.import_module(name)
    # Lazily loaded names are imported under TYPE_CHECKING.
    blocks = [syntax(module).body, *(node.body for node in syntax(module).body if isinstance(node, ast.If))]
    gathered = {
        alias.asname or alias.name
        for node in chain.from_iterable(blocks)
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"{name}.")
        for alias in node.names
    }
    defined = {node.name for node in syntax(module).body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    # Command packages also list their Typer app.
    defined |= {
        target.id
        for node in syntax(module).body
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Name) and target.id == "app"
    }
    assert set(listed(module)) == gathered | {item for item in defined if not item.startswith("_")}


def test_top_level_names_come_from_their_packages():
    for public in usd2kg.__all__:
        found = getattr(usd2kg, public)
        home = importlib.import_module(found.__module__.rpartition(".")[0])
        assert found.__module__.startswith("usd2kg.")
        assert getattr(home, public, found) is found
    assert as_sorted(usd2kg.__all__) == usd2kg.__all__


def test_lazy_names_are_typed():
    # Type checkers read the imports under TYPE_CHECKING, Python reads the table of lazy names.
    (block,) = [node for node in syntax(usd2kg).body if isinstance(node, ast.If)]
    typed = {alias.name for node in block.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    # A star import would replace the built-in open.
    assert typed == {*usd2kg.__all__, "open"}


@pytest.mark.parametrize("name", ["usd2kg", "usd2kg.scene", "usd2kg.graph", "usd2kg.ontology", "usd2kg.assistant"])
def test_unknown_name_is_an_attribute_error(name: str):
    with pytest.raises(AttributeError, match=f"module '{name}' has no attribute 'biuld'"):
        importlib.import_module(name).biuld  # noqa: B018


def test_version_is_that_of_the_project():
    project = Path(usd2kg.__path__[0]).parents[1] / "pyproject.toml"
    assert usd2kg.__version__ == tomllib.loads(project.read_text("utf-8"))["project"]["version"]
