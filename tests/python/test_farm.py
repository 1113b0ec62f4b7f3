"""The example of a farm: 500 meshes on two workers, of which one is killed, then all, and started again."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import espalier
from conftest import ply_of, torus

pytest.importorskip("distributed", reason="no Dask (python3-distributed)")
FARM = pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "farm"
sys.path.insert(0, str(FARM))
from store import Store  # noqa: E402

COUNT = 500
OPTIONS = {"bits": 14, "tolerance": None, "profile": "balanced", "effort": "normal", "original_ids": False}


def start(sources, out):
    return subprocess.Popen([sys.executable, "-B", str(FARM / "farm.py"), "--out", str(out), "--bits", "14", *sources],
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, start_new_session=True)


def workers(process):
    """Returns the processes that Dask started below one, the workers. Each has a child while it reads a file."""
    found, level = [], [process.pid]
    while level:
        level = [int(word) for pid in level for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children")
                 for word in task.read_text().split()]
        found += [pid for pid in level if b"spawn_main" in pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()]
        level = [pid for pid in level if pid not in found]
    return found


def wait_for(condition, seconds=240):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "nothing happened in time"
        time.sleep(0.02)


@pytest.fixture
def sources(tmp_path):
    folder = tmp_path / "meshes"
    folder.mkdir()
    paths = []
    for number in range(COUNT):
        positions, triangles = torus(40 + number % 7, 30)
        paths.append(str(folder / f"{number:03}.ply"))
        pathlib.Path(paths[-1]).write_bytes(b"".join(ply_of(positions * np.float32(1 + number / COUNT), triangles)))
    return paths


def test_a_farm_that_is_killed_goes_on(sources, tmp_path):
    out = tmp_path / "blobs"
    stored = lambda: list(out.glob("*/*.espl"))
    first = start(sources, out)
    wait_for(lambda: len(stored()) >= 40)
    both = workers(first)
    assert len(both) == 2
    os.kill(both[0], signal.SIGKILL)
    wait_for(lambda: len(stored()) >= 120)
    os.killpg(first.pid, signal.SIGKILL)
    first.wait()
    first.stdout.close()
    before = {path: path.stat().st_mtime_ns for path in stored()}
    assert 120 <= len(before) < COUNT
    second = start(sources, out)
    output, _ = second.communicate(timeout=400)
    assert second.returncode == 0 and output.startswith(f"{COUNT - len(before)} baked, {len(before)} there already, 0 failed")
    assert {path: path.stat().st_mtime_ns for path in before} == before
    index = json.loads((out / "index.json").read_text())
    assert sorted(index) == sources and len(stored()) == COUNT
    for source in sources[:: COUNT // 25]:
        key = index[source]["key"]
        assert key == Store(str(out)).key(source, OPTIONS)
        assert Store(str(out)).path(key).read_bytes() == bytes(espalier.bake_file(source, bits=14))


def test_a_store_finds_by_content(tmp_path, sources):
    store = Store(str(tmp_path / "blobs"))
    first = store.bake(sources[0], OPTIONS)
    assert not first.was_there and not first.error
    again = store.bake(sources[0], OPTIONS)
    assert again.was_there and again.key == first.key and again.facts == first.facts
    assert store.bake(sources[0], {**OPTIONS, "bits": 15}).key != first.key
    assert store.bake(sources[1], OPTIONS).key != first.key
    broken = tmp_path / "broken.ply"
    broken.write_bytes(b"ply\n")
    assert "broken.ply" in store.bake(str(broken), OPTIONS).error
    assert "missing.ply" in store.bake(str(tmp_path / "missing.ply"), OPTIONS).error
    assert not list(tmp_path.glob("blobs/*/*.part"))
