#!/usr/bin/python3
"""Plots the CSV of lkao-bench tables: errors, doubts and speed against the size of the table.

usage: plot_tables.py tables.csv tables.png [rays]     (rays: one of the ray counts in the file; default 128)

Means over the scenes of the file. Needs python3-matplotlib.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker as ticker  # noqa: E402

COLORS = {"cube": "tab:orange", "slices": "tab:blue"}
LINES = {"outline": "-", "sphere": "--"}


def mean_by_resolution(rows, column):
    resolutions = sorted({int(row["resolution"]) for row in rows})
    values = [[float(r[column]) for r in rows if int(r["resolution"]) == n] for n in resolutions]
    return resolutions, [sum(v) / len(v) for v in values]


def draw(axes, rows, column, title, by_nodes, y_log=True):
    """A line for each addressing, and for each kind of node mask where those matter."""
    for addressing in dict.fromkeys(r["addressing"] for r in rows):
        for nodes in dict.fromkeys(r["node_masks"] for r in rows) if by_nodes else [None]:
            chosen = [r for r in rows if r["addressing"] == addressing and nodes in (None, r["node_masks"])]
            label = f"{addressing}, {nodes} nodes" if by_nodes else addressing
            axes.plot(*mean_by_resolution(chosen, column), LINES.get(nodes, "-"), marker="o", label=label,
                      color=COLORS.get(addressing))
    resolutions = sorted({int(r["resolution"]) for r in rows})
    axes.set_xscale("log", base=2)
    axes.set_xticks(resolutions, [str(n) for n in resolutions])
    if y_log:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axes.yaxis.set_minor_formatter(ticker.NullFormatter())
    axes.set_title(title)
    axes.set_xlabel("resolution")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend(fontsize="small")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    ray_count = sys.argv[3] if len(sys.argv) == 4 else "128"
    rows = [r for r in rows if r["rays"] == ray_count]
    if not rows:
        sys.exit(f"plot_tables.py: no rows with {ray_count} rays in {sys.argv[1]}")
    nearest = [r for r in rows if r["masks"] == "nearest"]
    must_may = [r for r in rows if r["masks"] == "exact"]

    figure, panels = plt.subplots(2, 4, figsize=(20, 9))
    for axes, kind, name in ((panels[0], nearest, "nearest: wrong"), (panels[1], must_may, "must/may: in doubt")):
        if kind:
            for panel, column in zip(axes, ("edge_rays", "plane_rays", "triangle_rays")):
                draw(panel, kind, column, f"{name} rays of {ray_count}, {column.split('_')[0]}", by_nodes=False)
    if nearest:
        draw(panels[0][3], nearest, "mae", "nearest: mean absolute error", by_nodes=True)
        panels[0][3].axhline(0.25 / 255, color="black", linestyle=":")
    if must_may:
        draw(panels[1][3], must_may, "mrays_per_second", "must/may: Mrays/s", by_nodes=True, y_log=False)
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=90)


if __name__ == "__main__":
    main()
