"""Data members and functions of the classes, for the table of large ones in
doc/architecture.md. Reads the sources as text: enough for how they are written
here, as nested classes and inline bodies are left out by their braces."""
import re

# A class has at most this many data members; of those with more members than
# this, functions included, the table says why.
LARGE = 25
BEGIN = "<!-- classes: tests/check_systems.py --picture -->\n"
END = "<!-- end of classes -->\n"
HEAD = re.compile(r"\b(?:class|struct)\s+(\w+)(?:<[^<>{};]*>)?\s*"
                  r"(?::[^;{}()]*)?\{")
NO_MEMBER = re.compile(r"(class|struct|enum|using|friend|static_assert|"
                       r"ISOCHOR|static constexpr)\b")


def strip(text):
    """Without comments, strings and directives."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', '""', text)
    return re.sub(r"^\s*#.*$", "", text, flags=re.M)


def end_of_braces(text, begin):
    """The place behind the brace that closes the one at begin."""
    depth = 0
    for i in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return i + 1
    raise ValueError("braces don't match")


def without_arguments(statement):
    """Without what stands in <>, and without line breaks."""
    statement = re.sub(r"\s+", " ", statement).strip()
    before = None
    while statement != before:
        before, statement = statement, re.sub(r"<[^<>]*>", "", statement)
    return re.sub(r"^template\s*", "", statement)


def is_function(statement):
    return "(" in re.split(r"[={]", statement)[0]


def members(body):
    """(data members, functions) in what stands between a class's braces."""
    body = re.sub(r"\b(public|private|protected)\s*:", " ", body)
    data, functions, i, depth, statement = 0, 0, 0, 0, ""
    while i < len(body):
        char, ends = body[i], False
        depth += {"(": 1, ")": -1}.get(char, 0)
        if char == "{":
            i = end_of_braces(body, i)
            ends = depth == 0 and is_function(without_arguments(statement))
            statement += "{}"
        else:
            i += 1
            ends = char == ";"
            statement += "" if ends else char
        if not ends:
            continue
        whole, statement = without_arguments(statement), ""
        if not whole or NO_MEMBER.match(whole):
            continue
        if is_function(whole):
            functions += 1
        else:
            data += 1 + re.sub(r"\([^()]*\)", "", whole).count(",")
    return data, functions


def large_classes(paths):
    """By name (data members, functions) of those the table has to name."""
    found = {}
    for path in paths:
        text = strip(path.read_text())
        for match in HEAD.finditer(text):
            end = end_of_braces(text, match.end() - 1)
            sizes = members(text[match.end():end - 1])
            if sum(sizes) > LARGE:
                found[match[1]] = sizes
    return found


def table(found, page):
    """The table with these numbers, and the reasons that the page gives."""
    old = page[page.index(BEGIN) + len(BEGIN):page.index(END)]
    reasons = {row[1]: row[2] for row in
               re.finditer(r"\| `(\w+)` \| [^|]* \| ([^|]*) \|\n", old)}
    lines = ["| class | data + functions | why it is one |", "|---|---|---|"]
    for name in sorted(found, key=lambda n: (-sum(found[n]), n)):
        data, functions = found[name]
        lines.append(f"| `{name}` | {data} + {functions} | "
                     f"{reasons.get(name, '?')} |")
    return "\n".join(lines) + "\n"


def problems(found, page):
    for name, (data, _) in sorted(found.items()):
        if data > LARGE:
            yield f"{name} has {data} data members"
    expected = table(found, page)
    if BEGIN + expected + END not in page:
        yield ("the table of large classes in doc/architecture.md is out of "
               "date: run tests/check_systems.py --picture")
    if "| ? |" in expected:
        yield "the table of large classes lacks a reason"
