#!/usr/bin/env python3
"""Check how the sources are divided into systems (one folder each).

A system is a folder of include/isochor/ and the folder of the same name in
source/. One uses another if a file of it includes a header of the other one.
The checks: headers and sources lie in folders of the same name; no system
uses, directly or through others, one that uses it; no file has more than 500
lines and no function more than 60 (function_lengths.py); the top level holds
what it should, and no output of a run; the picture and the table of large
classes in doc/architecture.md show what the files say.

    check_systems.py            exit code 1 and a list of what is wrong
    check_systems.py --picture  write both into doc/architecture.md
"""
import pathlib
import re
import subprocess
import sys

import class_sizes
import function_lengths

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc" / "architecture.md"
BEGIN = "<!-- systems: tests/check_systems.py --picture -->\n"
END = "<!-- end of systems -->\n"
LONGEST = 500
TOP = {"CMakeLists.txt", "LICENSE", "README.md", "doc", "include", "prm", "source",
       "tests"}
INCLUDE = re.compile(r"#include <isochor/(\w+)/([\w.]+)>")


def system_files():
    """All (system, path) of headers and sources, but the main program."""
    for pattern in ("include/isochor/*/*.h", "source/*/*.cc"):
        for path in sorted(ROOT.glob(pattern)):
            yield path.parent.name, path


def read_uses():
    """Per system, the systems whose headers its files include."""
    uses = {}
    for system, path in system_files():
        used = {match[1] for match in INCLUDE.finditer(path.read_text())}
        uses.setdefault(system, set()).update(used - {system})
    return uses


def reach(uses, system):
    """All systems that one uses, directly or through others."""
    found, rest = set(), list(uses[system])
    while rest:
        other = rest.pop()
        if other not in found:
            found.add(other)
            rest.extend(uses[other])
    return found


def picture(uses):
    """The systems and their arrows; those that follow from others left out."""
    lines = ["```mermaid", "flowchart TD"]
    for system in sorted(uses, key=lambda s: (-len(reach(uses, s)), s)):
        through = set().union(*(reach(uses, other) for other in uses[system]))
        lines += [f"  {system} --> {other}"
                  for other in sorted(uses[system] - through)]
    return "\n".join(lines + ["```\n"])


def strangers():
    """What git knows at the top level and should not be there; nothing if this
    is no clone."""
    try:
        listed = subprocess.run(["git", "ls-tree", "--name-only", "HEAD"], cwd=ROOT,
                                capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return []
    return [name for name in listed.splitlines()
            if name not in TOP and not name.startswith(".")]


def problems():
    for name in strangers():
        yield f"{name} does not belong to the top level"
    uses = read_uses()
    for system in sorted(uses):
        if system in reach(uses, system):
            yield f"{system} uses itself through {sorted(uses[system])}"
    headers = {path.stem: system for system, path in system_files()
               if path.suffix == ".h"}
    for system, path in system_files():
        if path.suffix == ".cc" and headers.get(path.stem, system) != system:
            yield f"{path.stem}: header in {headers[path.stem]}, source in {system}"
    everything = [path for _, path in system_files()] + [
        path for pattern in ("source/*.cc", "tests/*.cc", "doc/*/*.cc",
                             "include/isochor/*.h")
        for path in ROOT.glob(pattern)]
    for path in everything:
        n_lines = len(path.read_text().splitlines())
        if n_lines > LONGEST:
            yield f"{path.relative_to(ROOT)} has {n_lines} lines"
    if BEGIN + picture(uses) + END not in PAGE.read_text():
        yield ("the picture in doc/architecture.md is out of date: "
               "run tests/check_systems.py --picture")
    yield from function_lengths.problems(path for _, path in system_files())
    yield from class_sizes.problems(large_classes(), PAGE.read_text())


def large_classes():
    return class_sizes.large_classes(path for _, path in system_files())


def write(begin, end, text):
    """Into the page, between two lines."""
    page = PAGE.read_text()
    start, stop = page.index(begin) + len(begin), page.index(end)
    PAGE.write_text(page[:start] + text + page[stop:])


def main():
    if sys.argv[1:] == ["--picture"]:
        write(BEGIN, END, picture(read_uses()))
        write(class_sizes.BEGIN, class_sizes.END,
              class_sizes.table(large_classes(), PAGE.read_text()))
        return 0
    found = list(problems())
    print("\n".join(found) if found else "systems: no cycle, files as they should be")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
