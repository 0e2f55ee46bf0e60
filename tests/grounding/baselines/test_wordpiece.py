"""WordPieceTokenizer against the published tokenizer of all-MiniLM-L6-v2."""

import hashlib

import pytest

from usd2kg.grounding.baselines.embedding.wordpiece import WordPieceTokenizer, load_tokenizer, split_words
from usd2kg.knowledge import read_compressed, read_text

# Written by the Rust tokenizer of PyPI's `tokenizers` with the published tokenizer.json of all-MiniLM-L6-v2,
# padding off and truncation at 256.
PUBLISHED = [
    ("", [101, 102]),
    ("cup", [101, 2452, 102]),
    ("Cup", [101, 2452, 102]),
    ("coffee mug", [101, 4157, 14757, 102]),
    ("CoffeeMug_01", [101, 4157, 12274, 2290, 1035, 5890, 102]),
    ("SM_Refrigerator_LOD0", [101, 15488, 1035, 18097, 1035, 8840, 2094, 2692, 102]),
    ("obj_042", [101, 27885, 3501, 1035, 5840, 2475, 102]),
    ("spatula", [101, 14690, 7068, 102]),
    ("  soup \t pot\n", [101, 11350, 8962, 102]),
    ("dishwasher tab", [101, 9841, 28556, 2121, 21628, 102]),
    ("cpcbl1", [101, 28569, 16558, 2487, 102]),
    ("tn__knob1_f5", [101, 28286, 1035, 1035, 16859, 2487, 1035, 1042, 2629, 102]),
    ("Küchentisch", [101, 13970, 8661, 7315, 2818, 102]),
    ("café", [101, 7668, 102]),
    ("cafe\u0301", [101, 7668, 102]),  # café
    ("Ångström", [101, 17076, 15687, 102]),
    ("İstanbul", [101, 9960, 102]),
    ("straße", [101, 2358, 27807, 102]),
    ("\u039f\u0394\u039f\u03a3", [101, 1169, 29722, 29730, 29733, 102]),  # ΟΔΟΣ
    ("\u0427\u0430\u0448\u043a\u0430", [101, 1202, 10260, 29753, 28598, 102]),  # Чашка
    ("\u30b3\u30c3\u30d7", [101, 1704, 30237, 30246, 102]),  # コップ
    ("\u51b7\u8535\u5eab", [101, 100, 100, 100, 102]),  # 冷蔵庫
    ("\u7ea2\u8272cup\u676f\u5b50", [101, 100, 100, 2452, 100, 1816, 102]),  # 红色cup杯子
    ("\ucef5", [101, 1466, 30008, 30024, 102]),  # 컵
    ("\u0643\u0648\u0628", [101, 1293, 29836, 29816, 102]),  # كوب
    ("\U0001f34e", [101, 100, 102]),  # 🍎
    ("cup\U0001f34e", [101, 100, 102]),  # cup🍎
    ("a\u200bb", [101, 11113, 102]),
    ("a\x07b", [101, 11113, 102]),
    ("x\ufffdy", [101, 1060, 2100, 102]),
    ("tea\xa0cup", [101, 5572, 2452, 102]),
    ("tea\u3000cup", [101, 5572, 2452, 102]),
    (
        "don\u2019t \u2014 \u201ccup\u201d\u2026",
        [101, 2123, 1521, 1056, 1517, 1523, 2452, 1524, 1529, 102],
    ),  # typographic quotes and dash
    ("$5+2^3`~|<>=", [101, 1002, 1019, 1009, 1016, 1034, 1017, 1036, 1066, 1064, 1026, 1028, 1027, 102]),
    ("?!.,;:", [101, 1029, 999, 1012, 1010, 1025, 1024, 102]),
    ("_", [101, 1035, 102]),
    ("a-b_c/d", [101, 1037, 1011, 1038, 1035, 1039, 1013, 1040, 102]),
    ("1.5l", [101, 1015, 1012, 1019, 2140, 102]),
    ("100", [101, 2531, 102]),
    ("\u0663", [101, 100, 102]),  # ٣
    ("\ufb01sh", [101, 1984, 4095, 102]),  # ﬁsh
    ("\u2167", [101, 100, 102]),  # Ⅷ
    ("\u2122", [101, 1580, 102]),  # ™
    ("a\u0378b", [101, 100, 102]),
]


@pytest.mark.parametrize(("text", "ids"), PUBLISHED, ids=[ascii(text) for text, _ in PUBLISHED])
def test_token_ids_equal_those_of_the_published_tokenizer(text: str, ids: list[int]):
    assert load_tokenizer().encode(text) == ids


def test_splits_words_of_up_to_100_characters():
    ids = load_tokenizer().encode("a" * 100)
    assert (len(ids), ids[:3], ids[-2:]) == (52, [101, 13360, 11057], [2050, 102])
    assert load_tokenizer().encode("a" * 101) == [101, 100, 102]


@pytest.mark.parametrize(("words", "length"), [(253, 255), (254, 256), (255, 256), (5000, 256)])
def test_truncates_at_256_tokens_and_keeps_the_end_token(words: int, length: int):
    assert load_tokenizer().encode("cup " * words) == [101, *[2452] * (length - 2), 102]


def test_special_tokens_in_a_name_are_plain_text():
    # The published tokenizer returns the special token 102 here, which would let a prim name end the text.
    assert load_tokenizer().encode("[SEP]") == [101, 1031, 19802, 1033, 102]


def test_removes_lone_surrogates():
    assert load_tokenizer().encode("cup\ud800") == [101, 2452, 102]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Cup_2", ["cup", "_", "2"]),
        ("ÉCLAIR", ["eclair"]),
        ("a杯b", ["a", "杯", "b"]),
        ("コップ", ["コッフ"]),  # Kana stay together; their marks count as accents.
        ("ab", ["ab"]),
        (" \n", []),
    ],
)
def test_splits_words(text: str, words: list[str]):
    assert split_words(text) == words


def test_prefers_the_longest_piece_and_marks_unknown_words():
    tokenizer = WordPieceTokenizer(["[UNK]", "[CLS]", "[SEP]", "tea", "teapot", "##pot", "##po", "##s", "t"])
    assert tokenizer.encode("teapot") == [1, 4, 2]
    assert tokenizer.encode("teapots teas") == [1, 4, 7, 3, 7, 2]
    assert tokenizer.encode("teacup tpot pot") == [1, 0, 8, 5, 0, 2]


def test_vocabulary_and_licence_are_those_of_bert():
    vocabulary = read_compressed("bert_vocab.txt.gz")
    digest = "07eced375cec144d27c900241f3e339478dec958f92fddbc551f295c992038a3"
    assert (vocabulary.count(b"\n"), hashlib.sha256(vocabulary).hexdigest()) == (30522, digest)
    licence = read_text("BERT-LICENSE.txt")
    assert "Copyright 2018 The Google AI Language Team Authors" in licence
    assert "END OF TERMS AND CONDITIONS" in licence
