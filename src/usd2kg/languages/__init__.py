"""German, Spanish, French and Italian names: language detection, compound splitting and translation into English."""

from usd2kg.languages.glossary import split_compound
from usd2kg.languages.translation import is_plural_form, language_of, translate

__all__ = ["is_plural_form", "language_of", "split_compound", "translate"]
