"""open_batch_folder: the output folder of a batch, locked for other batches."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from usd2kg.errors import OutputError, StoreError
from usd2kg.folder_lock import lock_exclusive

__all__ = ["open_batch_folder"]


@contextmanager
def open_batch_folder(folder: Path, seconds: float) -> Iterator[None]:
    """Create a folder and lock it; wait up to `seconds` for another batch.

    Raises:
        OutputError: it cannot be made or written, or another batch uses it.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be used as a folder ({error.strerror}); choose another output") from error
    with ExitStack() as stack:
        try:
            stack.enter_context(lock_exclusive(folder, seconds))
        except StoreError as error:
            raise OutputError(f"{error}; another batch may be writing there") from error
        yield
