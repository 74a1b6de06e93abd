"""What the plots of static stages share: finding a stage in results.h5, and a grid of charts. Not a program."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def find(file, name, default=0):
    """Name and group of a stage of an open results.h5; without a name the first one, or that at another index. Exits where there is none."""
    stages = list(file.get("static", {}))
    if not stages:
        sys.exit("results.h5 has no static stage")
    if name and name not in stages:
        sys.exit(f"there is no stage '{name}', there are {', '.join(stages)}")
    name = name or stages[default]
    return name, file["static"][name]


def draw_grid(output, items, columns, size, labels, draw, **options):
    """Draws each item of a dict by draw(chart, item) into a chart with its name, `columns` in a row, of this size in inches, and saves all."""
    rows = -(-len(items) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(size[0] * columns, size[1] * rows), squeeze=False, **options)
    for chart, (name, item) in zip(axes.flat, items.items()):
        draw(chart, item)
        chart.set_title(name, fontsize=9)
        chart.tick_params(labelsize=7)
    for chart in axes.flat[len(items):]:
        chart.axis("off")
    for chart in axes[-1]:
        chart.set_xlabel(labels[0], fontsize=8)
    for chart in axes[:, 0]:
        chart.set_ylabel(labels[1], fontsize=8)
    figure.tight_layout()
    figure.savefig(output, dpi=110)
