"""Reading German, Spanish, French and Italian names."""

import unicodedata
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.knowledge import read_rows
from usd2kg.languages import language_of, split_compound, translate
from usd2kg.languages.glossary import load_lexicons
from usd2kg.languages.inflection import Form
from usd2kg.words import words_of

ROWS = read_rows("glosses.csv")

# WordNet has these words, but in a name of an object their German, Spanish, French or Italian meaning is likelier.
UNMARKED = frozenset(
    """
    agua blanc bota camion campana casque catena chapeau clavier cloture confiture cortina couverture
    dentifrice entrepot etagere farina fauteuil foehn frau girasol jambon klavier lavabo mesa olla pfannkuchen
    platte pomo porta porte poulet rouleau salade seta spiegel tabouret tapa tapis tasse tornillo valvula vela
    vino zimmer
    """.split()
)
GERMAN_NOUNS = [
    row["word"]
    for row in ROWS
    if (row["language"], row["homograph"], row["role"]) == ("de", "", "") and len(row["word"]) > 3
]


def without_accents(text):
    text = unicodedata.normalize("NFD", text.replace("ß", "ss").replace("œ", "oe"))
    return "".join(char for char in text if not unicodedata.combining(char))


def english(identifier, language=None):
    words = translate(words_of(identifier), language)
    return words and " ".join(words)


@pytest.mark.parametrize(
    ("word", "parts"),
    [
        ("küchenschrank", ("küche", "schrank")),
        ("kuechenschrank", ("küche", "schrank")),
        ("kirschkuchen", ("kirsche", "kuchen")),
        ("wandschrank", ("wand", "schrank")),
        ("gartenstühle", ("garten", "stuhl")),
        ("gartenstuehle", ("garten", "stuhl")),
        ("kinderstuhl", ("kind", "stuhl")),
        ("arbeitshandschuhe", ("arbeit", "handschuh")),
        ("schubladengriff", ("schublade", "griff")),
        ("badezimmerspiegel", ("badezimmer", "spiegel")),
        ("hundebett", ("hund", "bett")),
        ("schneidemesser", ("schneide", "messer")),
        ("klappbox", ("klapp", "box")),
        ("rotweinflasche", ("rotwein", "flasche")),
        ("waschbeckenunterschrank", ("waschbecken", "unterschrank")),
        ("geschirrspuelmaschine", ("geschirrspülmaschine",)),
        ("kuhlschrank", ("kühlschrank",)),
        ("gläser", ("glas",)),
        ("bücher", ("buch",)),
        ("kleiner", ("klein",)),
        ("lampara", ("lámpara",)),
        ("sillones", ("sillón",)),
        ("lapices", ("lápiz",)),
        ("roja", ("rojo",)),
        ("fenetres", ("fenêtre",)),
        ("sedie", ("sedia",)),
    ],
)
def test_split_compound_gives_the_dictionary_forms_of_the_parts(word, parts):
    assert split_compound(word) == parts


@pytest.mark.parametrize("word", ["", "wand", "hosen", "flowerpot", "tablelamp", "xqzt", "椅子", "spül", "wandbox"])
def test_english_and_unknown_words_are_not_split(word):
    # A stem alone is not a word, and two English homographs (Wand, Box) are not a German compound.
    assert split_compound(word) == (word,)


@pytest.mark.parametrize(
    ("identifier", "expected"),
    [
        ("Kuechenschrank_02", "kitchen cupboard"),
        ("Geschirrspülmaschine", "dishwasher"),
        ("SM_Holztisch_LOD0", "wood table"),
        ("Tisch_aus_Holz", "wood table"),
        ("Parkbank_Holz", "wood park bench"),
        ("Topf_mit_Deckel", "pot"),
        ("Roter_Stuhl", "red chair"),
        ("Stehlampe_schwarz", "black floor lamp"),
        ("WandLampe", "wall lamp"),
        ("Stuhl_Markus", "markus chair"),
        ("Senfglas", "mustard glass"),
        ("Kissen", "pillow"),
    ],
)
def test_german_names_are_translated(identifier, expected):
    assert english(identifier) == expected
    assert language_of(words_of(identifier)) == "de"


