#!/usr/bin/python3
"""Times what contact entities cost per probe and cycle, and writes tables (CSV, Markdown) beside this file.

usage: /usr/bin/python3 entities.py BUILD_FOLDER [--quick]

Scene: a sheet of 40,000 squares beside each shape, near enough that every node's distance from it is found in every
cycle, and touching none; then one that is pressed on a plane by all its nodes. What the time loop takes more than
without the entity is the entity's. Numbers come from summary.json; the best of the repeats counts.
"""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import stamp

HERE = pathlib.Path(__file__).resolve().parent
CELLS = 200
CYCLES = 300
RADIUS = 1.0
SHEET = 0.2 * RADIUS  # side of the sheet
HEIGHT = 0.9 * RADIUS  # of the sheet over the middle of the shape, which holds it


def profile(edges):
    """A closed body of revolution of so many edges, a ball's outline."""
    angles = [math.pi * (i / edges - 0.5) for i in range(edges + 1)]
    points = [(RADIUS * math.sin(a), max(RADIUS * math.cos(a), 0)) for a in angles]
    points[0], points[-1] = (-RADIUS, 0), (RADIUS, 0)
    return "*DEFINE_CURVE\n7\n" + "".join(f"{z:.12g},{r:.12g}\n" for z, r in points)


# name, GEOTYP, INOUT, the fields after it, XC to ZC, further cards
SHAPES = [
    ("plane", 1, 0, "0,0,0,0,0,1", "0,0,0", ""),
    ("finite plane", 10, 0, "1,1", "0,0,0", ""),
    ("sphere", 2, 1, f"0,0,0,{RADIUS}", "0,0,0", ""),
    ("infinite cylinder", 3, 1, f"0,0,0,1,0,0,{RADIUS}", "0,0,0", ""),
    ("ellipsoid", 4, 1, f"0,0,0,{1.2 * RADIUS},{1.1 * RADIUS},{RADIUS}", "0,0,0", ""),
    ("torus", 5, 1, f"0,0,0,{2 * RADIUS},{RADIUS}", f"0,{-2 * RADIUS},0", ""),
    ("body of revolution, 4 edges", 11, 1, "7", "0,0,0", None),
    ("body of revolution, 64 edges", 11, 1, "7", "0,0,0", None),
    ("convex mesh, 6 faces", 9, 1, "", "0,0,0", ""),
]


def sheet_deck(entity, pressed):
    """A sheet of fabric and a rigid box around it, which is the body of the entity."""
    lines = ["*KEYWORD", "*CONTROL_TERMINATION", f"1e3,{CYCLES}", "*NODE"]
    for j in range(CELLS + 1):
        for i in range(CELLS + 1):
            x, y = SHEET * (i / CELLS - 0.5), SHEET * (j / CELLS - 0.5)
            lines.append(f"{1 + i + j * (CELLS + 1)},{x:.9g},{y:.9g},{0 if pressed else HEIGHT:.9g}")
    first = (CELLS + 1) ** 2 + 1
    corners = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
    lines += [f"{first + k},{x * RADIUS},{y * RADIUS},{z * RADIUS}" for k, (x, y, z) in enumerate(corners)]
    lines.append("*ELEMENT_SHELL")
    for j in range(CELLS):
        for i in range(CELLS):
            a = 1 + i + j * (CELLS + 1)
            lines.append(f"{1 + i + j * CELLS},1,{a},{a + 1},{a + CELLS + 2},{a + CELLS + 1}")
    faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    lines += [f"{CELLS * CELLS + 1 + k},2," + ",".join(str(first + c) for c in f) for k, f in enumerate(faces)]
    lines += ["*PART", "sheet", "1,1,1", "*PART", "body", "2,1,2", "*SECTION_SHELL", "1,9", "3e-4",
              "*MAT_FABRIC", "1,800,2e8,2e8,0,0.3", "7.7e7", "", "", "", "", "*MAT_RIGID", "2,2000", "1,7,7", ""]
    if pressed:
        lines += ["*LOAD_BODY_Z", "9,10", "*DEFINE_CURVE", "9", "0,1", "1e6,1"]
    return "\n".join(lines) + "\n" + entity + "*END\n"


