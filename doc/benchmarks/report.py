# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and pictures of what harness.py measured."""

import re

import numpy as np
import programs
from harness import (
    TOLERANCES,
    cheapest,
    front_of,
    observed_order,
    output,
    quantities,
)

plt = output.plt
MARKERS = "osD^vP*X"


def percent(value):
    return f"{100 * value:g} %"


def problems(rows):
    return list(dict.fromkeys(row["problem"] for row in rows))


def series_of(rows, problem):
    return list(
        dict.fromkeys(row["series"] for row in rows if row["problem"] == problem)
    )


# --------------------------------------------------------------- tables ---


def table(header, body):
    lines = ["| " + " | ".join(header) + " |"]
    lines.append("|" + "---|" * len(header))
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in body]
    return "\n".join(lines)


def tolerance_table(scene, rows):
    """The cheapest way to each error, problem by problem."""
    body = []
    for problem in problems(rows):
        for quantity in quantities(rows):
            if not any(
                f"error {quantity}" in r for r in rows if r["problem"] == problem
            ):
                continue
            for tolerance in TOLERANCES:
                row = cheapest(rows, problem, quantity, tolerance)
                if row is None:
                    body.append(
                        (problem, quantity, percent(tolerance), "not reached")
                        + ("",) * 4
                    )
                    break
                body.append(
                    (
                        problem,
                        quantity,
                        percent(tolerance),
                        row["series"],
                        f"{row['size']:g}",
                        f"{row['equations']:g}",
                        f"{row['cpu']:.2f}",
                        f"{row['memory']:.0f}",
                    )
                )
    return table(
        (
            "problem",
            "quantity",
            "error below",
            "cheapest choice",
            scene.size_label,
            "equations",
            "CPU s",
            "MB",
        ),
        body,
    )


def series_table(scene, rows):
    """All errors: a row for each series, a column for each size."""
    parts = []
    for quantity in quantities(rows):
        key = f"error {quantity}"
        chosen = [r for r in rows if key in r or r["status"] != "ok"]
        sizes = sorted({r["size"] for r in chosen})
        body = []
        for problem in problems(chosen):
            for series in series_of(chosen, problem):
                cells = []
                for size in sizes:
                    found = [
                        r
                        for r in chosen
                        if (r["problem"], r["series"], r["size"])
                        == (problem, series, size)
                    ]
                    if not found:
                        cells.append("")
                    elif key in found[0]:
                        spread = found[0].get(f"spread {quantity}")
                        bar = f" ± {100 * spread:.2g}" if spread is not None else ""
                        cells.append(
                            f"{100 * found[0][key]:+.3g}{bar} % ({found[0]['cpu']:.2f})"
                        )
                    else:
                        cells.append("failed")
                order = observed_order(rows, problem, series, quantity)
                cells.append(f"{order:.1f}" if order is not None else "")
                body.append([problem, series, *cells])
        header = ["problem", "choice"]
        header += [f"{size:g}" for size in sizes] + ["order"]
        parts.append(
            f"Error: {quantity} (CPU seconds), over the "
            f"{scene.size_label}; with ±, mean and standard deviation over places of "
            "the grid below the body:\n\n" + table(header, body)
        )
    return "\n\n".join(parts)


def anchor_table(scene, rows):
    """What others have measured, beside the program's own run of the same size
    and choice, if there is one; empty without anchors."""
    anchors = scene.anchors()
    if not anchors:
        return ""
    body = [
        (
            a.problem,
            a.quantity,
            a.label,
            f"{a.size:g}",
            f"{a.equations:g}",
            f"{100 * a.error:+.3g} %",
            f"{a.cpu:.2f}" if a.cpu else "",
        )
        for a in anchors
    ]
    sources = sorted({f"{a.label}: {a.source}" for a in anchors})
    return (
        "Others:\n\n"
        + table(
            (
                "problem",
                "quantity",
                "who",
                scene.size_label,
                "equations",
                "error",
                "CPU s",
            ),
            body,
        )
        + "\n\n"
        + "\n".join(f"- {source}" for source in sources)
    )


