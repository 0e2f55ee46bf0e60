"""The vocabulary of `bert-base-uncased`, which all-MiniLM-L6-v2 shares."""

import gzip
from importlib.resources import files

__all__ = ["load_pieces"]


def load_pieces() -> list[str]:
    """Return words and pieces of words (`##ing`) in the order of their numbers, marks and single letters among them."""
    packed = (files("usd2kg") / "data" / "bert_vocab.txt.gz").read_bytes()
    return gzip.decompress(packed).decode().split("\n")[:-1]