def entity_cards(shape):
    """The *CONTACT_ENTITY of one of SHAPES."""
    name, kind, inside, fields, centre, cards = shape
    if cards is None:
        cards = profile(int(name.split()[-2]))
    return f"*CONTACT_ENTITY\n2,{kind},1,1\n\n{centre},1,0,0\n0,1,0\n{inside},{fields}\n" + cards


def measure(build, folder, text, threads, repeats):
    """Seconds of the loop per cycle, best of the repeats."""
    deck = f"{folder}/deck.k"
    pathlib.Path(deck).write_text(text, encoding="utf-8")
    best = math.inf
    for _ in range(repeats):
        command = [f"{build}/billow", "run", deck, "-o", f"{folder}/results", "-j", str(threads), "--quiet"]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode:
            sys.exit(f"failed: {' '.join(command)}\n{done.stderr}")
        with open(f"{folder}/results/summary.json", encoding="utf-8") as file:
            summary = json.load(file)
        best = min(best, summary["loop_seconds"] / summary["cycles"])
    return best


def measure_shapes(build, folder, repeats):
    """A row for each shape, and for the pressed sheet."""
    probes, rows = (CELLS + 1) ** 2, []
    without = {threads: measure(build, folder, sheet_deck("", False), threads, repeats) for threads in (1, 2)}
    for shape in SHAPES:
        row = {"shape": shape[0]}
        for threads in (1, 2):
            loop = measure(build, folder, sheet_deck(entity_cards(shape), False), threads, repeats)
            row[f"ns_{threads}_threads"] = 1e9 * (loop - without[threads]) / probes
        rows.append(row)
        print(f"{shape[0]:32} {row['ns_1_threads']:7.2f} ns, two threads {row['ns_2_threads']:7.2f} ns", flush=True)
    row = {"shape": "plane, all touching"}
    for threads in (1, 2):
        free = measure(build, folder, sheet_deck("", True), threads, repeats)
        loop = measure(build, folder, sheet_deck(entity_cards(SHAPES[0]), True), threads, repeats)
        row[f"ns_{threads}_threads"] = 1e9 * (loop - free) / probes
    print(f"{row['shape']:32} {row['ns_1_threads']:7.2f} ns, two threads {row['ns_2_threads']:7.2f} ns", flush=True)
    return rows + [row]


def write_tables(rows):
    """entities.csv and entities.md."""
    with open(HERE / "entities.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.3f}" if isinstance(value, float) else value for key, value in row.items()}
                         for row in rows)
    lines = ["# Cost of contact entities", "",
             f"Nanoseconds per probe and cycle, {(CELLS + 1) ** 2} nodes. {stamp.line()}.", "",
             "What the time loop takes more with a *CONTACT_ENTITY than without: every node's distance is found in every",
             "cycle, none touches; the last row has all nodes pressed on a plane, with their forces. Nodes beyond the",
             "farthest point of a bounded shape cost as little as those near a plane. A first share of some nanoseconds",
             "is the same for all: the barriers and the rows of contact.", "",
             "| shape | one thread | two threads |", "|---|---|---|"]
    lines += [f"| {row['shape']} | {row['ns_1_threads']:.1f} | {row['ns_2_threads']:.1f} |" for row in rows]
    (HERE / "entities.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build, quick = sys.argv[1], "--quick" in sys.argv
    with tempfile.TemporaryDirectory() as folder:
        rows = measure_shapes(build, folder, 1 if quick else 5)
    if not quick:
        write_tables(rows)


if __name__ == "__main__":
    os.environ.pop("OMP_NUM_THREADS", None)
    main()
