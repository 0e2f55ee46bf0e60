"""Reading of a name as a noun phrase: tokens, spelling, abbreviations, languages, head noun."""
