"""The examples of tests/examples/python do what they say."""

import csv
import importlib.util
import os
import re
import signal
import subprocess
import sys

import numpy as np
import pytest

import lkao
import meshes

EXAMPLES = meshes.SOURCE / "tests/examples/python"


def run(name, *arguments):
    command = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, timeout=300).stdout


def test_five_lines():
    said = re.fullmatch(r"occlusion at the foot of the wall: (0\.\d\d)\n", run("foot_of_the_wall.py"))
    assert said and float(said[1]) == pytest.approx(0.5, abs=0.02)


def test_five_lines_are_those_of_the_readme():
    program = (EXAMPLES / "foot_of_the_wall.py").read_text()
    assert f"```python\n{program}```" in (meshes.SOURCE / "README.md").read_text()
    assert len(program.splitlines()) <= 7


def test_patterns_are_as_good_as_they_are_said_to_be(tmp_path):
    run("patterns.py", tmp_path / "patterns.csv", "wall", 200)
    with open(tmp_path / "patterns.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    rmse = {(row["pattern"], int(row["rays"])): float(row["rmse"]) for row in rows}
    independent = float(rows[0]["independent_rmse"])
    assert len(rmse) == 25 and independent == pytest.approx(rmse["random", 64], rel=0.5)
    for rays in (64, 128, 256, 512, 1024):
        assert 0 < rmse["lloyd", rays] < rmse["random", rays] / 2
    assert rmse["lloyd", 1024] < rmse["lloyd", 64] / 4


def test_a_cluster_bakes_the_bits_of_one_machine():
    if importlib.util.find_spec("distributed") is None:
        pytest.skip("needs python3-distributed")
    from distributed import Client, LocalCluster

    sys.path.insert(0, str(EXAMPLES))
    import dask_bake

    V, F = meshes.grid(40)
    killed = []

    def kill_one(number):
        if number == 3:
            victim = sorted(client.run(os.getpid).values())[0]
            os.kill(victim, signal.SIGKILL)
            killed.append(victim)

    cluster = LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None, silence_logs=50)
    with cluster, Client(cluster) as client:
        occlusion = dask_bake.bake(client, V, F, parts=24, on_part=kill_one, radius=0.5, samples=1024)
    assert len(killed) == 1
    single = lkao.bake(V, F, radius=0.5, samples=1024)
    assert occlusion.tobytes() == single.tobytes() and np.nanmax(single) > 0.3
