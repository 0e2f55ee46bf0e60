"""Questions in English, answered with the ready questions or by a language model, and tools for assistants."""

from typing import TYPE_CHECKING

from usd2kg.lazy_names import lazy_names

if TYPE_CHECKING:
    from usd2kg.assistant.describe import describe_objects, list_objects
    from usd2kg.assistant.interpreted_answer import InterpretedAnswer
    from usd2kg.assistant.model_queries import ask_model
    from usd2kg.assistant.offline import ask_offline

__all__ = [
    "InterpretedAnswer",
    "ask_model",
    "ask_offline",
    "describe_objects",
    "list_objects",
]

__getattr__ = lazy_names(
    __name__,
    {
        "InterpretedAnswer": "interpreted_answer",
        "ask_model": "model_queries",
        "ask_offline": "offline",
        "describe_objects": "describe",
        "list_objects": "describe",
    },
)
