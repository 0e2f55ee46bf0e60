"""The vocabulary of `bert-base-uncased`, which all-MiniLM-L6-v2 shares."""

from usd2kg.knowledge import read_compressed

__all__ = ["load_pieces"]


def load_pieces() -> list[str]:
    """Return the word pieces in the order of their ids, including special tokens (`[CLS]`) and suffixes (`##ing`)."""
    return read_compressed("bert_vocab.txt.gz").decode().split("\n")[:-1]
