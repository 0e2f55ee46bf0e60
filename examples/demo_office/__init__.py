"""The demo office: an OpenUSD scene authored by script, with hand labels."""
