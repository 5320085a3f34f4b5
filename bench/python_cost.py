#!/usr/bin/python3
"""Measures what a million points cost more through the Python package than in C++.

usage: PYTHONPATH=BUILD/python python_cost.py BUILD CSV [POINTS [ROUNDS]]        (default: 1000000 points, 7 rounds)

Both answer the same receivers of the built-in atrium in turns, in one process, with the same library and on all
threads; C++ has its receivers ready and its output allocated, Python has arrays of float32. Medians over the rounds,
the ratio that of the rounds' own; `differing` counts receivers whose occlusion is not the same bits.
"""
import csv
import ctypes
import statistics
import sys
import time

import numpy as np

import lkao

RADIUS = 2.0
RAY_COUNTS = (16, 128)


def receivers(count):
    """The mesh, and points that a camera sees of it, in the order of its pixels."""
    V, F = lkao.load("builtin:atrium")
    side = int(np.ceil(np.sqrt(1.3 * count)))
    view = lkao.View(V, F, eye=(0, 2, 6), target=(0, 2, 0), fov=70, width=side, height=side)
    seen = np.isfinite(view.depth)
    P, N = view.P[seen][:count], view.N[seen][:count]
    if len(P) < count:
        sys.exit(f"python_cost.py: the camera sees only {len(P)} points")
    return V, F, P, N


class Host:
    """The same in C++."""

    def __init__(self, library, V, F, P, N, ray_count):
        self.library = library
        self.occlusion = np.zeros(len(P), np.float32)
        self.arrays = V, F, P, N  # contiguous, and alive
        pointers = [array.ctypes.data_as(ctypes.c_void_p) for array in self.arrays]
        sizes = [ctypes.c_size_t(len(array)) for array in (V, F, P)]
        self.host = ctypes.c_void_p(
            library.lkao_bench_open(
                pointers[0], sizes[0], pointers[1], sizes[1], *pointers[2:], sizes[2], ctypes.c_float(RADIUS), ray_count
            )
        )

    def query(self):
        return self.library.lkao_bench_query(self.host, self.occlusion.ctypes.data_as(ctypes.c_void_p))

    def close(self):
        self.library.lkao_bench_close(self.host)


def measure(library, arrays, ray_count, rounds):
    V, F, P, N = arrays
    host = Host(library, V, F, P, N, ray_count)
    query = lkao.AmbientOcclusion(lkao.Scene(V, F), ray_count, radius=RADIUS)
    occlusion = query.query(P, N).occlusion  # to warm up, as the next
    host.query()
    times = []
    for _ in range(rounds):
        in_cpp = host.query()
        start = time.perf_counter()
        occlusion = query.query(P, N).occlusion
        times.append((in_cpp, time.perf_counter() - start))
    host.close()
    return {
        "scene": "atrium",
        "points": len(P),
        "rays": ray_count,
        "cpp_seconds": f"{statistics.median(c for c, _ in times):.4f}",
        "python_seconds": f"{statistics.median(p for _, p in times):.4f}",
        "ratio": f"{statistics.median(p / c for c, p in times):.4f}",
        "differing": int((occlusion.view(np.uint32) != host.occlusion.view(np.uint32)).sum()),
    }


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    library = ctypes.CDLL(f"{sys.argv[1]}/bench/liblkao_bench_python.so")
    library.lkao_bench_open.restype = ctypes.c_void_p
    library.lkao_bench_query.restype = ctypes.c_double
    library.lkao_bench_provenance.restype = ctypes.c_char_p
    arrays = receivers(int(sys.argv[3]) if len(sys.argv) > 3 else 1_000_000)
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 7
    rows = [measure(library, arrays, ray_count, rounds) for ray_count in RAY_COUNTS]
    with open(sys.argv[2], "w", newline="", encoding="utf-8") as file:
        file.write(library.lkao_bench_provenance().decode())
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print(", ".join(f"{name} {value}" for name, value in row.items()))


if __name__ == "__main__":
    main()