@pytest.mark.parametrize(
    ("identifier", "expected", "language"),
    [
        ("SillaOficina", "office chair", "es"),
        ("silla_de_oficina_roja", "red office chair", "es"),
        ("mesa_de_centro", "coffee table", "es"),
        ("mesas_centro", "coffee table", "es"),
        ("mesa_redonda_pequena", "small round table", "es"),
        ("vaso_con_agua", "glass", "es"),
        ("caja_carton", "cardboard box", "es"),
        ("Table_de_cuisine", "kitchen table", "fr"),
        ("table_basse", "coffee table", "fr"),
        ("petite_chaise_verte", "small green chair", "fr"),
        ("four_à_micro_ondes", "microwave", "fr"),
        ("tire_bouchon", "corkscrew", "fr"),
        ("lampe_bureau", "desk lamp", "fr"),  # lampe is German too; bureau decides
        ("tavolo_da_cucina", "kitchen table", "it"),
        ("sedia_rossa", "red chair", "it"),
        ("forbici", "scissors", "it"),
        ("armadi", "wardrobe", "it"),  # -io, -co, -cia and -ga have irregular plurals
        ("arance_rosse", "red orange", "it"),
        ("cajon_central", "central drawer", "es"),  # central is English too
    ],
)
def test_romance_names_are_translated_with_the_head_last(identifier, expected, language):
    assert english(identifier) == expected
    assert language_of(words_of(identifier)) == language


@pytest.mark.parametrize(
    "identifier",
    [
        "office_chair",
        "table_lamp",
        "Regal_chair",
        "Cafe_de_Paris",
        "Casa_chair",
        "red_pan",
        "Gift_Box",
        "Sofa",
        "x",
        "03",
    ],
)
def test_english_names_are_not_translated(identifier):
    # A single foreign word next to an English one is mostly a brand or a model.
    assert english(identifier) is None
    assert language_of(words_of(identifier)) is None


@pytest.mark.parametrize(
    ("identifier", "language", "expected"),
    [
        ("Wand_01", "de", "wall"),
        ("Regal", "de", "shelf"),
        ("Sofa_rot", "de", "red sofa"),
        ("Pan", "es", "bread"),
        ("Four", "fr", "oven"),
        ("kitchen_tisch", "de", "kitchen table"),
        ("xqzt", "de", None),
        ("silla", "de", None),
        ("table_lamp", "fr", None),
        ("silla", "nl", None),
    ],
)
def test_homographs_count_in_an_expected_language(identifier, language, expected):
    assert english(identifier, language) == expected


def test_no_words_have_no_language():
    assert translate(()) is None
    assert language_of(()) is None


def test_english_nouns_and_adjectives_are_not_translated():
    taxonomy = load_taxonomy()
    # A sample, for speed.
    nouns = [
        lemma
        for lemma in sorted(taxonomy.lemmas)[::8]
        if lemma.isalpha() and any(sense.domain in {"artifact", "food"} for sense in taxonomy.senses(lemma))
    ]
    words = [*nouns, *(f"{word}s" for word in nouns[::4]), *sorted(taxonomy.adjectives)[::8]]
    changed = {word for word in words if translate((word,)) is not None or split_compound(word) != (word,)}
    assert len(words) > 8000
    # bas, lunettes, nass and stabiles are foreign words for low, glasses, wet and stable; our lexicon has German ones.
    foreign = {"bas", "cornflakes", "lunettes", "nass", "stabiles", "laugenbrotchen", "nussnougatcreme", "schubkasten"}
    assert changed <= UNMARKED | {f"{word}s" for word in UNMARKED} | foreign


def test_listed_words_are_translated():
    for row in ROWS:
        if not row["homograph"] and row["role"] in {"", "material", "adjective"}:
            words = tuple(row["word"].split())
            assert translate(words) is not None
            assert translate(words, row["language"]) == tuple(row["english"].split())


