"""Questions in plain words: answered by ready questions, by a model that writes SPARQL, or for an assistant."""

from usd2kg.assistant.asking import AskedAnswer, ask_offline
from usd2kg.assistant.describe import describe, list_objects
from usd2kg.assistant.writing import ask_model

__all__ = [
    "AskedAnswer",
    "ask_model",
    "ask_offline",
    "describe",
    "list_objects",
]
