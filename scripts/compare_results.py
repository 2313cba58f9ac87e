#!/usr/bin/env python3
"""Sets the numbers of a run beside the ones to expect; fails if one is off by more than its tolerance.

usage: compare_results.py RESULTS_FOLDER EXPECTED.csv

Columns of EXPECTED.csv: quantity, unit, file (a CSV history in the folder), column, statistic (max, min, or a time: the
nearest row counts), expected, tolerance (relative, in per cent).
"""
import csv
import pathlib
import sys


def statistic(rows, column, name):
    """The largest or least value of a column, or the one at the time that name gives."""
    if name in ("max", "min"):
        return {"max": max, "min": min}[name](float(row[column]) for row in rows)
    return float(min(rows, key=lambda row: abs(float(row["time"]) - float(name)))[column])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    folder, status = pathlib.Path(sys.argv[1]), 0
    print(f"  {'':34}{'expected':>12}{'obtained':>12}{'allowed':>10}")
    with open(sys.argv[2], newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            with open(folder / row["file"], newline="", encoding="utf-8") as history:
                obtained = statistic(list(csv.DictReader(history)), row["column"], row["statistic"])
            expected = float(row["expected"])
            good = abs(obtained - expected) <= 0.01 * float(row["tolerance"]) * abs(expected)
            name = f"{row['quantity']} [{row['unit']}]"
            print(f"  {name:34}{expected:12.5g}{obtained:12.5g}{row['tolerance']:>8} %" + ("" if good else "  DIFFERS"))
            status |= not good
    return status


if __name__ == "__main__":
    sys.exit(main())
