"""Settings of the lexical grounder, one record per section of `knowledge/settings/lexical.toml`.

The TOML file documents each value beside it: unit, meaning and origin.
"""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "ABBREVIATED_NAME",
    "ABSTENTION",
    "ALIGNMENT",
    "CLASSIFIER",
    "COMBINATION",
    "CONCEPT",
    "CONFIDENCE",
    "CONVENTION",
    "COPIES",
    "DOMAIN_FREQUENCY",
    "EVIDENCE",
    "FREQUENCY",
    "HEAD_NOUN",
    "KIND_RANKING",
    "MATCHING",
    "MODIFIER",
    "PLACE",
    "READING",
    "ROUTES",
    "SENSE",
    "SIMILARITY",
    "SIZE",
    "SPELLING",
    "STANCE",
    "TERMS",
    "VOTE",
    "WORD_PRIOR",
    "AbbreviatedNameSettings",
    "AbstentionSettings",
    "AlignmentSettings",
    "ClassifierSettings",
    "CombinationSettings",
    "ConceptSettings",
    "ConfidenceSettings",
    "ConventionSettings",
    "CopySettings",
    "DomainFrequency",
    "EvidenceSettings",
    "FrequencySettings",
    "HeadNounSettings",
    "KindRankingSettings",
    "MatchingSettings",
    "ModifierSettings",
    "PlaceSettings",
    "ReadingSettings",
    "RouteSettings",
    "SenseSettings",
    "SimilaritySettings",
    "SizeSettings",
    "SpellingSettings",
    "StanceSettings",
    "TermSettings",
    "VoteSettings",
    "WordPriorSettings",
]


class EvidenceSettings(NamedTuple):
    """Weights and thresholds of the sources of words."""

    name_weight: float
    asset_weight: float
    label_weight: float
    documentation_weight: float
    group_weight: float
    part_weight: float
    clear_score: float
    min_score: float
    default_confidence: float
    max_candidates: int
    max_parts: int


class AbbreviatedNameSettings(NamedTuple):
    """Use of the readings of an abbreviated name."""

    max_tokens: int
    min_probability: float
    negligible_probability: float
    unmatched_weight: float


class ConceptSettings(NamedTuple):
    """Confidence of recognised concepts."""

    max_share: float


class CombinationSettings(NamedTuple):
    """Product of experts of words and context."""

    word_floor: float
    context_floor: float
    posterior_floor: float
    posterior_power: float
    neighbour_trust: float
    posterior_trust: float
    explained_score: float
    max_posterior_classes: int
    max_classes: int


class VoteSettings(NamedTuple):
    """Votes of neighbouring objects."""

    min_score: float
    next_weight: float
    sibling_weight: float
    same_size_weight: float
    similar_size_weight: float
    copy_factor: float
    size_spread: float
    unknown_size_factor: float
    prior_weight: float
    sibling_distance: float
    max_siblings: int
    max_placed: int


class CopySettings(NamedTuple):
    """Agreement of copies of one asset."""

    size_distance: float
    min_vote_ratio: float


class AbstentionSettings(NamedTuple):
    """Abstention to a superclass."""

    score_power: float


class ConfidenceSettings(NamedTuple):
    """Features of the calibrated confidence."""

    posterior_floor: float
    posterior_reference: float
    label_score: float
    prior_general: float
    prior_answers: float


class TermSettings(NamedTuple):
    """Weights of terms by origin."""

    label_weight: float
    synonym_weight: float
    lent_weight: float
    head_weight: float
    listed_weight: float


class AlignmentSettings(NamedTuple):
    """Alignment of terms with senses."""

    max_code_letters: int
    other_sense_weight: float
    min_sense_ratio: float
    assumed_category_size: int
    category_confidence: float
    model_confidence: float
    listed_confidence: float


class RouteSettings(NamedTuple):
    """Features of routes."""

    max_steps: int


class MatchingSettings(NamedTuple):
    """Scores of matches."""

    term_score: float
    compound_score: float
    noun_score: float
    step_decay: float
    general_factor: float
    root_steps: int
    min_label_sense_weight: float
    place_factor: float
    share_power: float
    classifier_weight: float


class SimilaritySettings(NamedTuple):
    """Similarity of whole names to the nouns that a language model named."""

    weight: float
    max_terms: int
    min_cosine: float
    letters: int
    letters_value: float


class KindRankingSettings(NamedTuple):
    """Comparison of the kinds of a noun with the labels and comments of a foreign ontology."""

    min_score: float
    min_head_share: float
    tail_factor: float
    sense_weights: tuple[float, ...]
    step_factor: float
    category_factor: float
    least_idf: float
    min_explained: float
    max_classes: int
    max_general_share: float
    min_stage_names: int
    stage_names: int


class HeadNounSettings(NamedTuple):
    """Choice of the head noun."""

    corrected_factor: float
    min_not_modifier: float
    min_share: float
    equal_score_ratio: float
    min_size_ratio: float
    max_size_ratio: float
    size_power: float
    size_offset: float
    size_steps: int
    min_place_size: float


