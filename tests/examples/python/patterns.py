# %% Which sample pattern errs least? The plot of lut/README.md, for a built-in scene, from Python alone.
#
# usage: patterns.py CSV [SCENE [RECEIVERS]]; then bench/plot_patterns.py CSV PNG constant
#
# In cells (# %%), as notebooks and editors take them. `lkao-bench patterns` does the same in C++, on real scenes too.
import csv
import sys

import numpy as np

import lkao

KINDS = ("lloyd", "paper", "fibonacci", "sobol", "random")
RAY_COUNTS = (64, 128, 256, 512, 1024)
RADII = {"atrium": 2.0, "wall": 2.0}
SEEDS = 3


# %% The scene, and the points that a camera sees of it.
def receivers(V, F, count):
    """P and N of about so many pixels."""
    lower, upper = V.min(0), V.max(0)
    centre, size = (lower + upper) / 2, np.linalg.norm(upper - lower)
    side = int(np.ceil(np.sqrt(2 * count)))
    view = lkao.View(V, F, eye=centre + size * np.array([0.15, 0.1, 0.3]), target=centre, width=side, height=side)
    seen = np.flatnonzero(np.isfinite(view.depth))
    chosen = seen[np.linspace(0, len(seen) - 1, min(count, len(seen))).astype(int)]
    return view.P.reshape(-1, 3)[chosen], view.N.reshape(-1, 3)[chosen]


# %% What is due: 16 spirals of 1024 rays, each turned by another angle at each point.
def integral(scene, radius, P, N):
    spirals = (lkao.Pattern(1024, kind="fibonacci", seed=1000 + seed) for seed in range(16))
    queries = (lkao.AmbientOcclusion(scene, spiral, radius=radius, seed=n) for n, spiral in enumerate(spirals))
    return np.mean([query.query(P, N).occlusion for query in queries], axis=0, dtype=np.float64)


# %% What the patterns say, and how far off that is.
def errors(scene, radius, P, N, kind, ray_count, due):
    given = [
        lkao.AmbientOcclusion(scene, lkao.Pattern(ray_count, kind=kind, seed=seed), radius=radius, seed=seed)
        .query(P, N)
        .occlusion
        for seed in range(SEEDS)
    ]
    return np.array(given, np.float64) - due


def rows_of(name, count):
    """A row each kind and ray count, with the columns of lkao-bench patterns that this knows."""
    V, F = lkao.load(f"builtin:{name}")
    P, N = receivers(V, F, count)
    scene, radius = lkao.Scene(V, F), RADII[name]
    due = integral(scene, radius, P, N)
    for kind in KINDS:
        for ray_count in RAY_COUNTS:
            error = errors(scene, radius, P, N, kind, ray_count, due)
            yield {
                "scene": name,
                "pattern": kind,
                "falloff": "constant",
                "rays": ray_count,
                "rotation": 1,
                "tilt": 0,
                "rmse": np.sqrt(np.mean(error**2)),
                "bias": np.mean(error),
                "independent_rmse": np.sqrt(np.mean(due * (1 - due)) / ray_count),
            }


# %% A CSV for bench/plot_patterns.py.
def main():
    if len(sys.argv) < 2:
        sys.exit("usage: patterns.py CSV [SCENE [RECEIVERS]]")
    name = sys.argv[2] if len(sys.argv) > 2 else "atrium"
    rows = list(rows_of(name, int(sys.argv[3]) if len(sys.argv) > 3 else 2048))
    with open(sys.argv[1], "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
