"""The vocabulary of `bert-base-uncased`, which all-MiniLM-L6-v2 shares."""

import gzip

from usd2kg.knowledge import read_bytes

__all__ = ["load_pieces"]


def load_pieces() -> list[str]:
    """Return the word pieces in the order of their ids, including special tokens (`[CLS]`) and suffixes (`##ing`)."""
    packed = read_bytes("bert_vocab.txt.gz")
    return gzip.decompress(packed).decode().split("\n")[:-1]
