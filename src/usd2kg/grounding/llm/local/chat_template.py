"""read_template: the text that a model's chat template puts around system and user prompt.

A chat template is a program in the file of the weights. It is run once on two placeholders, and the text around them is
kept. The prompts themselves never pass through the template, so special tokens in an untrusted name stay plain text.
"""

import logging
from collections.abc import Callable
from typing import NamedTuple

__all__ = ["PLAIN_FRAME", "Frame", "Message", "read_template"]

logger = logging.getLogger(__name__)

Message = dict[str, str]
"""`role` and `content`."""

_SYSTEM = "SYSTEM-PROMPT-PLACEHOLDER"
_USER = "USER-PROMPT-PLACEHOLDER"
_FORMS: tuple[list[Message], ...] = (
    [{"role": "system", "content": _SYSTEM}, {"role": "user", "content": _USER}],
    # For templates that reject the system role or omit it.
    [{"role": "user", "content": f"{_SYSTEM}\n\n{_USER}"}],
)


class Frame(NamedTuple):
    """The text around system and user prompt."""

    before: str
    between: str
    after: str


PLAIN_FRAME = Frame("", "\n\n", "\n\nAnswer:\n")
"""The frame for models without a chat template."""


def read_template(render: Callable[[list[Message]], str]) -> Frame:
    """Return the frame of a chat template, or `PLAIN_FRAME` if the template drops or reorders a prompt.

    Args:
        render: runs the template; raises ValueError if the template rejects the messages.
    """
    for messages in _FORMS:
        try:
            text = render(messages)
        except ValueError as error:
            logger.debug("the chat template rejects %d messages: %s", len(messages), error)
            continue
        if text.count(_SYSTEM) == text.count(_USER) == 1 and text.index(_SYSTEM) < text.index(_USER):
            before, _, rest = text.partition(_SYSTEM)
            between, _, after = rest.partition(_USER)
            return Frame(before, between, after)
    logger.warning("the model's chat template drops or reorders messages; a plain frame is used instead")
    return PLAIN_FRAME
