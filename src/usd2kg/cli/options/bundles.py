"""Option bundles: dataclasses whose fields are options of a command."""

import functools
import inspect
from collections.abc import Callable, Iterable, Iterator
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any, ClassVar

from usd2kg.files import check_apart

__all__ = ["OptionBundle", "bundle_files", "check_files", "expand_bundles"]


class OptionBundle:
    """Base of the bundles: dataclasses of options, with other bundles as fields."""

    output_options: ClassVar[frozenset[str]] = frozenset()
    """Names of the options with output files; the files of other options are inputs."""

    def changed_options(self) -> Iterator[str]:
        """Yield the options that do not have their default, like `--samples`, with those of the bundles in this one."""
        for field in fields(self):  # type: ignore[arg-type]
            value = getattr(self, field.name)
            if isinstance(value, OptionBundle):
                yield from value.changed_options()
            elif value != field.default:
                yield f"--{field.name.replace('_', '-')}"


def check_files(outputs: Iterable[Path | None], inputs: Iterable[Path | None], *bundles: OptionBundle) -> None:
    """Check that a command overwrites none of its input files, given directly or in a bundle.

    Raises:
        OutputError: an output is also an input or another output.
    """
    files = [file for bundle in bundles for file in bundle_files(bundle)]
    written = [path for path, is_output in files if is_output]
    check_apart((*outputs, *written), (*inputs, *(path for path, is_output in files if not is_output)))


def bundle_files(bundle: Any) -> Iterator[tuple[Path, bool]]:
    """Yield each file that a bundle names, and whether it is an output."""
    for field in fields(bundle):
        value = getattr(bundle, field.name)
        if isinstance(value, OptionBundle):
            yield from bundle_files(value)
        elif isinstance(value, Path):
            yield value, field.name in bundle.output_options


def expand_bundles(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command that takes the options of its bundles in place of the bundles.

    A bundle is a parameter annotated with a dataclass. Its fields are annotated options with defaults, or bundles.
    """
    signature = inspect.signature(command)
    bundles = {name: p.annotation for name, p in signature.parameters.items() if is_dataclass(p.annotation)}
    parameters: list[inspect.Parameter] = []
    for name, parameter in signature.parameters.items():
        parameters += _options(bundles[name]) if name in bundles else [parameter]

    @functools.wraps(command)
    def expanded(**values: Any) -> None:
        filled = {name: _fill(bundle, values) for name, bundle in bundles.items()}
        command(**values, **filled)

    keyword_only = [parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY) for parameter in parameters]
    expanded.__signature__ = signature.replace(parameters=keyword_only)  # type: ignore[attr-defined]
    expanded.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return expanded


def _options(bundle: Any) -> Iterator[inspect.Parameter]:
    for field in fields(bundle):
        if is_dataclass(field.type):
            yield from _options(field.type)
        else:
            assert field.default is not MISSING, f"option {field.name} has no default"
            yield inspect.Parameter(
                field.name, inspect.Parameter.KEYWORD_ONLY, default=field.default, annotation=field.type
            )


def _fill(bundle: Any, values: dict[str, Any]) -> Any:
    """Return a bundle with its values, which are removed from `values`."""
    return bundle(
        **{f.name: _fill(f.type, values) if is_dataclass(f.type) else values.pop(f.name) for f in fields(bundle)}
    )
