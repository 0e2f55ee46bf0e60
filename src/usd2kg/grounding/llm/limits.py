"""Operational limits of requests, the cache, prompts and local models."""

from dataclasses import dataclass

__all__ = ["LIMITS", "OperationalLimits"]


@dataclass(frozen=True, slots=True)
class OperationalLimits:
    """Timeouts, retries and sizes."""

    request_timeout_s: float = 120.0
    """Duration of one request, from connecting to the last byte of its stream."""
    connect_timeout_s: float = 10.0
    max_retries: int = 4
    """Retries after a transient failure."""
    first_backoff_s: float = 1.0
    """Upper bound of the first wait; it doubles with each retry."""
    max_backoff_s: float = 60.0
    max_retry_after_s: float = 120.0
    """A server that asks for a longer wait has exhausted a quota; the request fails at once."""
    max_consecutive_failures: int = 3
    """Consecutive failed prompts after which no further prompt is sent."""
    max_output_tokens: int = 4096
    max_characters_per_token: int = 32
    """A stream with more characters per allowed token is cut off: the server ignores its token limit."""
    concurrency: int = 4
    """Prompts in flight at the same time."""
    max_enum_values: int = 1000
    """Enum values of a schema that OpenAI accepts, https://platform.openai.com/docs/guides/structured-outputs."""
    max_json_starts: int = 200
    """Opening braces of a completion that are tried as the start of a JSON object."""
    max_siblings: int = 48
    """Sibling names in the description of an object; the others are counted."""
    max_quoted_characters: int = 200
    """Characters of a name, label or comment in a prompt."""
    max_quoted_answer_characters: int = 400
    """Characters of a rejected completion that a repair prompt quotes."""
    max_error_characters: int = 300
    """Characters of a server's error message."""
    min_secret_characters: int = 6
    """Shorter keys are not redacted, since that would make error messages unreadable."""
    cache_busy_s: float = 60.0
    """Wait for a cache that another process has locked."""
    cache_poll_s: float = 0.01
    """Interval between attempts to switch a new cache to WAL mode."""
    first_poll_s: float = 10.0
    """Seconds until the first poll of a batch job; each interval is `poll_growth` times the previous one."""
    poll_growth: float = 1.5
    max_poll_s: float = 120.0
    max_failed_polls: int = 10
    """Consecutive failed polls, not counting retries, after which a batch job is left to a later run."""
    job_settle_s: float = 60.0
    """Age at which the service's job list is certain to include a received batch job."""
    clock_skew_s: float = 600.0
    """Largest difference between the clock of the service and that of this machine."""
    submission_lock_s: float = 600.0
    """Wait for another process that submits batch jobs."""
    decode_batch_tokens: int = 512
    """Tokens that llama.cpp reads in one call."""
    min_context_tokens: int = 2048
    """Smallest context that is allocated for a local model."""
    max_token_bytes: int = 1024
    """Buffer for the text of one token of a local model."""
    max_added_tokens: int = 8
    """Special tokens that a tokenizer may add to a text."""
    likely_tokens: int = 1024
    """Possible next tokens that llama.cpp's server lists; reading as many takes less than computing them."""
    max_known_texts: int = 4096
    """Texts whose tokens are kept."""


LIMITS = OperationalLimits()
