#!/usr/bin/env python3
"""Check that links and pictures of all pages lead to files and headings that are
there. Exit code 1 and a list of those that don't."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)\s]+)\)|(?:href|src)=\"([^\"]+)\"")


def pages():
    """All pages, but those of build directories and of output."""
    for path in sorted(ROOT.rglob("*.md")):
        folders = path.relative_to(ROOT).parts[:-1]
        if not any(name.startswith(("build", "output", ".")) for name in folders):
            yield path


def anchors(page):
    """What '#' may be followed by in a link to @p page, as GitHub makes it."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    return {
        re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
        for title in titles
    }


def main():
    wrong = []
    for page in pages():
        for match in LINK.finditer(page.read_text()):
            link = match[1] or match[2]
            if "://" in link:
                continue
            path, _, anchor = link.partition("#")
            target = page.parent / path if path else page
            if not target.exists() or (anchor and anchor not in anchors(target)):
                wrong.append(f"{page.relative_to(ROOT)}: {link}")
    print("\n".join(wrong) if wrong else "OK")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
