#!/usr/bin/python3
"""Plots the CSV of lkao-bench patterns: RMSE against ray count, a line a pattern.

usage: plot_patterns.py patterns.csv patterns.png [falloff ...]     (default falloffs: constant linear)

Geometric means over scenes; dotted: as many independent random rays. Needs python3-matplotlib.
"""
import csv
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def geometric_mean(values):
    values = [v for v in values if v > 0]
    return math.exp(sum(map(math.log, values)) / len(values)) if values else float("nan")


def series(rows, column):
    """Ray counts, and the geometric mean of a column for each."""
    counts = sorted({int(row["rays"]) for row in rows})
    return counts, [geometric_mean(float(r[column]) for r in rows if int(r["rays"]) == n) for n in counts]


def plot(axes, rows, falloff):
    # Plain rotation: the jitter study has rows of its own.
    rows = [r for r in rows if r["falloff"] == falloff and r["rotation"] == "1" and r["tilt"] == "0"]
    if not rows:
        sys.exit(f"plot_patterns.py: no rows with falloff '{falloff}'")
    for pattern in dict.fromkeys(r["pattern"] for r in rows):
        counts, errors = series([r for r in rows if r["pattern"] == pattern], "rmse")
        axes.loglog(counts, errors, marker="o", base=2, label=pattern)
    axes.loglog(*series(rows, "independent_rmse"), "k:", base=2, label="independent rays")
    axes.set_xticks(counts, [str(n) for n in counts])
    axes.set_yscale("log", base=10)
    axes.set_title(f"falloff {falloff}")
    axes.set_xlabel("rays")
    axes.grid(True, which="both", alpha=0.3)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    falloffs = sys.argv[3:] or ["constant", "linear"]
    figure, panels = plt.subplots(1, len(falloffs), figsize=(6 * len(falloffs), 5), sharey=True, squeeze=False)
    for axes, falloff in zip(panels[0], falloffs):
        plot(axes, rows, falloff)
    panels[0][0].set_ylabel("RMSE, geometric mean over scenes")
    panels[0][0].legend()
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=80)


if __name__ == "__main__":
    main()