def test_the_vocabulary_is_well_formed():
    keys = [(row["language"], row["word"], row["role"]) for row in ROWS]
    assert len(keys) == len(set(keys))
    assert {row["role"] for row in ROWS} == {"", "material", "adjective", "stem", "link", "with"}
    assert {row["homograph"] for row in ROWS} == {"", "yes"}
    for row in ROWS:
        assert row["word"] == unicodedata.normalize("NFC", row["word"].strip().lower())
        assert row["english"] == row["english"].strip().lower()
        # A spelling of inflected words that is an English word has no gloss of its own.
        assert (row["english"] == "") == (row["role"] in {"link", "with"} or is_spelling(row))


def test_words_of_wordnet_are_marked_as_homographs():
    taxonomy = load_taxonomy()
    unmarked = {
        spelling
        for row in ROWS
        if not row["homograph"] and row["role"] in {"", "material", "adjective"} and " " not in row["word"]
        if (spelling := transliterated(row)) in taxonomy or spelling in taxonomy.adjectives
    }
    assert unmarked == UNMARKED


def is_spelling(row):
    return row["homograph"] == "yes" and not row["role"] and not row["english"]


def test_inflected_words_that_are_english_reveal_no_language():
    spellings = [row for row in ROWS if is_spelling(row)]
    assert len(spellings) > 300
    # French for door and earth.
    unmarked = {"porte", "terre"}
    assert {row["word"] for row in spellings if translate((row["word"],)) is not None} <= unmarked


def transliterated(row):
    word = row["word"]
    if row["language"] == "de":
        word = word.replace("ä", "ae").replace("ö", "oe").replace("ü", "ue")
    return without_accents(word)


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(GERMAN_NOUNS), st.sampled_from(["", "s", "n", "en", "e"]), st.sampled_from(GERMAN_NOUNS))
def test_parts_of_a_german_compound_join_to_the_compound(first, link, second):
    compound = first + link + second
    parts = split_compound(compound)
    rest = without_accents(compound)
    assert parts != (compound,) or compound in GERMAN_NOUNS
    for part in parts:
        # The last letter of a part may be elided; only endings and linking elements stand between parts.
        before, found, rest = rest.partition(without_accents(part)[:-1])
        assert found
        assert len(before) <= 4
    assert len(rest) <= 4
    assert translate((compound,)) is not None


@settings(max_examples=40, deadline=None)
@given(st.lists(st.text(max_size=20), max_size=4), st.sampled_from([None, "de", "es", "fr", "it"]))
def test_any_words_are_translated_or_not_without_error(words, language):
    translated = translate(tuple(words), language)
    assert translated is None or all(isinstance(word, str) for word in translated)
    for word in words:
        assert split_compound(word) == (word,) or all(split_compound(word))


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(GERMAN_NOUNS))
def test_composed_decomposed_and_transliterated_umlauts_are_equal(word):
    spelled = word.replace("ä", "ae").replace("ö", "oe").replace("ü", "ue").replace("ß", "ss")
    assert split_compound(unicodedata.normalize("NFD", word)) == split_compound(word) == split_compound(spelled)


def test_very_long_words_are_not_split():
    assert split_compound("stuhl" * 2000) == ("stuhl" * 2000,)


def test_spellings_are_the_same_with_and_without_the_kept_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def spellings() -> dict[str, tuple[dict[str, Form], ...]]:
        load_lexicons.cache_clear()
        found = load_lexicons()
        return {language: (dict(one.words), dict(one.modifiers)) for language, one in found.items()}

    monkeypatch.setenv("USD2KG_TABLE_CACHE", "off")
    computed = spellings()
    monkeypatch.setenv("USD2KG_TABLE_CACHE", str(tmp_path))
    assert spellings() == computed
    (kept,) = tmp_path.glob("*-word-forms.json")
    assert spellings() == computed
    for damage in ("", "[]", '{"de": []}'):
        kept.write_text(damage)
        assert spellings() == computed
    load_lexicons.cache_clear()
