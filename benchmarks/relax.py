#!/usr/bin/python3
"""Runs the program relax and writes its table (CSV, Markdown) and plot beside this file.

usage: relax.py BUILD_FOLDER [POWER]    smallest DRTOL is 10 to the minus POWER (10)
"""
import csv
import io
import pathlib
import subprocess
import sys

import stamp

HERE = pathlib.Path(__file__).resolve().parent


def write_table(rows):
    """benchmarks/relax.md: one row per run."""
    lines = ["# Static equilibrium: Newton's method against dynamic relaxation", "",
             f"Whole phase on one thread, analysis and factorisations included. {stamp.line()}.", "",
             "Square cushion A11, a whole bag of 20,000 triangles that starts flat, and the clamped disc A1b, both under their",
             "full pressure from the start. The residual is the force left over, as a share of the loads; errors are those of",
             "the middle's height and of the volume against the reference collection (mesh included). The potential is stored",
             "energy less pressure times volume: crimped states of the cushion are not unique, a lower one is better.", "",
             "![residual against wall time](relax.png)", "",
             "| problem | elements | method | DRTOL | factorisations | cycles | wall [s] | residual | height error | volume error | potential [J] |",
             "|---|---|---|---|---|---|---|---|---|---|---|"]
    for row in rows:
        newton = row["method"] == "Newton"
        lines.append(f"| {row['problem']} | {row['elements']} | {row['method']} | {'-' if newton else row['tolerance']} | "
                     f"{row['factorisations'] if newton else '-'} | {'-' if newton else row['cycles']} | "
                     f"{float(row['wall_seconds']):.2f} | {float(row['residual']):.1e} | "
                     f"{100 * float(row['height_error']):.3f} % | {100 * float(row['volume_error']):.3f} % | "
                     f"{float(row['potential']):.5f} |")
    (HERE / "relax.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def draw_plot(rows):
    """benchmarks/relax.png: residual over wall time, one panel per problem."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    problems = list(dict.fromkeys(row["problem"] for row in rows))
    methods = list(dict.fromkeys(row["method"] for row in rows))
    figure, axes = plt.subplots(1, len(problems), figsize=(5 * len(problems), 3.8))
    for axis, problem in zip(axes, problems):
        for method, mark in zip(methods, "*s+"):
            points = [row for row in rows if row["problem"] == problem and row["method"] == method]
            axis.loglog([float(p["wall_seconds"]) for p in points], [float(p["residual"]) for p in points],
                        marker=mark, markersize=12 if mark == "*" else 6, label=method)
        axis.set_title(problem)
        axis.set_xlabel("wall time [s]")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("residual force / loads")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(HERE / "relax.png", dpi=110)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    command = [str(pathlib.Path(sys.argv[1]) / "relax")] + sys.argv[2:3]
    text = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
    rows = list(csv.DictReader(io.StringIO(text)))
    (HERE / "relax.csv").write_text(text, encoding="utf-8")
    write_table(rows)
    draw_plot(rows)
    print((HERE / "relax.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
