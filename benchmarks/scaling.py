#!/usr/bin/python3
"""Two-core scaling of the examples with contact: time per element and cycle on one and two threads over the number of
elements. Writes scaling.csv, scaling.md and scaling.png. Run it on a quiet machine.

usage: scaling.py BUILD_FOLDER [--quick]    --quick: small meshes, one run each, writes nothing
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import stamp

HERE = pathlib.Path(__file__).resolve().parent
# name in make_deck, cells of the meshes, end time [s]
SCENES = [
    ("driver-bag", (10, 20, 40), 0.004),
    ("folded-bag", (24, 48, 72), 0.008),
    ("impactor-sphere", (12, 24, 48), 0.02),
    ("landing-pad", (8, 16, 32), 0.004),
]
COLUMNS = ["scene", "elements", "cycles", "threads", "ns_per_element_cycle", "speed_up", "contact_share", "search_share"]


def run(billow, deck, folder, threads, end):
    subprocess.run([billow, "run", deck, "-o", folder / "results", "-j", str(threads), "--quiet", "--end-time", str(end)],
                   check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    return json.loads((folder / "results" / "summary.json").read_text(encoding="utf-8"))


def measure(build, quick):
    rows = []
    repeats = 1 if quick else 3
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scene, cells, end in SCENES:
            for n in cells[:1] if quick else cells:
                deck = folder / "deck.k"
                made = subprocess.run([build / "make_deck", scene, "-n", str(n)], check=True, capture_output=True)
                deck.write_bytes(made.stdout)
                one = None
                for threads in (1, 2):
                    runs = [run(build / "billow", deck, folder, threads, end / 10 if quick else end) for _ in range(repeats)]
                    best = min(runs, key=lambda s: s["loop_seconds"])
                    time, total = best["ns_per_element_cycle"], best["timing"]["total"]
                    one = one or time
                    rows.append([scene, best["elements"], best["cycles"], threads, f"{time:.2f}", f"{one / time:.2f}",
                                 f"{best['timing']['contact'] / total:.3f}", f"{best['timing']['search'] / total:.3f}"])
                    print(*rows[-1], flush=True)
    return rows


def write(rows):
    with open(HERE / "scaling.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows(rows)
    lines = ["# Two cores", "", f"{stamp.line()}. Best of three runs; time loop without output.", "",
             "| " + " | ".join(c.replace("_", " ") for c in COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    lines += ["| " + " | ".join(str(v) for v in row) + " |" for row in rows]
    lines += ["", "contact share, search share: of the loop's time.", "", "![two cores](scaling.png)"]
    (HERE / "scaling.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def plot(rows):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    for scene, _, _ in SCENES:
        for threads, style in ((1, "o-"), (2, "s--")):
            mine = [r for r in rows if r[0] == scene and r[3] == threads]
            label = f"{scene}, {threads} thread" + ("s" if threads > 1 else "")
            line, = axes[0].loglog([r[1] for r in mine], [float(r[4]) for r in mine], style, markersize=4, label=label,
                                   color=None if threads == 1 else colour)
            colour = line.get_color()
            if threads == 2:
                axes[1].semilogx([r[1] for r in mine], [float(r[5]) for r in mine], style, markersize=4, color=colour)
    axes[0].set(xlabel="elements", ylabel="ns per element and cycle")
    axes[1].set(xlabel="elements", ylabel="one thread over two", ylim=(0.8, 2.2))
    axes[1].axhline(2.0, color="0.7", linewidth=0.8)
    axes[0].legend(fontsize=6)
    for axis in axes:
        axis.grid(True, which="both", linewidth=0.3)
    figure.savefig(HERE / "scaling.png", dpi=120)


def main():
    quick = "--quick" in sys.argv
    rows = measure(pathlib.Path(sys.argv[1]).resolve(), quick)
    if quick:
        return
    write(rows)
    plot(rows)


if __name__ == "__main__":
    main()
