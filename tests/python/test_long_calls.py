"""Progress, threads, Ctrl-C."""

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import lkao
import meshes

AO = lkao.AmbientOcclusion(lkao.Scene(*meshes.grid(100)), 1024, radius=1.0)
P = np.tile(meshes.grid(100)[0] + np.float32([0, 0.001, 0]), (20, 1))
N = np.float32([0, 1, 0])


def test_progress_is_told_to_the_end():
    told = []
    few = lkao.AmbientOcclusion(lkao.Scene(*meshes.wall()), 16, radius=1.0)
    few.query(P[:70000], N, threads=2, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (70000, 70000) and len(told) < 1000
    assert sorted(told) == told


def test_progress_of_builds():
    told = []
    lkao.Scene(*meshes.grid(200), progress=lambda *numbers: told.append(numbers))
    assert told and told[-1][0] == told[-1][1] > 0


def test_false_stops_the_call():
    for stop in (lambda done, total: False, lambda done, total: done < total / 4):
        with pytest.raises(lkao.Cancelled):
            AO.query(P[:5000], N, progress=stop)
    assert issubclass(lkao.Cancelled, RuntimeError)
    assert AO.query(P[:10], N, progress=lambda done, total: None).occlusion.shape == (10,)


def test_what_progress_raises_comes_out():
    def fail(done, total):
        raise KeyError("mine")

    for _ in range(20):  # whichever thread calls it
        with pytest.raises(KeyError, match="mine"):
            AO.query(P[:2000], N, progress=fail)
    with pytest.raises(KeyError, match="mine"):
        lkao.Scene(*meshes.grid(50), progress=fail)


def test_what_a_falloff_raises_comes_out():
    def fail(x):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        lkao.Pattern(16, falloff=fail)


def test_other_threads_run_meanwhile():
    answers = []
    query = threading.Thread(target=lambda: answers.append(AO.query(P[:20000], N, threads=1)))
    query.start()
    ticks = 0
    start = time.monotonic()
    while query.is_alive() and time.monotonic() - start < 60:
        time.sleep(0.001)
        ticks += 1
    query.join()
    # A query that kept the interpreter's lock would let this thread in once or twice.
    assert ticks > 20 and answers[0].occlusion.shape == (20000,)


def test_two_threads_ask_at_once():
    expected = AO.query(P[:3000], N).occlusion.tobytes()
    answers = [None] * 4

    def ask(number):
        answers[number] = AO.query(P[:3000], N, progress=lambda done, total: None).occlusion.tobytes()

    threads = [threading.Thread(target=ask, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [expected] * 4


CTRL_C = """
import sys
import numpy as np
import lkao
V = np.random.default_rng(1).normal(size=(3000, 3))
F = np.arange(3000).reshape(-1, 3)
ao = lkao.AmbientOcclusion(lkao.Scene(V, F), 1024, radius=float("inf"))
P = np.zeros((100_000_000, 3), np.float32)
print("asking", flush=True)
try:
    ao.query(P, (0, 1, 0), threads={threads})
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(3)
"""


@pytest.mark.parametrize("threads", [0, 1])
def test_ctrl_c_stops_a_query(threads):
    command = [sys.executable, "-c", CTRL_C.format(threads=threads)]
    program = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert program.stdout.readline() == "asking\n"
    time.sleep(0.3)
    start = time.monotonic()
    program.send_signal(signal.SIGINT)
    output, _ = program.communicate(timeout=60)
    assert (output, program.returncode) == ("interrupted\n", 3)
    assert time.monotonic() - start < 20
