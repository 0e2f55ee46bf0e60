"""Requests and completions for the tests of the cache and of recordings."""

from dataclasses import replace

from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage

MODEL = "google:gemini-2.5-flash"
SCHEMA = {"type": "object", "properties": {"reasoning": {"type": "string"}, "class": {"enum": ["Cup", "Fork"]}}}
REQUEST = Request("Classes: Cup, Fork", "/World/cup_01", SCHEMA)
TOKENS = (('{"class": "', -0.125), ("Cup", -0.5), ('"}', 0.0))
COMPLETION = Completion('{"class": "Cup"}', Finish.STOP, Usage(12, 8, 5, 2, 3), TOKENS, "A cup.")

# As written by version 0.1.0.
OLD_COMPLETION = (
    '{"text":"{\\"class\\": \\"Cup\\"} \\ud83d é","finish":"length","usage":{"input_tokens":12,"cached_tokens":8,'
    '"output_tokens":5},"mean_logprob":-0.25,"thinking":"A cup."}'
)
UPGRADED = Completion('{"class": "Cup"} \ud83d é', Finish.LENGTH, Usage(12, 8, 5), (), "A cup.")


def request_about(number: int) -> Request:
    return replace(REQUEST, user=f"/World/cup_{number}")
