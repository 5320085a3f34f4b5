#!/usr/bin/python3
"""Plots the CSV of lkao-bench report: time against error, a panel for each of some scenes.

Triangles are drawn by OpenGL, circles answered by the CPU; the line is the Pareto front, dashed the noise floor.

usage: plot_report.py report.csv report.png SCENE,RADIUS...

Needs python3-matplotlib.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# As on the report's page.
COLORS = {"query": "#0072b2", "embree": "#d55e00", "patterns": "#56b4e9", "tables": "#009e73", "levels": "#7a7a00",
          "raster": "#cc79a7", "volumes": "#e69f00", "splats": "#8c564b", "alchemy": "#9467bd", "vao": "#17a2a2",
          "gtao": "#e15759", "vbao": "#59a14f"}


def draw(axes, rows, title):
    for family in dict.fromkeys(row["family"] for row in rows):
        chosen = [row for row in rows if row["family"] == family]
        axes.scatter([float(row["milliseconds"]) for row in chosen], [float(row["rmse"]) for row in chosen],
                     color=COLORS[family], label=family, s=32, edgecolors="white", linewidths=0.5, zorder=3,
                     marker="^" if chosen[-1]["device"] else "o")
    front, best = [], float("inf")
    for row in sorted(rows, key=lambda row: float(row["milliseconds"])):
        if float(row["rmse"]) < best:
            best = float(row["rmse"])
            front.append((float(row["milliseconds"]), best))
    axes.plot(*zip(*front), color="black", linewidth=0.9, alpha=0.6)
    axes.axhline(float(rows[0]["noise_floor_rmse"]), color="gray", linestyle="--", linewidth=0.9)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(title)
    axes.set_xlabel("milliseconds")
    axes.grid(True, alpha=0.3)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    figure, panels = plt.subplots(1, len(sys.argv) - 3, figsize=(6.2 * (len(sys.argv) - 3), 5), sharey=True,
                                  squeeze=False)
    for axes, subject in zip(panels[0], sys.argv[3:]):
        scene, radius = subject.split(",")
        chosen = [row for row in rows if row["scene"] == scene and float(row["radius"]) == float(radius) and
                  row["rmse"] and float(row["rmse"]) > 0]  # what was left out has none
        if not chosen:
            sys.exit(f"plot_report.py: no rows of {subject} in {sys.argv[1]}")
        draw(axes, chosen, f"{scene}, radius {radius}")
    panels[0][0].set_ylabel("RMSE of occlusion")
    panels[0][-1].legend(fontsize="small", loc="lower left", ncols=2)
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=100)


if __name__ == "__main__":
    main()
