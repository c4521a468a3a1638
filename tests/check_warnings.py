#!/usr/bin/env python3
"""Compare the table of doc/warnings.md with what the program says of its warnings.

    check_warnings.py program          exit code 1 and the lines that differ
    check_warnings.py --write program  write the table
"""
import difflib
import pathlib
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / "doc" / "warnings.md"
BEGIN = "<!-- warnings: tests/check_warnings.py --write -->\n"
END = "<!-- end of warnings -->\n"


def main():
    program = sys.argv[-1]
    result = subprocess.run(
        [program, "--explain", "all"], capture_output=True, text=True, check=True
    )
    page = PAGE.read_text()
    start, stop = page.index(BEGIN) + len(BEGIN), page.index(END)
    if "--write" in sys.argv:
        PAGE.write_text(page[:start] + result.stdout + page[stop:])
        return 0
    differences = list(
        difflib.unified_diff(
            page[start:stop].splitlines(), result.stdout.splitlines(), lineterm="", n=0
        )
    )
    print("\n".join(differences) if differences else "OK")
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
