"""context_size: the size of the context that is allocated for a prompt and its answer."""

from usd2kg.grounding.llm.limits import LIMITS

__all__ = ["context_size"]


def context_size(size: int, window: int) -> int:
    """Return the size of a context for `size` tokens: a power of two up to the window, so that it rarely grows.

    >>> context_size(3000, 8192), context_size(7000, 8000)
    (4096, 8000)
    """
    return min(max(LIMITS.min_context_tokens, 1 << (size - 1).bit_length()), window)
