"""Lines between the braces of functions. Reads the sources as text, by the
indentation that clang-format gives them."""
import re

LONGEST = 60
# Longer ones, each at most as long as it is: by file and function.
EXCEPTIONS = {
    ("mixed_kernel", "evaluate"): 115,
    ("mixed_kernel_points", "evaluate_points"): 112,
    ("surface_stress", "evaluate_in"): 99,
    ("grid_to_points", "transfer"): 78,
    ("body_pair_term", "find_elements"): 76,
    ("point_merging", "merge_points_of_cells"): 75,
}
NO_FUNCTION = re.compile(r"(if|for|while|switch|catch|class|struct|namespace)\b")
NAME = re.compile(r"(~?\w+|operator\S+)\(")


def head_of(lines, brace):
    """What stands before the brace, up to the end of what is before that."""
    head, i = "", brace - 1
    while i >= 0 and lines[i].strip() and not lines[i].strip().endswith(
            (";", "}", "{", "*/")):
        head = lines[i].strip() + " " + head
        i -= 1
    return head


def lengths(text):
    """(name, lines) of all functions; of what is defined in one, too."""
    lines, open_braces = text.split("\n"), []
    for i, line in enumerate(lines):
        indent = len(line) - len(line.lstrip())
        if line.strip() == "{":
            open_braces.append((i, indent))
        elif open_braces and line[indent:indent + 1] == "}" and \
                indent == open_braces[-1][1]:
            begin, _ = open_braces.pop()
            head = head_of(lines, begin)
            name = NAME.search(head)
            if name and not NO_FUNCTION.match(head):
                yield name[1], i - begin - 1


def problems(paths):
    for path in paths:
        for name, n in lengths(path.read_text()):
            most = EXCEPTIONS.get((path.name.split(".")[0], name), LONGEST)
            if n > most:
                yield f"{path.name}: {name}() has {n} lines, more than {most}"
