#!/usr/bin/env python3
"""Drops the sphere and the box on cushions that leak more and more: prints and plots peak acceleration over leakage.

usage: sweep.py BUILD_FOLDER [-o impactor-drop.png] [-j THREADS]

Needs python3-matplotlib for the plot. Each run takes a second or two; all takes half a minute. The impactors may be
chosen: --impactors sphere box capsule.
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

GRAVITY = 9.81
COEFFICIENTS = (0, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0)
AREA = 2e-3  # A23 of the deck [m2]
MEAN = 3e-3  # span of the mean acceleration [s]
IMPACTORS = {"sphere": 0.0825, "box": 0.06, "capsule": 0.06}  # from the centre down to the lowest point [m]


def with_coefficient(deck, coefficient):
    """The deck with another C23."""
    lines = deck.splitlines()
    card = next(i for i, line in enumerate(lines) if line.startswith("$      c23")) + 1
    lines[card] = f"{coefficient:10g}" + lines[card][10:]
    return "\n".join(lines) + "\n"


def judge(path, drop):
    """Peak and largest mean acceleration in g, least clearance and last velocity of the body in rbdout.csv."""
    with open(path, encoding="utf-8") as file:
        rows = [(float(r["time"]), float(r["z"]), float(r["vz"]), float(r["az"])) for r in csv.DictReader(file)]
    span = max(1, round(MEAN / (rows[1][0] - rows[0][0])))
    means = [(b[2] - a[2]) / (b[0] - a[0]) for a, b in zip(rows, rows[span:])]
    return max(r[3] for r in rows) / GRAVITY, max(means) / GRAVITY, min(r[1] for r in rows) - drop, rows[-1][2]


def sweep(build, threads, impactors):
    """One row per run: impactor, leakage [cm2], peak [g], 3 ms value [g], clearance [m], last velocity [m/s]."""
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for impactor in impactors:
            drop = IMPACTORS[impactor]
            made = subprocess.run([build / "make_deck", f"impactor-{impactor}"], check=True, capture_output=True, text=True)
            for coefficient in COEFFICIENTS:
                deck, results = folder / "drop.k", folder / "drop"
                deck.write_text(with_coefficient(made.stdout, coefficient), encoding="utf-8")
                subprocess.run([build / "billow", "run", deck, "-o", results, "-j", str(threads), "--quiet"], check=True,
                               stdout=subprocess.DEVNULL)
                rows.append((impactor, 1e4 * coefficient * AREA, *judge(results / "rbdout.csv", drop)))
                print("%-8s %5.1f cm2  peak %5.1f g  3 ms %5.1f g  clearance %6.3f m  last velocity %5.2f m/s%s" %
                      (*rows[-1], "  (reaches the floor)" if rows[-1][4] < 0 else ""), flush=True)
    return rows


def draw(rows, path):
    """Accelerations above, clearance below, over the leakage."""
    import matplotlib.pyplot as plt
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(6, 6))
    for impactor, mark in zip(IMPACTORS, "os^"):
        mine = [r for r in rows if r[0] == impactor]
        if not mine:
            continue
        line, = upper.plot([r[1] for r in mine], [r[3] for r in mine], marker=mark, label=f"{impactor}, 3 ms")
        upper.plot([r[1] for r in mine], [r[2] for r in mine], marker=mark, markersize=3, linestyle=":",
                   color=line.get_color(), label=f"{impactor}, peak")
        lower.plot([r[1] for r in mine], [1000 * r[4] for r in mine], marker=mark, label=impactor)
    lower.axhline(0, color="grey", linewidth=0.8)
    upper.set_ylabel("acceleration [g]")
    lower.set_ylabel("least clearance above the floor [mm]")
    lower.set_xlabel("vent coefficient x area [cm2]")
    for axis in (upper, lower):
        axis.grid(True, alpha=0.3)
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("-o", "--output", default="impactor-drop.png")
    parser.add_argument("-j", "--threads", type=int, default=1)
    parser.add_argument("--impactors", nargs="+", choices=IMPACTORS, default=["sphere", "box"])
    options = parser.parse_args()
    try:  # before half a minute of runs
        import matplotlib
    except ImportError:
        sys.exit(f"{sys.executable} has no matplotlib; install python3-matplotlib and use the system's python3")
    matplotlib.use("Agg")
    draw(sweep(options.build.resolve(), options.threads, options.impactors), options.output)


if __name__ == "__main__":
    main()
