"""read_template: the text around system and user prompt."""

import logging

import pytest

from usd2kg.grounding.llm.local.chat_template import PLAIN_FRAME, Frame, Message, read_template


def chatml(messages: list[Message]) -> str:
    return "".join(f"<|im_start|>{m['role']}\n{m['content']}<|im_end|>\n" for m in messages) + "<|im_start|>assistant\n"


def test_returns_the_text_around_the_prompts():
    assert read_template(chatml) == Frame(
        "<|im_start|>system\n", "<|im_end|>\n<|im_start|>user\n", "<|im_end|>\n<|im_start|>assistant\n"
    )


def test_moves_the_system_prompt_to_the_user_if_the_role_is_rejected():
    def refusing(messages: list[Message]) -> str:
        if messages[0]["role"] == "system":
            raise ValueError("System role not supported")
        return chatml(messages)

    assert read_template(refusing) == Frame("<|im_start|>user\n", "\n\n", "<|im_end|>\n<|im_start|>assistant\n")


def test_moves_the_system_prompt_to_the_user_if_it_is_dropped():
    def forgetful(messages: list[Message]) -> str:
        return chatml([message for message in messages if message["role"] == "user"])

    assert read_template(forgetful).before == "<|im_start|>user\n"


@pytest.mark.parametrize("written", ["", "always the same", "USER-PROMPT-PLACEHOLDER SYSTEM-PROMPT-PLACEHOLDER"])
def test_uses_the_plain_frame_if_a_prompt_is_dropped_or_reordered(written: str, caplog: pytest.LogCaptureFixture):
    with caplog.at_level(logging.WARNING):
        assert read_template(lambda _: written) == PLAIN_FRAME
    assert caplog.messages == ["the model's chat template drops or reorders messages; a plain frame is used instead"]
