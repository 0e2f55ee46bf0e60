"""The version of usd2kg: reading it from the installed metadata would take as long as grounding a hundred names."""

__all__ = ["VERSION"]

VERSION = "0.2.0"
"""As in `pyproject.toml`."""