SOLVING = ("factorisation", "solution")


def phases_table(all_rows):
    """Where the wall time of the most expensive run of each scene goes."""
    body = []
    for scene, rows in all_rows.items():
        row = most_expensive(rows)
        if row is None:
            continue
        phases = phases_of(row)
        total = row["wall"]
        solving = sum(phases.get(name, 0.0) for name in SOLVING)
        others = (
            "assembly",
            "initialisation phase",
            "grid reset",
            "convective phase",
            "postprocessing",
            "setup",
            "start",
        )
        body.append(
            [
                f"{scene}: {row['problem']}, {row['series']}, {row['size']:g}",
                f"{total:.1f}",
                f"{100 * solving / total:.0f} %",
                *(f"{100 * phases.get(name, 0.0) / total:.0f} %" for name in others),
            ]
        )
    return table(
        [
            "run",
            "wall s",
            "factorisation and solution",
            "assembly",
            "initialisation",
            "grid reset",
            "points move",
            "output and probes",
            "set-up",
            "start and end",
        ],
        body,
    )


def insert(path, name, text):
    """Put @p text between the marks '<!-- NAME -->' and '<!-- end -->' of the
    file @p path; new marks go to its end."""
    content = path.read_text() if path.exists() else ""
    block = f"<!-- {name} -->\n\n{text.strip()}\n\n<!-- end of {name} -->"
    pattern = re.compile(
        rf"<!-- {re.escape(name)} -->.*?<!-- end of {re.escape(name)} -->",
        re.DOTALL,
    )
    if pattern.search(content):
        content = pattern.sub(lambda _: block, content)
    else:
        content = content.rstrip() + f"\n\n{block}\n"
    path.write_text(content)


# ------------------------------------------------------------- pictures ---


def draw_error_over(rows, scene, abscissa, label, quantity, path):
    """Error over cost, a panel for each problem; with the CPU time also the
    Pareto front over all choices."""
    names = [
        p
        for p in problems(rows)
        if any(f"error {quantity}" in r for r in rows if r["problem"] == p)
    ]
    figure, axes = plt.subplots(
        1,
        len(names),
        figsize=(3.9 * len(names) + 0.6, 4.3),
        sharey=True,
        squeeze=False,
        constrained_layout=True,
    )
    all_series = list(
        dict.fromkeys(r["series"] for r in rows if r["problem"] in names)
    )
    colours = plt.get_cmap("tab10")
    handles = {}
    for axis, problem in zip(axes[0], names):
        for series in series_of(rows, problem):
            number = all_series.index(series)
            points = sorted(
                (r["size"], r[abscissa], abs(r[f"error {quantity}"]))
                for r in rows
                if r["problem"] == problem
                and r["series"] == series
                and f"error {quantity}" in r
                and abscissa in r
            )
            if not points:
                continue
            _, x, y = zip(*points)
            floor = series.startswith("finite elements")
            (handles[series],) = axis.loglog(
                x,
                np.maximum(y, 1e-7),
                marker=MARKERS[number % len(MARKERS)],
                color="k" if floor else colours(number % 10),
                ls=":" if floor else "-",
                ms=4,
                lw=1.1,
            )
        draw_anchors(axis, scene, problem, quantity, abscissa, handles)
        if abscissa == "cpu":
            front = front_of(rows, problem, quantity)
            if front:
                x = [cost for cost, _, _ in front]
                y = [error for _, error, _ in front]
                x.append(x[-1] * 3)
                y.append(y[-1])
                (handles["Pareto front"],) = axis.step(
                    x, y, where="post", color="k", lw=2.5, alpha=0.35
                )
                row = front[-1][2]
                axis.set_title(
                    f"best: {row['series']}, {row['size']:g}",
                    fontsize=7,
                    loc="right",
                    y=-0.26,
                )
        set_ticks(axis)
        axis.set(title=problem, xlabel=label)
        axis.grid(True, which="major", color="0.9")
    axes[0][0].set_ylabel(f"relative error: {quantity}")
    figure.suptitle(scene.title)
    figure.legend(
        handles.values(),
        handles.keys(),
        loc="upper center",
        bbox_to_anchor=(0.5, -0.01),
        ncol=3,
        fontsize=8,
    )
    programs.save(figure, path)


