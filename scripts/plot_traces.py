# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Draws frames under a time budget as a picture. usage: plot_traces.py OUT.png [RUN] FILE.csv…

The files are of `gloam bench governor --out DIR`. Each is a column: frame times with the budget, setting and error over time,
of the middle budget's run of this name (path, standing, load; default path). Needs chromium."""
import csv
import pathlib
import subprocess
import sys
import tempfile

WIDTH, HEIGHT, LEFT, TOP, GAP = 300, 110, 58, 34, 26
INK, LINE, FRAME, BUDGET = "#222", "#ddd", "#2b6cb0", "#c05621"


def read_run(path, name):
    """Columns of the run at the middle of the file's budgets."""
    rows = [row for row in csv.DictReader(open(path)) if row["run"] == name]
    if not rows:
        sys.exit(f"{path}: no run is named {name}")
    budgets = sorted({float(row["budget_ms"]) for row in rows})
    budget = budgets[len(budgets) // 2]
    rows = [row for row in rows if float(row["budget_ms"]) == budget]
    seconds, at = [], 0.0
    for row in rows:
        at += float(row["ms"]) / 1e3
        seconds.append(at)
    return budget, seconds, [float(row["ms"]) for row in rows], [int(row["point"]) for row in rows], [float(row["error"]) for row in rows]


def panel(x, y, title, seconds, values, top, budget=None, steps=False):
    """One diagram from 0 to `top`."""
    def at(second, value):
        return x + WIDTH * second / seconds[-1], y + HEIGHT * (1 - min(value, top) / top)

    parts = [f'<text x="{x}" y="{y - 6}" fill="{INK}">{title}</text>',
             f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="{LINE}"/>']
    for value in (0, top / 2, top):
        parts.append(f'<text x="{x - 5}" y="{at(0, value)[1] + 4:.1f}" text-anchor="end" fill="{INK}">{value:.3g}</text>')
    if budget:
        line = at(0, budget)[1]
        parts.append(f'<line x1="{x}" x2="{x + WIDTH}" y1="{line:.1f}" y2="{line:.1f}" stroke="{BUDGET}" stroke-dasharray="5 3"/>')
        parts.append(f'<text x="{x + WIDTH - 4}" y="{line - 4:.1f}" text-anchor="end" fill="{BUDGET}">budget {budget:.3g} ms</text>')
    points, last = [], None
    for second, value in zip(seconds, values):
        if steps and last is not None:
            points.append(at(second, last))
        points.append(at(second, value))
        last = value
    path = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
    parts.append(f'<polyline points="{path}" fill="none" stroke="{FRAME}" stroke-width="1"/>')
    return parts


def column(index, path, name):
    budget, seconds, times, points, errors = read_run(path, name)
    x, rows = LEFT + index * (WIDTH + LEFT), [TOP + row * (HEIGHT + GAP) for row in range(3)]
    parts = panel(x, rows[0], f"{pathlib.Path(path).stem}, {name}: ms of a frame", seconds, times, 2 * budget, budget)
    parts += panel(x, rows[1], "setting, from the fastest", seconds, [point + 1 for point in points], max(points) + 2, steps=True)
    parts += panel(x, rows[2], "error (mean FLIP)", seconds, errors, 1.25 * max(max(errors), 0.01), steps=True)
    parts.append(f'<text x="{x + WIDTH}" y="{rows[2] + HEIGHT + 16}" text-anchor="end" fill="{INK}">{seconds[-1]:.0f} s</text>')
    return parts


def main(out, name, files):
    width, height = len(files) * (WIDTH + LEFT) + 20, TOP + 3 * (HEIGHT + GAP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="11">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for index, path in enumerate(files):
        parts += column(index, path, name)
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "traces.svg"
        page.write_text("\n".join(parts + ["</svg>"]))
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--user-data-dir={folder}/profile",
                        f"--window-size={width},{height}", f"--screenshot={pathlib.Path(out).resolve()}", page.as_uri()],
                       check=True, capture_output=True)


if __name__ == "__main__":
    arguments = sys.argv[1:]
    run = arguments.pop(1) if len(arguments) > 1 and not arguments[1].endswith(".csv") else "path"
    if len(arguments) < 2 or not all(path.endswith(".csv") for path in arguments[1:]):
        sys.exit(__doc__.split("\n\n")[0])
    main(arguments[0], run, arguments[1:])