class ClassifierSettings(NamedTuple):
    """Features of the name classifier."""

    max_classes: int
    sense_values: tuple[float, ...]
    ending_value: float
    beginning_value: float
    ending_letters: tuple[int, ...]
    beginning_letters: int


class DomainFrequency(NamedTuple):
    """Frequency of objects in scenes by WordNet domain."""

    artifact: float
    food: float
    plant: float
    animal: float
    body: float
    object: float
    substance: float
    communication: float
    shape: float
    group: float
    person: float
    phenomenon: float
    top: float
    other: float

    def of(self, domain: str) -> float:
        """Return the frequency of a domain; unlisted domains are other."""
        frequency: float = getattr(self, domain, self.other)
        return frequency


class SenseSettings(NamedTuple):
    """Prior of senses."""

    domain_power: float
    rank_decay: float


class WordPriorSettings(NamedTuple):
    """Prior of words."""

    frequency_power: float
    home_label_share: float


class SizeSettings(NamedTuple):
    """Likelihood of sizes."""

    min_extent: float
    max_extent: float
    relative_error: float
    absolute_error: float
    broad_share: float


class PlaceSettings(NamedTuple):
    """Likelihood of places."""

    count_elsewhere: float
    uninformative_share: float
    uninformative_appearance_share: float
    neighbour_weight: float
    reach: float
    clear_probability: float


class StanceSettings(NamedTuple):
    """Likelihood of stances."""

    order_shares: tuple[float, ...]
    other_support_share: float
    other_upright_share: float
    elevation_limits: tuple[float, ...]
    floor_heights: tuple[float, ...]
    surface_heights: tuple[float, ...]
    wall_heights: tuple[float, ...]
    ceiling_heights: tuple[float, ...]
    part_heights: tuple[float, ...]
    nested_shares: tuple[float, ...]
    vertical_tolerance: float
    equal_extents: float
    equal_typical_extents: float
    equal_share: float
    chance_equal_share: float


class ReadingSettings(NamedTuple):
    """Tokens of names."""

    min_noun_letters: int
    max_words: int
    max_term_words: int
    max_unit_letters: int


class ConventionSettings(NamedTuple):
    """Prefixes that the names of a stage share."""

    min_share: float
    pseudo_count: float
    min_object_share: float


class SpellingSettings(NamedTuple):
    """Correction of spelling."""

    min_long_letters: int
    min_letters_for_two_edits: int
    max_edits: int
    min_letters: int
    min_doubled_letters: int
    min_foreign_letters: int
    foreign_loss: float
    max_candidates: int
    min_joined_letters: int
    min_consonants: int
    max_missing_vowels: int


class ModifierSettings(NamedTuple):
    """Words that modify."""

    adjective_share: float
    code_share: float
    content_share: float
    place_share: float
    object_share: float
    min_participle_letters: int
    max_object_rank: int
    max_last_odds: float


class FrequencySettings(NamedTuple):
    """Counts of words."""

    bigram_pseudo_count: int
    last_pseudo_count: float


EVIDENCE = read_settings("lexical", "evidence", EvidenceSettings)
ABBREVIATED_NAME = read_settings("lexical", "abbreviated_name", AbbreviatedNameSettings)
CONCEPT = read_settings("lexical", "concept", ConceptSettings)
COMBINATION = read_settings("lexical", "combination", CombinationSettings)
VOTE = read_settings("lexical", "vote", VoteSettings)
COPIES = read_settings("lexical", "copies", CopySettings)
ABSTENTION = read_settings("lexical", "abstention", AbstentionSettings)
CONFIDENCE = read_settings("lexical", "confidence", ConfidenceSettings)
TERMS = read_settings("lexical", "terms", TermSettings)
ALIGNMENT = read_settings("lexical", "alignment", AlignmentSettings)
ROUTES = read_settings("lexical", "routes", RouteSettings)
MATCHING = read_settings("lexical", "matching", MatchingSettings)
KIND_RANKING = read_settings("lexical", "kind_ranking", KindRankingSettings)
SIMILARITY = read_settings("lexical", "similar_members", SimilaritySettings)
HEAD_NOUN = read_settings("lexical", "head_noun", HeadNounSettings)
CLASSIFIER = read_settings("lexical", "classifier", ClassifierSettings)
DOMAIN_FREQUENCY = read_settings("lexical", "domain_frequency", DomainFrequency)
SENSE = read_settings("lexical", "sense", SenseSettings)
WORD_PRIOR = read_settings("lexical", "word_prior", WordPriorSettings)
SIZE = read_settings("lexical", "size", SizeSettings)
PLACE = read_settings("lexical", "place", PlaceSettings)
STANCE = read_settings("lexical", "stance", StanceSettings)
READING = read_settings("lexical", "reading", ReadingSettings)
CONVENTION = read_settings("lexical", "convention", ConventionSettings)
SPELLING = read_settings("lexical", "spelling", SpellingSettings)
MODIFIER = read_settings("lexical", "modifier", ModifierSettings)
FREQUENCY = read_settings("lexical", "frequency", FrequencySettings)
