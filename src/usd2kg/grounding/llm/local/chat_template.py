"""Where instructions and question stand in a model's chat template.

A template is a program in the weights' file. It is run once, on two words that stand for the texts; what it puts around
them is kept. So the texts themselves never pass through it: marks of a template that a stranger wrote into a name stay
plain text.
"""

import logging
from collections.abc import Callable
from typing import NamedTuple

__all__ = ["PLAIN", "Frame", "Message", "read_template"]

logger = logging.getLogger(__name__)

Message = dict[str, str]
"""`role` and `content`."""

_SYSTEM = "INSTRUCTIONS-STAND-HERE"
_USER = "QUESTION-STANDS-HERE"
_FORMS: tuple[list[Message], ...] = (
    [{"role": "system", "content": _SYSTEM}, {"role": "user", "content": _USER}],
    # Some templates refuse a system role, others leave it out.
    [{"role": "user", "content": f"{_SYSTEM}\n\n{_USER}"}],
)


class Frame(NamedTuple):
    """What a template writes around the two texts."""

    before: str
    between: str
    after: str


PLAIN = Frame("", "\n\n", "\n\nAnswer:\n")
"""For models without a template."""


def read_template(render: Callable[[list[Message]], str]) -> Frame:
    """Return what a template writes around instructions and question; the plain frame where it loses one of them.

    Args:
        render: runs the template; a ValueError says that it refuses the messages.
    """
    for messages in _FORMS:
        try:
            text = render(messages)
        except ValueError as error:
            logger.debug("the chat template refuses %d messages: %s", len(messages), error)
            continue
        if text.count(_SYSTEM) == text.count(_USER) == 1 and text.index(_SYSTEM) < text.index(_USER):
            before, _, rest = text.partition(_SYSTEM)
            between, _, after = rest.partition(_USER)
            return Frame(before, between, after)
    logger.warning("the model's chat template loses what it is given; a plain one is used instead")
    return PLAIN
