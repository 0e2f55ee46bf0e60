"""score_names against probabilities calculated by hand."""

import math
from collections.abc import Mapping

import numpy as np
import pytest

from usd2kg.grounding.llm.local.trie import FloatArray, TokenPath, add_logprobs, build_trie, normalize, score_names

QUOTE = 0
CLOSERS = np.array([QUOTE])


class Model:
    """Probabilities of the next token after a path; the remainder belongs to texts that are not offered."""

    def __init__(self, table: Mapping[TokenPath, Mapping[int, float]]) -> None:
        self.table = table
        self.paths: list[TokenPath] = []

    def __call__(self, path: TokenPath) -> FloatArray:
        self.paths.append(path)
        found = np.full(100, 1e-12)
        for token, probability in self.table.get(path, {}).items():
            found[token] = probability
        return np.log(found)


class TestMostProbableName:
    def test_is_found_despite_a_more_probable_first_token(self):
        # Offered: "Sp|oon" and "Fork". The model prefers "Sponge": after "Sp", "oon" is improbable.
        model = Model({(): {1: 0.7, 3: 0.3}, (1,): {2: 0.1, 9: 0.9}, (1, 2): {QUOTE: 1.0}, (3,): {QUOTE: 1.0}})
        scores = score_names(build_trie({"Spoon": (1, 2), "Fork": (3,)}), model, CLOSERS)
        assert [(name, path) for name, path, _ in scores.found] == [("Fork", (3,)), ("Spoon", (1, 2))]
        assert [logprob for _, _, logprob in scores.found] == pytest.approx([math.log(0.3), math.log(0.07)])

    def test_may_be_a_prefix_of_another(self):
        # "Cup" has 0.6, "Cup|board" has 0.4.
        model = Model({(): {1: 1.0}, (1,): {QUOTE: 0.6, 2: 0.4}, (1, 2): {QUOTE: 1.0}})
        scores = score_names(build_trie({"Cup": (1,), "Cupboard": (1, 2)}), model, CLOSERS)
        assert scores.found[0][0] == "Cup"
        assert scores.token_logprobs((1,)) == pytest.approx([math.log(0.6)])
        assert scores.token_logprobs((1, 2)) == pytest.approx([0.0, math.log(0.4)])

    def test_is_the_first_by_its_tokens_on_a_tie(self):
        model = Model({(): {1: 0.5, 2: 0.5}, (1,): {QUOTE: 1.0}, (2,): {QUOTE: 1.0}})
        assert score_names(build_trie({"B": (2,), "A": (1,)}), model, CLOSERS).found[0][0] == "A"

    def test_ends_with_any_token_that_begins_with_a_quote(self):
        model = Model({(): {1: 1.0}, (1,): {QUOTE: 0.2, 7: 0.3, 2: 0.5}, (1, 2): {QUOTE: 1.0}})
        trie = build_trie({"Cup": (1,), "Cupboard": (1, 2)})
        scores = score_names(trie, model, np.array([QUOTE, 7]))
        assert scores.token_logprobs((1,)) == pytest.approx([math.log(0.5)])


class TestTokenLogprobs:
    def test_sum_to_the_logprob_among_the_offered_names(self):
        # P(Chair) = .5 · .8, P(Chest) = .5 · .1, P(Table) = .2; the rest is not offered.
        model = Model(
            {
                (): {1: 0.5, 4: 0.2},
                (1,): {2: 0.8, 3: 0.1},
                (1, 2): {QUOTE: 1.0},
                (1, 3): {QUOTE: 1.0},
                (4,): {QUOTE: 1.0},
            }
        )
        scores = score_names(build_trie({"Chair": (1, 2), "Chest": (1, 3), "Table": (4,)}), model, CLOSERS)
        assert scores.token_logprobs((1, 2)) == pytest.approx([math.log(0.45 / 0.65), math.log(0.40 / 0.45)])
        assert math.exp(sum(scores.token_logprobs((1, 2)))) == pytest.approx(0.40 / 0.65)
        assert math.exp(sum(scores.token_logprobs((4,)))) == pytest.approx(0.20 / 0.65)

    def test_count_unread_names_with_their_upper_bound(self):
        # After "Fork" with 0.99 the search ends; the two other names together have at most 0.005.
        model = Model({(): {1: 0.99, 2: 0.005}, (1,): {QUOTE: 1.0}})
        scores = score_names(build_trie({"Fork": (1,), "Spoon": (2, 3), "Spade": (2, 4)}), model, CLOSERS)
        assert model.paths == [(), (1,)]
        assert scores.unread == (((2,), pytest.approx(math.log(0.005))),)
        assert math.exp(sum(scores.token_logprobs((1,)))) == pytest.approx(0.99 / 0.995)

    def test_are_empty_for_the_empty_name(self):
        scores = score_names(build_trie({"": ()}), Model({(): {QUOTE: 1.0}}), CLOSERS)
        assert scores.found == (("", (), pytest.approx(0.0, abs=1e-9)),)
        assert scores.token_logprobs(()) == []


class TestSearch:
    def test_reads_each_node_once_if_all_names_are_equally_probable(self):
        names = {str(token): (token, token) for token in range(1, 6)}
        model = Model(
            {(): dict.fromkeys(range(1, 6), 0.2)}
            | {(token,): {token: 1.0} for token in range(1, 6)}
            | {(token, token): {QUOTE: 1.0} for token in range(1, 6)}
        )
        scores = score_names(build_trie(names), model, CLOSERS)
        assert len(model.paths) == len({*model.paths}) == 11
        assert len(scores.found) == 5 and scores.unread == ()

    def test_ends_after_64_predictions_once_a_name_is_found(self):
        model = Model({(): dict.fromkeys(range(1, 100), 0.01)} | {(token,): {QUOTE: 1.0} for token in range(1, 100)})
        scores = score_names(build_trie({str(token): (token,) for token in range(1, 100)}), model, CLOSERS)
        assert len(model.paths) == 64
        assert (len(scores.found), len(scores.unread)) == (63, 36)
        assert math.exp(sum(scores.token_logprobs((1,)))) == pytest.approx(1 / 99)

    def test_descends_to_one_name_after_64_predictions(self):
        # 70 first tokens, all more probable than the names that they begin.
        names = {str(token): (token, 80, 81) for token in range(1, 71)}
        model = Model({(): dict.fromkeys(range(1, 71), 0.01)} | {(token,): {80: 0.001} for token in range(1, 71)})
        scores = score_names(build_trie(names), model, CLOSERS)
        assert model.paths[63:] == [(63,), (63, 80), (63, 80, 81)]
        assert [name for name, _, _ in scores.found] == ["63"]


def test_adds_probabilities_without_underflow():
    assert add_logprobs([-2000.0, -2000.0]) == pytest.approx(-2000 + math.log(2))
    assert add_logprobs([]) == -math.inf
    assert add_logprobs([-math.inf]) == -math.inf


def test_normalises_logits():
    found = normalize(np.array([1000.0, 1000.0 + math.log(3)], np.float32))
    assert np.exp(found) == pytest.approx([0.25, 0.75], abs=1e-4)
