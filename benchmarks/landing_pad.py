#!/usr/bin/python3
"""A real landing-pad deck with contact, all of it, against LS-DYNA's volume and pressure: writes landing_pad.csv,
landing_pad.md and landing_pad.png. The deck once as it is, then several times with its coordinates changed a little: how
far such runs part is chance.

usage: landing_pad.py BUILD_FOLDER DECK_FOLDER [THREADS]     DECK_FOLDER holds deck.k and abstat.ls-dyna.
"""
import concurrent.futures
import csv
import json
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile

from matplotlib import pyplot

import stamp

HERE = pathlib.Path(__file__).resolve().parent
SNAP = 21000.0  # volume at which the pad's ring snaps through
MEMBERS = 8
PERTURBATION = 1e-6


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


def perturbed(deck, seed):
    """The deck with all coordinates changed at random by up to PERTURBATION of themselves."""
    draw, lines, in_nodes = random.Random(seed), [], False
    for line in deck.splitlines():
        if line.startswith("*"):
            in_nodes = line.upper().startswith("*NODE")
        elif in_nodes and not line.startswith("$"):
            places = [float(line[8 + 16 * k:24 + 16 * k] or 0) * (1 + PERTURBATION * draw.uniform(-1, 1)) for k in range(3)]
            line = line[:8] + "".join(f"{place:16.9g}" for place in places) + line[56:]
        lines.append(line)
    return "\n".join(lines) + "\n"


def run_member(billow, deck, folder, seed):
    """One run of the perturbed deck on one thread; its volume and pressure."""
    path = folder / f"member{seed}.k"
    path.write_text(perturbed(deck, seed), encoding="utf-8")
    subprocess.run([billow, "run", path, "-o", folder / f"member{seed}", "-j", "1", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return history(folder / f"member{seed}" / "abstat.csv")


def run_members(billow, deck, folder):
    """MEMBERS runs, as many at a time as the machine has processors."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda seed: run_member(billow, deck, folder, seed), range(1, MEMBERS + 1)))


def judge(found, snap, other):
    """The lines of what is asked for and what a run has."""
    lines = ["| what | largest difference | asked for |", "|---|---|---|"]
    for low, high in ((0.5, 10.0), (13.0, 20.0)):
        lines.append(f"| volume, {low:g} <= t <= {high:g} | {100 * worst(found, low, high, 2):.2f} % | 2 % |")
        lines.append(f"| pressure, {low:g} <= t <= {high:g} | {100 * worst(found, low, high, 4):.2f} % | 3 % |")
    # between states 0.5 apart, as LS-DYNA wrote them
    return lines + [f"| time at which the volume passes {SNAP:g} | {abs(snap - snap_time(other)):.3f} | 0.3 |"]


def spread_lines(members, other):
    """The table of the members' differences from LS-DYNA by time."""
    lines = ["| t | as it is | mean | deviation | least | largest |", "|---|---|---|---|---|---|"]
    for states in zip(*members):
        volumes = [100 * state[2] for state in states]
        rest = volumes[1:]
        lines.append(f"| {states[0][0]:.1f} | {volumes[0]:+.2f} | {statistics.mean(rest):+.2f} | {statistics.stdev(rest):.2f} | "
                     f"{min(rest):+.2f} | {max(rest):+.2f} |")
    return lines


def write(members, histories, other, summary):
    """members: differences of the run as it is, then of the perturbed ones; histories likewise."""
    with open(HERE / "landing_pad.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["run", "time", "volume_difference", "pressure_difference"])
        for run, found in enumerate(members):
            writer.writerows([(run, time, f"{dv:.6f}", f"{dp:.6f}") for time, _, dv, _, dp in found])
    snaps = [snap_time(rows) for rows in histories]
    lines = ["# A real landing pad with contact against LS-DYNA", "",
             f"{stamp.line()}. 4,200 deformable quadrilaterals (156 of them implicit) and 3,208 rigid ones, two one-way contacts, "
             f"{summary['cycles']:,} cycles on {summary['threads']} thread(s) in {summary['loop_seconds']:.0f} s "
             f"({1e6 * summary['loop_seconds'] / summary['cycles']:.0f} us each; 900 s asked for); energy ratio "
             f"{summary['energy_ratio_min']:.7f} to {summary['energy_ratio_max']:.7f}.", "", *judge(members[0], snaps[0], other)]
    if len(members) > 1:
        inside = sum(min(s[2] for s in states[1:]) <= 0 <= max(s[2] for s in states[1:]) for states in zip(*members))
        lines += ["", "## What of it is chance", "",
                  f"{MEMBERS} runs of the same deck, all coordinates changed at random by up to {PERTURBATION:g} of themselves. "
                  "Differences of their volumes from LS-DYNA's in percent:", "",
                  "![volume over time](landing_pad.png)", "", *spread_lines(members, other), "",
                  f"LS-DYNA's volume, itself one run, is between the least and the largest of the members in {inside} of "
                  f"{len(members[0])} states. Their volumes pass {SNAP:g} at "
                  + ", ".join(f"{snap:.2f}" for snap in sorted(snaps[1:])) + f"; LS-DYNA's at {snap_time(other):.2f}."]
    (HERE / "landing_pad.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def plot(histories, other):
    figure, axes = pyplot.subplots(figsize=(7, 4), dpi=120)
    for k, rows in enumerate(histories):
        axes.plot([r[0] for r in rows], [r[1] for r in rows], color="0.6" if k else "tab:blue", lw=0.8 if k else 1.6,
                  zorder=1 if k else 2, label=["billow", "coordinates changed by 1e-6"][k] if k < 2 else None)
    axes.plot([r[0] for r in other], [r[1] for r in other], "k.", ms=5, zorder=3, label="LS-DYNA")
    axes.set(xlabel="time", ylabel="volume")
    axes.legend()
    figure.tight_layout()
    figure.savefig(HERE / "landing_pad.png")


def main():
    build, decks = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    threads = sys.argv[3] if len(sys.argv) > 3 else "2"
    other = reference(decks / "abstat.ls-dyna")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([build / "billow", "run", decks / "deck.k", "-o", folder / "results", "-j", threads, "--quiet"], check=True)
        summary = json.loads((folder / "results" / "summary.json").read_text(encoding="utf-8"))
        histories = [history(folder / "results" / "abstat.csv")]
        print(f"{summary['loop_seconds']:.0f} s, {1e6 * summary['loop_seconds'] / summary['cycles']:.1f} us a cycle", flush=True)
        histories += run_members(build / "billow", (decks / "deck.k").read_text(encoding="utf-8"), folder)
    write([compare(rows, other) for rows in histories], histories, other, summary)
    plot(histories, other)


if __name__ == "__main__":
    main()
