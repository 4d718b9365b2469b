"""Batches on several machines, by Dask.

In: the address of a scheduler, or a client. Out: an executor for `executors`. Workers write files
themselves, to a shared folder, and return the outcome of each picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ...base.optional_packages import needed
from ...errors import InvalidArgumentError

_PATIENCE = 10.0  # seconds, for a scheduler to answer


class DaskExecutor:
    """A Dask client as an executor.

    Parameters
    ----------
    client : distributed.Client
    """

    def __init__(self, client: Any) -> None:
        self._client = client

    def submit(self, function, /, *arguments: Any):
        """Submit a call to a worker; Dask moves it to another if that worker is lost."""
        return self._client.submit(function, *arguments, pure=False)


@contextmanager
def connected(address: str) -> Iterator[tuple[DaskExecutor, int]]:
    """Connect to a scheduler; yield an executor, and the number of parallel calls.

    Raises
    ------
    InvalidArgumentError
        Dask is not installed, or no scheduler with workers answers.
    """
    try:
        from distributed import Client
    except ImportError:
        message = needed("a scheduler needs", "distributed", "dask")
        raise InvalidArgumentError(message) from None
    try:
        client = Client(address, timeout=_PATIENCE, set_as_default=False)
        client.wait_for_workers(1, timeout=_PATIENCE)
    except (OSError, TimeoutError, ValueError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        message = f"no Dask scheduler with workers answers at {address}: {reason}"
        raise InvalidArgumentError(message) from None
    try:
        yield DaskExecutor(client), count_of(client)
    finally:
        client.close()


def count_of(client: Any) -> int:
    """Return how many calls a client's workers run in parallel."""
    return max(1, sum(client.nthreads().values()))
