#!/usr/bin/env python3
"""Draws a figure of several runs as bars, by matplotlib.

    plot.py PICTURE.png FIGURE LABEL=STATISTICS.json...
    plot.py caches.png "cycles render" none=off.json "8 lines"=1x8.json
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def figure_of(path, names):
    with open(path) as file:
        value = json.load(file)
    for name in names:
        value = value[name]
    return value


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    picture, figure, *runs = sys.argv[1:]
    bars = dict(run.split("=", 1) for run in runs)
    plt.bar(list(bars), [figure_of(path, figure.split()) for path in bars.values()])
    plt.ylabel(figure)
    plt.savefig(picture)


if __name__ == "__main__":
    main()
