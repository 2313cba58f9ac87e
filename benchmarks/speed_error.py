#!/usr/bin/python3
"""Runs speed_error and writes its table (CSV, Markdown) and plot beside this file.

usage: speed_error.py BUILD_FOLDER [MESHES]
"""
import csv
import io
import pathlib
import subprocess
import sys

import stamp

HERE = pathlib.Path(__file__).resolve().parent


def write_table(rows):
    """benchmarks/speed_error.md: one row per run."""
    lines = ["# Error against wall time", "", f"Time loop on one thread. {stamp.line()}.", "",
             "Errors are those of the middle's height and of the volume against the reference collection: clamped disc",
             "(exact kinematics), mylar balloon (inextensible limit corrected for its stiffness), square cushion (scatter",
             "of the published values: 0.5 % in height, 0.2 % in volume).", "",
             "![error against wall time](speed_error.png)", "",
             "| problem | element | n | elements | cycles | wall [s] | height error | volume error |",
             "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['problem']} | {row['element']} | {row['n']} | {row['elements']} | {row['cycles']} | "
                     f"{float(row['wall_seconds']):.3f} | {100 * float(row['height_error']):.3f} % | "
                     f"{100 * float(row['volume_error']):.3f} % |")
    (HERE / "speed_error.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def draw_plot(rows):
    """benchmarks/speed_error.png: volume error over wall time, one panel per problem."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    problems = list(dict.fromkeys(row["problem"] for row in rows))
    elements = list(dict.fromkeys(row["element"] for row in rows))
    figure, axes = plt.subplots(1, len(problems), figsize=(4 * len(problems), 3.8), sharey=True)
    for axis, problem in zip(axes, problems):
        for element, mark in zip(elements, "^s+"):
            points = [row for row in rows if row["problem"] == problem and row["element"] == element]
            axis.loglog([float(p["wall_seconds"]) for p in points], [float(p["volume_error"]) for p in points],
                        marker=mark, label=element)
        axis.set_title(problem)
        axis.set_xlabel("wall time [s]")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("error of the volume")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(HERE / "speed_error.png", dpi=110)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    command = [str(pathlib.Path(sys.argv[1]) / "speed_error")] + sys.argv[2:3]
    text = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
    rows = list(csv.DictReader(io.StringIO(text)))
    (HERE / "speed_error.csv").write_text(text, encoding="utf-8")
    write_table(rows)
    draw_plot(rows)
    print((HERE / "speed_error.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
