"""The time that each step takes: as a log record, and as a span where OpenTelemetry is set up.

A program that uses usd2kg sets OpenTelemetry up for itself. The command line does it if one of the standard environment
variables asks for it, see `set_up_tracing`.
"""

import logging
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from typing import Any, ParamSpec, TypeVar

__all__ = ["TRACING_VARIABLES", "are_steps_followed", "followed_steps", "set_up_tracing", "span", "traced"]

logger = logging.getLogger(__name__)

TRACING_VARIABLES = ("OTEL_TRACES_EXPORTER", "OTEL_EXPORTER_OTLP_ENDPOINT", "OTEL_EXPORTER_OTLP_TRACES_ENDPOINT")
"""Environment variables of OpenTelemetry that ask for traces."""

Attributes = dict[str, str | int | float]
_Given = ParamSpec("_Given")
_Result = TypeVar("_Result")
_follower: ContextVar[Callable[[str], None] | None] = ContextVar("usd2kg_follower", default=None)


@contextmanager
def followed_steps(notice: Callable[[str], None]) -> Iterator[None]:
    """Call `notice` with the name of each step that begins before the context ends."""
    token = _follower.set(notice)
    try:
        yield
    finally:
        _follower.reset(token)


def are_steps_followed() -> bool:
    """Return whether a context of `followed_steps` is open."""
    return _follower.get() is not None


@contextmanager
def span(name: str) -> Iterator[Attributes]:
    """Measure a step. The attributes that are put into the yielded dictionary are recorded at its end."""
    attributes: Attributes = {}
    if (notice := _follower.get()) is not None:
        notice(name)
    start = time.perf_counter()
    tracer = _tracer()
    if tracer is None:
        yield attributes
    else:
        with tracer.start_as_current_span(f"usd2kg.{name}") as current:
            yield attributes
            current.set_attributes(attributes)
    seconds = time.perf_counter() - start
    counts = "".join(f", {value} {key}" for key, value in attributes.items())
    logger.info("%s: %.3f s%s", name, seconds, counts, extra={"step": name, "seconds": seconds, **attributes})


def traced(
    name: str, describe: Callable[[Any], Mapping[str, int]] = lambda result: {}
) -> Callable[[Callable[_Given, _Result]], Callable[_Given, _Result]]:
    """Return a decorator that measures each call of a function as a step.

    Args:
        name: the step.
        describe: returns the attributes of the step from the result.
    """

    def decorate(function: Callable[_Given, _Result]) -> Callable[_Given, _Result]:
        @wraps(function)
        def call(*arguments: _Given.args, **options: _Given.kwargs) -> _Result:
            with span(name) as attributes:
                result = function(*arguments, **options)
                attributes.update(describe(result))
            return result

        return call

    return decorate


def set_up_tracing() -> None:
    """Send spans where the environment says: OTEL_TRACES_EXPORTER is `otlp`, `console` (to stderr) or `none`.

    An OTEL_EXPORTER_OTLP_ENDPOINT alone means `otlp`. Without these variables nothing is imported.
    """
    kind = os.environ.get("OTEL_TRACES_EXPORTER", "").strip().lower()
    if not kind and any(os.environ.get(name) for name in TRACING_VARIABLES):
        kind = "otlp"
    if kind in {"", "none"}:
        return
    try:
        from opentelemetry import trace  # noqa: PLC0415 - an extra
        from opentelemetry.sdk.resources import Resource  # noqa: PLC0415
        from opentelemetry.sdk.trace import TracerProvider  # noqa: PLC0415
        from opentelemetry.sdk.trace.export import (  # noqa: PLC0415
            BatchSpanProcessor,
            ConsoleSpanExporter,
            SimpleSpanProcessor,
        )

        provider = TracerProvider(
            resource=Resource.create({"service.name": os.environ.get("OTEL_SERVICE_NAME", "usd2kg")})
        )
        if kind == "console":
            provider.add_span_processor(SimpleSpanProcessor(ConsoleSpanExporter(out=sys.stderr)))
        elif kind == "otlp":
            from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter  # noqa: PLC0415

            provider.add_span_processor(BatchSpanProcessor(OTLPSpanExporter()))
        else:
            logger.warning("OTEL_TRACES_EXPORTER=%s: expected otlp, console or none; no spans are sent", kind)
            return
    except ImportError as error:
        logger.warning("spans need %s, which is missing; run: pip install 'usd2kg[tracing]'", error.name)
        return
    trace.set_tracer_provider(provider)


def _tracer() -> Any:
    """Return the tracer; None unless the program has imported OpenTelemetry."""
    if "opentelemetry.trace" not in sys.modules:
        return None
    from opentelemetry import trace  # noqa: PLC0415 - an extra

    return trace.get_tracer("usd2kg")
