"""The rules of the lexical grounder that no fitted model weighs, and how to switch each one off."""

import importlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

__all__ = ["RULES", "Rule", "find_target", "switched_off"]

PACKAGE = "usd2kg.grounding.lexical"


class Rule(NamedTuple):
    """A rule and its replacement while it is off."""

    name: str
    """What the rule does, as in the table."""
    target: str
    """`module:attribute` or `module:Class.attribute` below the package of the lexical grounder."""
    replacement: Any


def constant(value: Any) -> Callable[..., Any]:
    """Return a function that ignores its arguments."""
    return lambda *args, **kwargs: value


def argument(position: int) -> Callable[..., Any]:
    """Return a function that returns one of its arguments; methods count `self` as 0."""
    return lambda *args, **kwargs: args[position]


def find_target(rule: Rule) -> tuple[Any, str]:
    """Return the module or class that a rule changes, and the name of the attribute."""
    module, _, path = rule.target.partition(":")
    owner: Any = importlib.import_module(f"{PACKAGE}.{module}")
    *classes, name = path.split(".")
    for part in classes:
        owner = getattr(owner, part)
    return owner, name


@contextmanager
def switched_off(rules: Sequence[Rule]) -> Iterator[None]:
    """Switch rules off for grounders that are built within."""
    kept = []
    for rule in rules:
        owner, name = find_target(rule)
        kept.append((owner, name, getattr(owner, name)))
        setattr(owner, name, rule.replacement)
    try:
        yield
    finally:
        for owner, name, value in reversed(kept):
            setattr(owner, name, value)


LISTS, EDITOR = "alignment.member_lists", "alignment.lexicon_editor"
LEXICON, TERMS, PHRASES = "alignment.lexicon", "matching.term_matching", "matching.phrase_matching"
RESIDUAL, TEXTS, READER = "alignment.residual_class", "reading.evidence_texts", "reading.noun_phrase"
SPELLING, KINDS, ABBREVIATIONS = "reading.spelling", "reading.word_kinds", "reading.abbreviations"

RULES = (
    Rule("class labels: read “other furniture” as furniture", f"{LEXICON}:residue_of", constant(None)),
    Rule("class labels: ignore classes of events", f"{LEXICON}:_EVENT_NOUNS", frozenset()),
    Rule("class labels: align common nouns only", f"{LEXICON}:_is_common_noun", constant(True)),
    Rule("senses: prefer those below a superclass or noun of the comment", f"{LEXICON}:_meant_senses", constant([])),
    Rule("senses: use nouns of the comment", f"{LEXICON}:_description_words", constant(frozenset())),
    Rule("senses: prefer the first sense of natural objects", f"{LEXICON}:_NATURAL_DOMAINS", frozenset()),
    Rule("default class: a root that negates another", f"{RESIDUAL}:_NEGATIONS", frozenset()),
    Rule("default class: no rooms or vehicles in a residual class", f"{RESIDUAL}:_NOT_RESIDUAL", frozenset()),
    Rule("home vocabulary: lend names to classes with equal labels", f"{LEXICON}:lend_terms", constant(())),
    Rule("terms: head nouns of two-word labels", f"{LEXICON}:_add_head_nouns", constant(None)),
    Rule("terms: nouns equivalent to a label", f"{LEXICON}:equivalent_nouns", lambda text, taxonomy, is_noun: []),
    Rule("lists: use those that are shipped", "alignment.built_alignment:shipped_rows", constant([])),
    Rule("lists: no class of a hypernym that excludes the noun", f"{EDITOR}:LexiconEditor._exclude", constant(None)),
    Rule("lists: more specific classes without one", f"{LISTS}:_OwnClasses.names_more_specific", constant(False)),
    Rule("matching: a more specific foreign class wins", f"{TERMS}:TermMatcher._is_more_specific", constant(False)),
    Rule("matching: subclasses named after a place", f"{TERMS}:TermMatcher._match_in_place", constant(())),
    Rule("matching: compounds with the parent's words", f"{TERMS}:TermMatcher.whole_words", constant(())),
    Rule("matching: name classifier", f"{TERMS}:TermMatcher._mix_with_classifier", argument(2)),
    Rule("matching: short names of the home vocabulary", f"{TERMS}:_is_short_home_name", constant(False)),
    Rule("ranking: kinds of a noun in unprepared ontologies", "matching.kind_ranking:KindRanker.rank", argument(4)),
    Rule("head noun: modifier behind the head", f"{PHRASES}:PhraseMatcher._inverted_compounds", constant(())),
    Rule(
        "head noun: no competition with its own inversion", f"{PHRASES}:PhraseMatcher._is_inversion_of", constant(False)
    ),
    Rule("head noun: inside a later compound", f"{PHRASES}:_are_inside_compounds", lambda heads: [False] * len(heads)),
    Rule("head noun: usual size of a hypernym", f"{PHRASES}:PhraseMatcher._near_kinds", constant(())),
    Rule("reading: cut what follows a preposition", f"{READER}:NameReader._cut_additions", argument(1)),
    Rule("reading: cut locations", f"{READER}:NameReader._begins_location", constant(False)),
    Rule("reading: terms with pipeline tokens", f"{READER}:NameReader._term_around", constant(range(0))),
    Rule(
        "reading: references to parents",
        f"{READER}:NameReader._split_references",
        lambda self, tokens, parents: (tokens, []),
    ),
    Rule("reading: a reference within a compound is none", f"{READER}:is_compound_part", constant(False)),
    Rule(
        "reading: materials beside the parent's words",
        f"{KINDS}:WordKinds.may_modify_parent",
        lambda self, word: self.is_modifier(word),
    ),
    Rule("reading: participles", f"{KINDS}:WordKinds._is_participle", constant(False)),
    Rule("reading: areas are places", f"{KINDS}:AREAS", frozenset()),
    Rule("spelling: restore vowels", f"{SPELLING}:SpellingCorrector._restore_vowels", constant(None)),
    Rule("spelling: split joined words", f"{SPELLING}:SpellingCorrector._split", constant(None)),
    Rule("spelling: correct letters", f"{SPELLING}:SpellingCorrector._respell", constant(None)),
    Rule("spelling: split joined terms", f"{SPELLING}:SpellingCorrector._words_of_term", lambda self, word: (word,)),
    Rule("spelling: leave dictionary words", f"{SPELLING}:is_english_word", constant(False)),
    Rule("spelling: reject implausible slips", f"{SPELLING}:SpellingCorrector._is_plausible_slip", constant(True)),
    Rule("abbreviations: one way for all words", f"{ABBREVIATIONS}:log_consistency", constant(0.0)),
    Rule("abbreviations: words of the parent", f"{ABBREVIATIONS}:AbbreviationReader._choices_of_parent", constant({})),
    Rule("abbreviations: glued pipeline prefixes", f"{ABBREVIATIONS}:_PREFIXES", frozenset()),
    Rule("abbreviations: complete partly spelled names", "name_evidence:NameEvidence.complete", argument(2)),
    Rule(
        "evidence: known nouns without a class are not completed",
        f"{READER}:NameReader.names_known_noun",
        constant(False),
    ),
    Rule("evidence: ignore generated names", "object_grounder:is_generated_name", constant(False)),
    Rule("evidence: plural group names", f"{TEXTS}:_is_plural", constant(False)),
    Rule("evidence: first phrase of documentation", f"{TEXTS}:_first_noun_phrase", constant("")),
    Rule("decision: reconcile copies", "grounder:reconcile_copies", lambda views, predictions, tbox: predictions),
)
