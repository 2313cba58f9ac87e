#!/usr/bin/python3
"""A real landing-pad deck with contact, all of it, against LS-DYNA's volume and pressure: writes landing_pad.csv and
landing_pad.md.

usage: landing_pad.py BUILD_FOLDER DECK_FOLDER [THREADS [RESULTS]]
DECK_FOLDER holds deck.k and abstat.ls-dyna. With RESULTS (a folder of billow with status normal) nothing is run.
"""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import stamp

HERE = pathlib.Path(__file__).resolve().parent
SNAP = 21000.0  # volume at which the pad's ring snaps through


def reference(path):
    """Rows (time, volume, pressure) of LS-DYNA's abstat."""
    rows = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if re.match(r"\s+\d\.\d+E[+-]\d\d\s+1\s", line):
            field = line.split()
            rows.append((float(field[0]), float(field[2]), float(field[3])))
    return rows


def history(path):
    with open(path, encoding="utf-8") as file:
        return [(float(r["time"]), float(r["volume"]), float(r["pressure"])) for r in csv.DictReader(file)]


def snap_time(rows):
    """When the volume first passes SNAP, between the states."""
    for before, after in zip(rows, rows[1:]):
        if before[1] < SNAP <= after[1]:
            return before[0] + (after[0] - before[0]) * (SNAP - before[1]) / (after[1] - before[1])
    return float("nan")


def compare(rows, other):
    """Rows (time, volume, its difference, pressure, its difference) at the states of both."""
    found = []
    for time, volume, pressure in other:
        near = min(rows, key=lambda row: abs(row[0] - time))
        if abs(near[0] - time) < 1e-2 and pressure > 1.0:
            found.append((time, near[1], near[1] / volume - 1, near[2], near[2] / pressure - 1))
    return found


def worst(found, low, high, column):
    return max((abs(row[column]) for row in found if low <= row[0] + 1e-3 and row[0] <= high + 1e-3), default=float("nan"))


def write(found, rows, other, summary):
    with open(HERE / "landing_pad.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["time", "volume_difference", "pressure_difference"])
        writer.writerows([(time, f"{dv:.6f}", f"{dp:.6f}") for time, _, dv, _, dp in found])
    lines = ["# A real landing pad with contact against LS-DYNA", "",
             f"{stamp.line()}. 4,200 deformable quadrilaterals and 3,208 rigid ones, two one-way contacts, "
             f"{summary['cycles']:,} cycles on {summary['threads']} thread(s); energy ratio "
             f"{summary['energy_ratio_min']:.7f} to {summary['energy_ratio_max']:.7f}.", "",
             "| what | largest difference | asked for |", "|---|---|---|"]
    for low, high in ((0.5, 10.0), (13.0, 20.0)):
        lines.append(f"| volume, {low:g} <= t <= {high:g} | {100 * worst(found, low, high, 2):.2f} % | 2 % |")
        lines.append(f"| pressure, {low:g} <= t <= {high:g} | {100 * worst(found, low, high, 4):.2f} % | 3 % |")
    # between states 0.5 apart, as LS-DYNA wrote them
    lines.append(f"| time at which the volume passes {SNAP:g} | {abs(snap_time(rows) - snap_time(other)):.3f} | 0.3 |")
    lines += ["", "| t | difference in volume | in pressure |", "|---|---|---|"]
    for time, _, dv, _, dp in found:
        lines.append(f"| {time:.1f} | {100 * dv:+.2f} % | {100 * dp:+.2f} % |")
    (HERE / "landing_pad.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    build, decks = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    threads = sys.argv[3] if len(sys.argv) > 3 else "2"
    with tempfile.TemporaryDirectory() as name:
        results = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else pathlib.Path(name) / "results"
        if len(sys.argv) <= 4:
            subprocess.run([build / "billow", "run", decks / "deck.k", "-o", results, "-j", threads, "--quiet"], check=True)
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        rows = history(results / "abstat.csv")
    if len(sys.argv) <= 4:
        print(f"{summary['loop_seconds']:.0f} s, {1e6 * summary['loop_seconds'] / summary['cycles']:.1f} us a cycle")
    other = reference(decks / "abstat.ls-dyna")
    write(compare(rows, other), rows, other, summary)


if __name__ == "__main__":
    main()
