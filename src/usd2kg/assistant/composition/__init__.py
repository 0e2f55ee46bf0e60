"""Composition: a question read as an answer type, noun phrases and predicates, which account for all of its words."""

from usd2kg.assistant.composition.composed_answers import ComposedAnswers

__all__ = ["ComposedAnswers"]
