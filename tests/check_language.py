#!/usr/bin/env python3
"""Check that pages and messages use the field's words: none of the terms below in
doc/, README files and in string literals of source/ and include/, and no sentence
of README.md and doc/method.md above 40 words. Exit code 1 and a list of what is
found.

    check_language.py --counts    words and lengths of sentences, too
"""
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TERMS = {  # what not to write: what the field's word is
    r"put(?:s|ting)? (?:it |them |the grid |each )?back": "reset",
    r"kept grids?|grids? (?:that is|that are|is) kept": "no reset",
    r"held|prescribed nodes?": "constrained, Dirichlet condition",
    r"lets? go|one-sided|but (?:don't|doesn't|do not|does not) pull|that only push(?:es)?":
        "unilateral contact",
    r"penalty springs?|springs of a surface": "penalty method",
    r"tied to filled cells": "aggregated degrees of freedom",
    r"hardly|a hair": "small cut, small support, little",
    r"nothing holds": "kinematically unconstrained",
    r"(?:gives?|gave) way": "collapse, limit load",
    r"told|is said|are said|says": "is reported, states",
    r"statics": "quasi-static analysis",
    r"(?:bodies|materials) that meet": "contact, material interface",
    r"parts of points' domains": "CPDI subdomain",
    r"(?:find|finds|finding|found) (?:an|no) equilibrium": "Newton's method converges",
    r"steps? that errs?": "local truncation error",
    r"motions? that jumps?": "discontinuous prescribed motion",
    r"laws? that softens?": "strain softening",
    r"(?:body|bodies) of revolution": "axisymmetric",
    r"hangs? (?:on|by|at) (?:a|one) vertex": "connected at a vertex only",
    r"wanders? off": "accumulate errors",
}
BAD = re.compile(r"\b(?:" + "|".join(TERMS) + r")\b", re.IGNORECASE)
LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
IDENTIFIERS = re.compile(r"`[^`\n]*`|\]\([^)\s]*\)")  # and targets of links
SHORT = {"README.md", "doc/method.md"}


def texts():
    """Names and texts of pages, and of string literals of a source."""
    pages = [ROOT / "README.md", *ROOT.glob("doc/**/*.md"), *ROOT.glob("prm/*/*.md")]
    for path in sorted(pages):
        if path.name != "changes.md":
            text = re.sub(r"```.*?```", "\n\n", path.read_text(), flags=re.DOTALL)
            yield path.relative_to(ROOT), IDENTIFIERS.sub("x", text)
    for path in sorted([*ROOT.glob("source/**/*.cc"), *ROOT.glob("include/**/*.h")]):
        for literal in LITERALS.findall(path.read_text()):
            literal = re.sub(r'"\s*"', "", literal)
            # the value of a parameter
            yield path.relative_to(ROOT), re.sub('"statics"|= statics|statics:', "", literal)


def sentences(text):
    """Words of each sentence; code, formulas, tables and headings aside."""
    text = re.sub(r"<[^>]*>|^(?:#|\||    ).*$", "\n", text, flags=re.MULTILINE)
    parts = re.split(r"(?<=[.!?])[)*]*\s+(?=[^a-z])|\n\s*\n|\n\s*[-*] |\n\d\. ", text)
    return [words for words in map(str.split, parts) if len(words) > 2]


def main():
    wrong = []
    for path, text in texts():
        for match in BAD.finditer(re.sub(r"\s+", " ", text)):
            wrong.append(f"{path}: '{match[0]}'")
        if str(path) in SHORT:
            wrong += [f"{path}: {len(s)} words: {' '.join(s)}"
                      for s in sentences(text) if len(s) > 40]
        if "--counts" in sys.argv and path.suffix == ".md":
            lengths = [len(s) for s in sentences(text)]
            print(f"{path}: {len(text.split())} words, median {statistics.median(lengths)}, longest {max(lengths)}")
    print("\n".join(wrong) if wrong else "OK")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
