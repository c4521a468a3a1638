# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What run.py, work.py, stability.py and solvers.py share: arguments, pictures, the end."""

import argparse
import os
import sys
from pathlib import Path

from harness import output


def parser(description, directory):
    """With the arguments that all have; results go to @p directory by default."""
    result = argparse.ArgumentParser(
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    result.add_argument("--executable", help="path of isochor")
    result.add_argument("--directory", type=Path, default=Path(directory))
    result.add_argument(
        "--publish", action="store_true", help="also change the documentation"
    )
    return result


def parse(result, runs=lambda arguments: True):
    """The arguments, the directory made, the program found if @p runs of them."""
    arguments = result.parse_args()
    arguments.directory = arguments.directory.resolve()
    arguments.directory.mkdir(parents=True, exist_ok=True)
    if runs(arguments):
        arguments.executable = os.path.abspath(
            arguments.executable or output.find_executable()
        )
    return arguments


def save(figure, path):
    """As PNG and SVG; @p path is without the suffix."""
    for suffix in ("png", "svg"):
        figure.savefig(f"{path}.{suffix}", bbox_inches="tight", dpi=110)
    output.plt.close(figure)


def end_with(main):
    """Run @p main and end the process with its code, or with a plain message."""
    try:
        sys.exit(main())
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
