#!/usr/bin/python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw columns of statistics.txt, one over another: load over displacement.

    plot.py output --y "Reaction y on bottom (N)"                  over the time
    plot.py output --x "Displacement y of tip" --y "Reaction y on left" --live
    plot.py coarse fine --y "Reaction y on bottom" --scale-y -1e-3 --save load.png

The arguments are directories of runs or files of this form; names of columns may lack
the unit. Without --y the columns are listed.
"""

import argparse
import sys
from pathlib import Path

import isochor


def curves(arguments):
    """(label, x, y) of each run and each column of --y."""
    result = []
    for place in arguments.runs:
        statistics = isochor.read_statistics(place)
        for name in arguments.y:
            label = str(place) if len(arguments.runs) > 1 else ""
            if len(arguments.y) > 1:
                label += f"{', ' if label else ''}{name}"
            x = arguments.scale_x * statistics[arguments.x]
            result.append((label, x, arguments.scale_y * statistics[name]))
    return result


def draw(axes, arguments):
    axes.clear()
    for label, x, y in curves(arguments):
        axes.plot(x, y, arguments.style, label=label)
    for scale, name, set_label in (
        (arguments.scale_x, arguments.x, axes.set_xlabel),
        (arguments.scale_y, ", ".join(arguments.y), axes.set_ylabel),
    ):
        set_label(name if scale == 1 else f"{scale:g} × {name}")
    axes.grid(alpha=0.3)
    if len(axes.lines) > 1:
        axes.legend()


def follow(figure, axes, plt, arguments):
    """Draw anew whenever a run has written a row, until the window is closed, or
    Ctrl-C where a picture is written."""
    shown = None
    while plt.fignum_exists(figure.number):
        try:
            points = sum(len(x) for _, x, _ in curves(arguments))
            if points != shown:
                draw(axes, arguments)
                shown = points
                if arguments.save:
                    figure.savefig(arguments.save)
        except isochor.OutputError as error:  # not there yet, or while a row is written
            axes.set_title(str(error).split(". ")[0], fontsize=8)
        figure.canvas.draw_idle()
        plt.pause(arguments.live)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("runs", nargs="+", type=Path, metavar="RUN")
    parser.add_argument("--x", default="Time (s)", metavar="COLUMN")
    parser.add_argument("--y", nargs="+", default=[], metavar="COLUMN")
    parser.add_argument("--scale-x", type=float, default=1, help="factor on x")
    parser.add_argument("--scale-y", type=float, default=1, help="factor on y")
    parser.add_argument("--style", default="-", help="of Matplotlib, as o-")
    parser.add_argument("--save", metavar="FILE", help="write a picture, show none")
    parser.add_argument(
        "--live",
        nargs="?",
        type=float,
        const=1,
        metavar="SECONDS",
        help="draw anew while the run goes on, each second or so many",
    )
    return parser.parse_intermixed_args()


def main():
    arguments = parse_arguments()
    if not arguments.y:
        for place in arguments.runs:
            print("\n".join(isochor.read_statistics(place)))
        return
    import matplotlib

    if arguments.save:
        matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(layout="constrained")
    if arguments.live:
        follow(figure, axes, plt, arguments)
        return
    draw(axes, arguments)
    if arguments.save:
        figure.savefig(arguments.save)
    else:
        plt.show()


if __name__ == "__main__":
    try:
        main()
    except isochor.OutputError as problem:
        sys.exit(f"Error: {problem}")
    except KeyboardInterrupt:
        pass
