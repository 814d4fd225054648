#!/usr/bin/env python3
"""Draws how the time of detection grows: draw_growth.py BUILD FILE.svg [RESULT.json...]

Runs BUILD/bin/bench_growth, or takes what earlier runs have written with --benchmark_out, and draws
its curves on logarithmic axes. What grows in proportion to a size runs parallel to the dashed lines,
which begin at a curve's first point; what grows more slowly falls below them.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

PREFIX = "detector.growth."
FORMS = {"lab": ("everything on (lab.json)", "#b3441e"), "thesis": ("the thesis's form (chen2012.json)", "#1f5fa8")}
AXES = {
    "cells": ("cells of the ground grid", lambda x: f"{math.isqrt(x)}²"),
    "cameras": ("cameras of 752 x 480", str),
    "pixels": ("pixels of each of four views", lambda x: f"{x / 1000:.0f}k"),
}
WIDTH, HEIGHT, TOP, BOTTOM, LEFT, GAP = 300, 330, 52, 62, 64, 24
INK, FAINT = "#222", "#d8d8d8"


def curves_of(results):
    """{(form, axis): (exponent, [(size, ms), ...])} of Google Benchmark's JSON."""
    curves = {}
    for result in results:
        for run in result["benchmarks"]:
            figure = run["name"].split("/")[0]
            parts = figure.removeprefix(PREFIX).split(".")
            if len(parts) != 2 or run.get("error_occurred"):
                continue
            points = sorted(
                (int(m[1]), value) for key, value in run.items() if (m := re.fullmatch(r"ms at (\d+)", key))
            )
            curves[tuple(parts)] = (run[figure], points)
    missing = [f"{PREFIX}{form}.{axis}" for form in FORMS for axis in AXES if (form, axis) not in curves]
    if missing:
        sys.exit("draw_growth.py: no result of " + ", ".join(missing))
    return curves


def line(x1, y1, x2, y2, color, extra=""):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" {extra}/>'


def text(x, y, words, anchor="middle", color=INK, size=12, extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}" font-size="{size}" {extra}>{words}</text>'


def panel(left, axis, curves, low_ms, high_ms):
    title, label = AXES[axis]
    sizes = [size for size, _ in curves["lab", axis][1]]
    margin = (sizes[-1] / sizes[0]) ** 0.06
    low, high = sizes[0] / margin, sizes[-1] * margin

    def px(size):
        return left + WIDTH * math.log(size / low) / math.log(high / low)

    def py(ms):
        return TOP + HEIGHT * (1 - math.log(ms / low_ms) / math.log(high_ms / low_ms))

    out = []
    for ms in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000):
        if low_ms <= ms <= high_ms:
            out.append(line(left, py(ms), left + WIDTH, py(ms), FAINT))
            if axis == next(iter(AXES)):
                out.append(text(left - 8, py(ms) + 4, str(ms), "end"))
    for size in sizes:
        out.append(line(px(size), TOP, px(size), TOP + HEIGHT, FAINT))
        out.append(text(px(size), TOP + HEIGHT + 18, label(size)))
    out.append(text(left + WIDTH / 2, TOP + HEIGHT + 42, title, size=13))
    for form, (_, color) in FORMS.items():
        exponent, points = curves[form, axis]
        first_size, first_ms = points[0]
        end = min(high, first_size * high_ms / first_ms)  # where the line leaves the panel
        out.append(line(px(first_size), py(first_ms), px(end), py(first_ms * end / first_size), color,
                        'stroke-dasharray="5 4" opacity="0.55"'))
        path = " ".join(f"{px(size):.1f},{py(ms):.1f}" for size, ms in points)
        out.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"/>')
        out += [f'<circle cx="{px(size):.1f}" cy="{py(ms):.1f}" r="3.5" fill="{color}"/>' for size, ms in points]
        power = f"grows with size<tspan dy='-5' font-size='10'>{exponent:.2f}</tspan>"
        out.append(text(px(first_size), py(first_ms) + 24, power, "start", color))
    out.append(f'<rect x="{left}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>')
    return out


def drawn(curves):
    every_ms = [ms for _, points in curves.values() for _, ms in points]
    low_ms, high_ms = min(every_ms) / 2, max(every_ms) * 1.6
    width = LEFT + len(AXES) * (WIDTH + GAP)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{TOP + HEIGHT + BOTTOM}" '
        f'viewBox="0 0 {width} {TOP + HEIGHT + BOTTOM}" font-family="Helvetica, Arial, sans-serif">',
        '<rect width="100%" height="100%" fill="white"/>',
        text(16, TOP + HEIGHT / 2, "processor time per frame set, ms", size=13,
             extra=f'transform="rotate(-90 16 {TOP + HEIGHT / 2:.0f})"'),
    ]
    x = LEFT
    for words, color in FORMS.values():
        out += [line(x, 26, x + 28, 26, color, 'stroke-width="2"'), text(x + 36, 30, words, "start", color, 13)]
        x += 290
    out += [line(x, 26, x + 28, 26, "#666", 'stroke-dasharray="5 4"'),
            text(x + 36, 30, "linear growth from the first point", "start", "#666", 13)]
    for i, axis in enumerate(AXES):
        out += panel(LEFT + i * (WIDTH + GAP), axis, curves, low_ms, high_ms)
    return "\n".join(out + ["</svg>", ""])


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    build, picture, *files = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        if not files:
            files = [str(pathlib.Path(folder, "growth.json"))]
            subprocess.run([pathlib.Path(build, "bin", "bench_growth"), f"--benchmark_out={files[0]}",
                            "--benchmark_out_format=json"], check=True)
        curves = curves_of([json.loads(pathlib.Path(file).read_text()) for file in files])
    pathlib.Path(picture).write_text(drawn(curves))
    for (form, axis), (exponent, points) in curves.items():
        print(f"{PREFIX}{form}.{axis}: size^{exponent:.2f}, "
              + ", ".join(f"{size}: {ms:.1f} ms" for size, ms in points))
    print(f"written to {picture}")


if __name__ == "__main__":
    main()
