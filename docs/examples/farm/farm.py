"""Bakes many meshes on many processes or machines, by Dask.

    farm.py --out FOLDER SOURCE...                                    two workers on this machine
    farm.py --out FOLDER --workers 16 --bits 18 --original-ids assets/**/*.ply
    farm.py --out FOLDER --scheduler tcp://host:8786 SOURCE...        workers of a cluster that runs

A source that was baked before, with the same options and version of the baker, is not baked again: a farm that was
stopped goes on where it was. FOLDER/index.json names the blob of each source. The workers of a cluster must find
sources and FOLDER under the same paths. Exit status: 0, or 1 where a source could not be baked.
"""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import sys
import time
from typing import Any, Iterable

from distributed import Client, LocalCluster, as_completed

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from store import Store, Stored  # noqa: E402


def bake_one(source: str, folder: str, options: dict[str, Any]) -> Stored:
    """Runs on a worker."""
    return Store(folder).bake(source, options)


class Progress:
    """Lines about what is done: one that is written over in a terminal, else one every few seconds."""

    def __init__(self, count: int) -> None:
        self.count, self.done, self.baked, self.failed = count, 0, 0, 0
        self.start = self.shown = time.monotonic()

    def add(self, stored: Stored) -> None:
        self.done += 1
        self.baked += not stored.was_there and not stored.error
        self.failed += bool(stored.error)
        now = time.monotonic()
        if now - self.shown < (0.2 if sys.stderr.isatty() else 5.0) and self.done < self.count:
            return
        self.shown = now
        left = (now - self.start) / max(self.baked, 1) * (self.count - self.done)
        line = f"{self.done} of {self.count}: {self.baked} baked, {self.failed} failed, at most {left:.0f} s left"
        print(f"\r{line}\033[K" if sys.stderr.isatty() else line, end="", file=sys.stderr)
        if not sys.stderr.isatty() or self.done == self.count:
            print(file=sys.stderr)
        sys.stderr.flush()


def bake_all(client: Client, sources: Iterable[str], folder: str, options: dict[str, Any]) -> list[Stored]:
    """Returns what became of each source, in their order. A worker that dies loses only what it was baking."""
    sources = list(dict.fromkeys(os.path.abspath(source) for source in sources))
    client.upload_file(str(pathlib.Path(__file__).resolve().parent / "store.py"))
    futures = client.map(bake_one, sources, folder=folder, options=options, pure=False)
    progress = Progress(len(sources))
    done: dict[str, Stored] = {}
    sources_of = dict(zip((future.key for future in futures), sources))
    waiting = as_completed(futures)
    del futures  # results that were read need not be kept, or made again where a worker dies
    for future in waiting:
        source = sources_of[future.key]
        try:
            stored = future.result()
        except Exception as error:  # of Dask: such as a source that killed several workers
            stored = Stored(source, error=f"{type(error).__name__}: {error}")
        done[source] = stored
        progress.add(stored)
    return [done[source] for source in sources]


def write_index(folder: str, results: list[Stored]) -> None:
    """Writes FOLDER/index.json: for each source the name of its blob and facts, or the error."""
    index = {}
    for stored in results:
        index[stored.source] = {"error": stored.error} if stored.error else {"key": stored.key, **(stored.facts or {})}
    part = pathlib.Path(folder) / f"index.{os.getpid()}.part"
    part.write_text(json.dumps(index, indent=1) + "\n")
    os.replace(part, pathlib.Path(folder) / "index.json")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", nargs="+", help=".obj, .ply and .stl files")
    parser.add_argument("--out", required=True, help="folder of the blobs")
    parser.add_argument("--scheduler", help="address of a running scheduler; without it a cluster is started here")
    parser.add_argument("--workers", type=int, default=2, help="processes of the cluster that is started here")
    parser.add_argument("--bits", type=int, help="of the largest extent")
    parser.add_argument("--tolerance", type=float, help="largest distance between source and baked surface")
    parser.add_argument("--profile", default="balanced", choices=("fast", "balanced", "small", "tiny"))
    parser.add_argument("--effort", default="normal", choices=("fast", "normal", "best"))
    parser.add_argument("--original-ids", action="store_true", help="store the source of each triangle")
    given = parser.parse_args()
    options = {name: getattr(given, name) for name in ("bits", "tolerance", "profile", "effort", "original_ids")}
    folder = os.path.abspath(given.out)
    os.makedirs(folder, exist_ok=True)
    Store(folder).remove_old_parts()
    cluster = given.scheduler or LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        results = bake_all(client, given.sources, folder, options)
    if not given.scheduler:
        cluster.close()
    write_index(folder, results)
    failures = [stored for stored in results if stored.error]
    for stored in failures:
        print(f"{stored.source}: {stored.error}", file=sys.stderr)
    print(f"{sum(not each.was_there and not each.error for each in results)} baked, "
          f"{sum(each.was_there for each in results)} there already, {len(failures)} failed: {folder}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
