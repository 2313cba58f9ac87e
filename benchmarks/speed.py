#!/usr/bin/python3
"""Times the whole loop per element and cycle, by stage, and writes table (CSV, Markdown) and plot beside this file.

usage: /usr/bin/python3 speed.py BUILD_FOLDER [--quick]

Scene: a pillow of orthotropic fabric (FORM 0 with compression cut-off) filled with gas. Numbers come from summary.json;
the best of the repeats counts. Memory: model, state and buffers.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import stamp

HERE = pathlib.Path(__file__).resolve().parent
ROUNDS = 7
STAGES = ["elements", "gas", "nodes", "special", "waiting"]


def run_child(arguments, output=None, kernels=None):
    """Runs a program, its standard output to a file or nowhere; kernels: the instruction set, None the best."""
    environment = dict(os.environ, **({"BILLOW_KERNELS": kernels} if kernels else {}))
    with open(output or os.devnull, "wb") as target:
        result = subprocess.run(arguments, stdout=target, stderr=subprocess.PIPE, env=environment, check=False)
    if result.returncode:
        sys.exit(f"failed: {' '.join(arguments)}\n{result.stderr.decode()}")


def run_scene(build, folder, scene):
    """One run's summary."""
    pattern, shells, threads, cycles, kernels = scene
    deck = f"{folder}/{pattern}-{shells}.k"
    if not os.path.exists(deck):
        run_child([f"{build}/make_deck", "speed", "--pattern", pattern, "--shells", str(shells), "--cycles",
                   str(cycles)], deck)
    run_child([f"{build}/billow", "run", deck, "-o", f"{folder}/results", "-j", str(threads), "--quiet"],
              kernels=kernels)
    with open(f"{folder}/results/summary.json", encoding="utf-8") as file:
        return json.load(file)


def make_row(scene, runs):
    """The best of a scene's runs as a row of the table, and the median of their times."""
    pattern, _, threads, _, kernels = scene
    runs = sorted(runs, key=lambda summary: summary["ns_per_element_cycle"])
    best, median = runs[0], runs[len(runs) // 2]["ns_per_element_cycle"]
    scale = 1e9 / (best["cycles"] * best["elements"])
    row = {"element": "triangles" if pattern == "diagonal" else "quads 2x2", "elements": best["elements"],
           "threads": threads, "kernels": "AVX2" if kernels == "v3" else "best", "cycles": best["cycles"],
           "ns_per_element_cycle": best["ns_per_element_cycle"], "median_ns": median,
           "bytes_per_element": round(best["memory_bytes"] / best["elements"])}
    row.update({stage + "_ns": best["timing"][stage] * scale for stage in STAGES})
    return row


def write_table(rows):
    """benchmarks/speed.csv and speed.md."""
    with open(HERE / "speed.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    lines = ["# Speed", "", f"Nanoseconds per element and cycle of the whole time loop. {stamp.line()}.", "",
             "Gas-filled pillow, orthotropic fabric FORM 0 with compression cut-off, no output in the loop. Stages are",
             "those of thread 0, of the fastest of seven rounds (four for the largest mesh). Memory: model, state and",
             "buffers. AVX2: with BILLOW_KERNELS=v3; the other rows with the best that the processor has.", "",
             "![speed](speed.png)", "",
             "| element | elements | threads | kernels | cycles | ns | median | " + " | ".join(STAGES) +
             " | bytes per element |", "|---|---|---|---|---|---|---|" + "---|" * len(STAGES) + "---|"]
    for row in rows:
        stages = " | ".join(f"{row[stage + '_ns']:.2f}" for stage in STAGES)
        lines.append(f"| {row['element']} | {row['elements']} | {row['threads']} | {row['kernels']} | "
                     f"{row['cycles']} | {row['ns_per_element_cycle']:.2f} | {row['median_ns']:.2f} | {stages} | {row['bytes_per_element']} |")
    (HERE / "speed.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def draw_plot(rows):
    """benchmarks/speed.png."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axis = plt.subplots(figsize=(6, 4))
    for element, colour in (("triangles", "tab:blue"), ("quads 2x2", "tab:orange")):
        for threads, style in ((1, "-o"), (2, "--s")):
            points = [row for row in rows if row["element"] == element and row["threads"] == threads and
                      row["kernels"] == "best"]
            axis.semilogx([p["elements"] for p in points], [p["ns_per_element_cycle"] for p in points], style,
                          color=colour, label=f"{element}, {threads} thread{'s' if threads > 1 else ''}")
    axis.set_ylim(bottom=0)
    axis.set_xlabel("elements")
    axis.set_ylabel("ns per element and cycle")
    axis.grid(True, which="both", alpha=0.3)
    axis.legend()
    figure.tight_layout()
    figure.savefig(HERE / "speed.png", dpi=110)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build, quick = sys.argv[1], "--quick" in sys.argv
    scenes = []
    for pattern in ("diagonal", "quads"):
        for shells in (2000, 20000) if quick else (2000, 20000, 200000):
            for threads, kernels in ((1, None), (2, None), (1, "v3"), (2, "v3")):
                # undamped fabric of FORM 0 does not stay sound for ever: short runs, repeated
                cycles = max(50, min(500 if shells < 20000 else 600, int((4e7 if quick else 2e8) / shells / 4)))
                if not kernels or shells == 20000:
                    scenes.append((pattern, shells, threads, cycles, kernels))
    runs = {scene: [] for scene in scenes}
    with tempfile.TemporaryDirectory() as folder:
        for turn in range(ROUNDS):  # all scenes in turn: a machine that others slow down does so to each of them
            for scene in scenes:
                if scene[1] < 100000 or turn % 2 == 0:
                    runs[scene].append(run_scene(build, folder, scene))
    rows = [make_row(scene, runs[scene]) for scene in scenes]
    for row in rows:
        print(f"{row['element']:10} {row['elements']:7} elements {row['threads']} threads {row['kernels']:4} "
              f"{row['ns_per_element_cycle']:7.2f} ns, median {row['median_ns']:.2f}")
    if not quick:
        write_table(rows)
        draw_plot(rows)


if __name__ == "__main__":
    main()
