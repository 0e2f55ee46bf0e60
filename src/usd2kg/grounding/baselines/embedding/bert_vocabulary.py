"""The vocabulary of `bert-base-uncased`, which all-MiniLM-L6-v2 shares."""

import gzip

from usd2kg.knowledge import read_bytes

__all__ = ["load_pieces"]


def load_pieces() -> list[str]:
    """Return words and pieces of words (`##ing`) in the order of their numbers, marks and single letters among them."""
    packed = read_bytes("bert_vocab.txt.gz")
    return gzip.decompress(packed).decode().split("\n")[:-1]