def draw_anchors(axis, scene, problem, quantity, abscissa, handles):
    """What others have measured, as crosses."""
    chosen = [
        a
        for a in scene.anchors()
        if (a.problem, a.quantity) == (problem, quantity)
        and getattr(a, abscissa, None)
    ]
    for number, label in enumerate(dict.fromkeys(a.label for a in chosen)):
        places = [(getattr(a, abscissa), abs(a.error)) for a in chosen if a.label == label]
        x, y = zip(*sorted(places))
        (handles[label],) = axis.loglog(
            x, y, marker="x+1"[number % 3], color="0.35", ls="--", lw=0.7, ms=6
        )


def set_ticks(axis):
    """Round numbers on a logarithmic abscissa that spans about a decade."""
    low, high = axis.get_xlim()
    ticks = [
        m * 10.0**k
        for k in range(-2, 8)
        for m in ((1, 2, 5) if high / low < 100 else (1,))
        if low <= m * 10.0**k <= high
    ]
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.xaxis.set_minor_formatter(plt.NullFormatter())


def most_expensive(rows):
    done = [r for r in rows if r["status"] == "ok" and "wall" in r]
    return max(done, key=lambda r: r["wall"]) if done else None


def phases_of(row):
    """{phase: wall seconds} of a run, all of it; 'start' is loading, parsing and
    ending."""
    phases = {
        key[len("time ") :]: value
        for key, value in row.items()
        if key.startswith("time ") and isinstance(value, float)
    }
    # the reset is a part of the phase that begins with it, and has parts
    phases.pop("relocation", None)
    reset = phases.get("grid reset", 0.0)
    if "initialisation phase" in phases:
        phases["initialisation phase"] = max(
            0.0, phases["initialisation phase"] - reset
        )
    phases["start"] = max(0.0, row["wall"] - sum(phases.values()))
    return phases


def draw_sections(all_rows, path):
    """Where the time of the most expensive run of each scene goes: wall
    seconds of its phases; 'start' is loading, parsing and ending."""
    names, parts = [], []
    for scene, rows in all_rows.items():
        row = most_expensive(rows)
        if row is None:
            continue
        phases = phases_of(row)
        names.append(f"{scene}: {row['problem']}, {row['series']}, {row['size']:g}")
        parts.append(phases)
    if not parts:
        return
    figure, axis = plt.subplots(
        figsize=(10, 0.55 * len(names) + 1.8), constrained_layout=True
    )
    keys = list(dict.fromkeys(key for phases in parts for key in phases))
    left = np.zeros(len(names))
    totals = np.array([sum(phases.values()) for phases in parts])
    colours = plt.get_cmap("tab20")
    for number, key in enumerate(keys):
        widths = np.array([phases.get(key, 0.0) for phases in parts]) / totals
        axis.barh(names, widths, left=left, label=key, color=colours(number))
        left += widths
    axis.set(xlabel="share of the wall time", xlim=(0, 1))
    axis.invert_yaxis()
    axis.tick_params(axis="y", labelsize=7)
    axis.legend(
        ncol=5, fontsize=7, loc="lower center", bbox_to_anchor=(0.2, 1.0)
    )
    programs.save(figure, path)


__all__ = [
    "anchor_table",
    "phases_table",
    "draw_error_over",
    "draw_sections",
    "insert",
    "series_table",
    "tolerance_table",
]
