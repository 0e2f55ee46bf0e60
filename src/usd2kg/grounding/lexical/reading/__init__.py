"""Reading of a name as noun phrases with probabilities: tokens, spelling, abbreviations, languages."""
