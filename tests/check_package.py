#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Install the project and, where cpack and dpkg are, make a Debian package and unpack it;
run a scene and the Python module of each tree.

    check_package.py CMAKE BUILD

Works in the directory 'package' below the present one. Exit code 1 if something fails.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

PLACE = Path("package").resolve()
# Installed by itself, the program doesn't know of the build directory.
SCRIPT = """
import sys
sys.path.insert(0, sys.argv[1] + "/prm/tools")
import isochor
print(isochor.find_executable())
run = isochor.run(sys.argv[1] + "/prm/tutorial/bar.prm", {"Time/Step size": 0.5})
assert run.error is None, run.error
print(run.statistics["Time"][-1])
"""
FILES = ("README.md", "doc/tutorial.md", "doc/benchmarks/scenes/necking.geo",
         "prm/tools/plot.py", "prm/strip_footing/run.py", "prm/stl_tool/punch.stl",
         "prm/cooks_membrane/membrane.geo", "prm/cooks_membrane/reference.json")


def call(*command):
    """What the command prints; ends the program if it fails."""
    environment = {k: v for k, v in os.environ.items() if k != "ISOCHOR"}
    result = subprocess.run([str(word) for word in command], cwd=PLACE, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env=environment)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stdout}")
    return result.stdout


def check_tree(prefix):
    """Run a scene of the tree, a scene with a file beside it, and Python."""
    share = prefix / "share" / "isochor"
    program = prefix / "bin" / "isochor"
    missing = [name for name in FILES if not (share / name).is_file()]
    results = [path for path in share.rglob("*.vtu")] + list(share.rglob("__pycache__"))
    if missing or results:
        sys.exit(f"{prefix}: missing {missing}, too much {results}")
    text = call(program, share / "prm" / "tutorial" / "bar.prm")
    if "No warnings." not in text:
        sys.exit(text)
    call(program, "--validate", share / "prm" / "stl_tool" / "stl_tool.prm")
    found = call(sys.executable, "-B", "-c", SCRIPT, share).split()
    if found != [str(program), "1.0"]:
        sys.exit(f"Python: {found}")
    print(f"{prefix}: OK")


def check_package(cpack, build):
    call(cpack, "-G", "DEB", "--config", build / "CPackConfig.cmake", "-B", PLACE)
    package = next(PLACE.glob("isochor_*.deb"))
    fields = call("dpkg", "--field", package)
    depends = re.search("^Depends: (.*)$", fields, re.MULTILINE)
    for library in ("libdeal.ii", "libmumps", "libopenmpi", "libc6"):
        if not depends or library not in depends.group(1):
            sys.exit(f"no dependency on {library}:\n{fields}")
    print(fields)
    call("dpkg", "-x", package, PLACE / "root")
    if not (PLACE / "root/usr/share/doc/isochor/copyright").is_file():
        sys.exit("no copyright")
    check_tree(PLACE / "root" / "usr")


def main():
    cmake, build = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(PLACE, ignore_errors=True)
    PLACE.mkdir()
    call(cmake, "--install", build, "--prefix", PLACE / "installed")
    check_tree(PLACE / "installed")
    cpack = Path(cmake).with_name("cpack")
    tools = ("dpkg", "dpkg-deb", "dpkg-shlibdeps")
    if cpack.is_file() and all(map(shutil.which, tools)):
        check_package(cpack, build)
    return 0


if __name__ == "__main__":
    sys.exit(main())
