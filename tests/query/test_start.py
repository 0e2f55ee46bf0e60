"""What a question from the shell loads before it is answered."""

import subprocess
import sys

import pytest

HEAVY = ("pyhornedowl", "pxr", "scipy", "usd2kg.relations", "usd2kg.validation", "usd2kg.graph.abox")
"""Modules that only other commands need; together they take longer to load than a question takes."""


@pytest.mark.parametrize("modules", ["usd2kg.stores", "usd2kg.stores, usd2kg.assistant.offline"])
def test_a_question_loads_no_module_of_other_commands(modules: str):
    script = f"import sys, {modules}; print(*(name for name in {HEAVY} if name in sys.modules))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
