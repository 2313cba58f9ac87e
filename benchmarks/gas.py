#!/usr/bin/python3
"""Times what the gas and its jets cost per bag element and cycle, and writes tables (CSV, Markdown) beside this file.

usage: /usr/bin/python3 gas.py BUILD_FOLDER [--quick]

Scene: the pillow of speed.py of some 20,000 triangles, with and without a bag, with several gas models and jets, flat
and folded to a zigzag. Numbers come from summary.json; the best of the repeats counts.
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import pathlib

import stamp

HERE = pathlib.Path(__file__).resolve().parent
CYCLES = 1000
CURVES = "".join(f"*DEFINE_CURVE\n{number}\n0,{value}\n1,{value}\n"
                 for number, value in ((3, 0.48), (4, 0.2), (5, 0.12), (6, 800), (7, 0.2)))
GASES = ("0,0,0,0.028964,1,28.11,0.001967,4.802e-06\n0\n3,6,0,0.0280134,0,28.9,-0.001571,8.081e-06\n0\n"
         "4,6,0,0.0440095,0,22.26,0.05981,-3.501e-05\n0\n5,6,0,0.039948,0,20.786\n0\n7,6,0,0.0040026,0,20.786\n0\n")
HYBRID = "*AIRBAG_HYBRID\n1,1\n296.15,101325,1.19187,8.314462618,1,5\n0.7,0,1e-4\n7,0,5\n" + GASES + CURVES


def wang_nefske(option="", cards=""):
    """A bag with a vent, and a jet by its cards."""
    return (f"*AIRBAG_WANG_NEFSKE{option}\n1,1\n717.65,1004.7,500,0,1,0,0,0\n0.7,0,1e-4\n101325,1.19187,1\n0\n"
            + cards)


def cone(angle, height=0.0):
    """A jet upwards in the middle."""
    return wang_nefske("_JETTING_CM", f"0.5,0.5,{height},0.5,0.5,1.,{angle},1.\n0\n0\n")


def sphere(height=0.0):
    """Jets in all directions."""
    return wang_nefske("_MULTIPLE_JETTING_CM", f"0.5,0.5,{height},0.5,0.5,1.,77,1.\n0\n0\n"
                       "*DEFINE_CURVE\n77\n0,1\n180,1\n")


# name, text of the bag, folded, leaking fabric
BAGS = [("SIMPLE_AIRBAG_MODEL", None, False, False), ("WANG_NEFSKE, vent", wang_nefske(), False, False),
        ("HYBRID of 5 gases, vent, leaking fabric, heat loss", HYBRID, False, True)]
JETS = [("none", wang_nefske(), False, False), ("cone of 0.3 rad", cone(0.3), False, False),
        ("cone of 1.5 rad", cone(1.5), False, False), ("all directions", sphere(), False, False),
        ("none, folded bag", wang_nefske(), True, False), ("all directions, folded bag", sphere(-0.03), True, False)]


def fold(text):
    """The nodes of a deck on a zigzag of 16 legs along x."""
    start, end = text.index("*NODE\n") + 6, text.index("*ELEMENT_SHELL")
    lines, leg = [], 1 / 16
    for line in text[start:end].splitlines():
        x, y, z = (float(line[8 + 16 * i:24 + 16 * i]) for i in range(3))
        number = math.floor(x / leg)
        share = x / leg - number
        rise = share if number % 2 == 0 else 1 - share
        lines.append(f"{int(line[:8])},{0.3 * x + 0.35:.9g},{y:.9g},{0.15 * z + leg * 0.95 * (rise - 0.5):.9g}\n")
    return text[:start] + "".join(lines) + text[end:]


def make_deck(base, bag, folded, leaking):
    """The pillow with another bag; "" for none, None for its own."""
    start, end = base.index("*AIRBAG_"), base.index("*NODE")
    text = base if bag is None else base[:start] + bag + base[end:]
    if leaking:  # FLC, FAC
        plain = f"{0:10}" * 6 + "\n$             rgbrth"
        assert plain in text
        text = text.replace(plain, f"{0:10}{1:10}{'1e-4':>10}" + f"{0:10}" * 3 + "\n$             rgbrth")
    return fold(text) if folded else text


def measure(build, folder, text, threads, repeats):
    """Nanoseconds per element and cycle of the loop, and those of the stage of the gas."""
    deck = f"{folder}/deck.k"
    pathlib.Path(deck).write_text(text, encoding="utf-8")
    best = None
    for _ in range(repeats):
        command = [f"{build}/billow", "run", deck, "-o", f"{folder}/results", "-j", str(threads), "--quiet",
                   "--energy-error-limit", "1e30"]
        if subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode:
            sys.exit(f"failed: {' '.join(command)}")
        with open(f"{folder}/results/summary.json", encoding="utf-8") as file:
            summary = json.load(file)
        if best is None or summary["loop_seconds"] < best["loop_seconds"]:
            best = summary
    scale = 1e9 / (best["cycles"] * best["elements"])
    return best["loop_seconds"] * scale, best["timing"]["gas"] * scale


def measure_bags(build, folder, base, repeats):
    """Rows of the first table: what the bag adds."""
    deck = f"{folder}/pillow.k"
    pathlib.Path(deck).write_text(base, encoding="utf-8")
    done = subprocess.run([f"{build}/gas_pass", deck], capture_output=True, text=True, check=True)
    plain, with_gas = (float(word) for word in done.stdout.split())
    none, _ = measure(build, folder, make_deck(base, "", False, False), 1, repeats)
    rows = []
    for name, bag, folded, leaking in BAGS:
        loop, gas = measure(build, folder, make_deck(base, bag, folded, leaking), 1, repeats)
        area, rest = with_gas - plain, max(loop - none, gas)
        rows.append({"bag": name, "loop_ns": loop, "gas_stage_ns": gas, "area_vectors_ns": area,
                     "gas_and_pressure_ns": rest, "sum_ns": area + rest})
        print(f"{name:52} {area + rest:5.2f} ns of {loop:6.2f}", flush=True)
    return rows


def measure_jets(build, folder, base, repeats):
    """Rows of the second table: what a jet adds."""
    rows = []
    for threads in (1, 2):
        without = 0.0
        for name, bag, folded, leaking in JETS:
            loop, _ = measure(build, folder, make_deck(base, bag, folded, leaking), threads, repeats)
            if name.startswith("none"):
                without = loop
            rows.append({"jet": name, "threads": threads, "loop_ns": loop, "jet_ns": loop - without,
                         "share_of_step": (loop - without) / loop})
            print(f"{name:30} {threads} threads {loop:6.2f} ns, jet {100 * rows[-1]['share_of_step']:5.1f} %", flush=True)
    return rows


def write_csv(name, rows):
    """One table."""
    with open(HERE / name, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.4f}" if isinstance(value, float) else value for key, value in row.items()}
                         for row in rows)


def write_tables(bags, jets):
    """gas.md and both CSV files."""
    write_csv("gas_bags.csv", bags)
    write_csv("gas_jets.csv", jets)
    lines = ["# Cost of gas and jets", "",
             f"Nanoseconds per bag element and cycle, pillow of 20,164 triangles. {stamp.line()}.", "",
             "One thread. Area vectors: what area vectors, volume and area add to a pass over the elements (`gas_pass`:",
             "the same pass with and without them). Gas and pressure: what the time loop takes more with the bag than",
             "without one, at least its stage of the gas. The limit is 4 ns.", "",
             "| bag | whole loop | stage of the gas | area vectors | gas and pressure | sum |", "|---|---|---|---|---|---|"]
    for row in bags:
        lines.append(f"| {row['bag']} | {row['loop_ns']:.2f} | {row['gas_stage_ns']:.2f} | {row['area_vectors_ns']:.2f} | "
                     f"{row['gas_and_pressure_ns']:.2f} | {row['sum_ns']:.2f} |")
    lines += ["", "Jets of constant momentum, line of sight included; the folded bag is a zigzag of 16 legs. The limit is",
              "30 % of the step.", "", "| jet | threads | whole loop | jet | share of the step |", "|---|---|---|---|---|"]
    for row in jets:
        lines.append(f"| {row['jet']} | {row['threads']} | {row['loop_ns']:.2f} | {row['jet_ns']:.2f} | "
                     f"{100 * row['share_of_step']:.0f} % |")
    (HERE / "gas.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build, quick = sys.argv[1], "--quick" in sys.argv
    repeats = 1 if quick else 3
    command = [f"{build}/make_deck", "speed", "--shells", "20000", "--cycles", str(CYCLES)]
    base = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout
    with tempfile.TemporaryDirectory() as folder:
        bags = measure_bags(build, folder, base, repeats)
        jets = measure_jets(build, folder, base, repeats)
    if not quick:
        write_tables(bags, jets)


if __name__ == "__main__":
    os.environ.pop("OMP_NUM_THREADS", None)
    main()
