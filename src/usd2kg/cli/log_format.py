"""The format of log records and messages on stderr: text, or one JSON object a line."""

import json
import logging
import sys
import time
from typing import Any, TextIO

from usd2kg.errors import Usd2kgError

__all__ = ["LOG_FORMATS", "format_record", "is_json_log", "set_up_logging"]

LOG_FORMATS = ("text", "json")
_STANDARD = frozenset({*vars(logging.makeLogRecord({})), "message", "asctime", "taskName"})
"""Attributes that every record has; others are those of its event."""


class _JsonFormatter(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        more = {key: value for key, value in vars(record).items() if key not in _STANDARD}
        if record.exc_info:
            more["traceback"] = self.formatException(record.exc_info)
        return format_record(record.levelno, record.getMessage(), logger=record.name, **more)


class _StderrHandler(logging.StreamHandler[TextIO]):
    """Writes to the current `sys.stderr`, which prints above an active progress bar."""

    def __init__(self) -> None:
        logging.Handler.__init__(self)

    @property
    def stream(self) -> TextIO:  # type: ignore[override]
        return sys.stderr


def set_up_logging(level: int, log_format: str) -> None:
    """Log to stderr.

    Raises:
        Usd2kgError: the format is unknown.
    """
    if log_format not in LOG_FORMATS:
        raise Usd2kgError(f"--log-format {log_format}: expected {' or '.join(LOG_FORMATS)}")
    handler = _StderrHandler()
    handler.setFormatter(_JsonFormatter() if log_format == "json" else logging.Formatter("%(message)s"))
    logging.basicConfig(level=level, handlers=[handler])


def is_json_log() -> bool:
    """Return whether log records, and therefore messages, are JSON."""
    return any(isinstance(handler.formatter, _JsonFormatter) for handler in logging.root.handlers)


def format_record(level: int, message: str, **more: Any) -> str:
    """Return one record as a line of JSON, with the time in UTC."""
    stamp = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    record = {"time": stamp, "level": logging.getLevelName(level).lower(), "message": message, **more}
    return json.dumps(record, default=str)
