#!/usr/bin/env python3
"""Draws pictures from billow's results: the deformed bag at chosen times, or columns of a history over time.

    render.py shape FOLDER -o bag.png --times 0 5 10          panels of the deformed bag, nearest states
    render.py shape FOLDER -o bag.png --color stress          coloured by the larger principal stress
    render.py plot FOLDER/abstat.csv -o gas.png volume pressure

Needs python3-numpy, python3-h5py and python3-matplotlib.
"""
import argparse
import csv
import os
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize, to_rgb

PART_COLORS = ("#d9c7a0", "#7f96ad", "#b5706a", "#8aa67c", "#a58cb8", "#c8a25c")
BRIGHT_DIRECTION = numpy.array([-0.45, 0.35, 0.82])  # of the light, in screen axes: right, up, to the eye


class Grid:
    """An open results.vtkhdf: the cells, and the arrays of a state."""

    def __init__(self, folder):
        path = os.path.join(folder, "results.vtkhdf") if os.path.isdir(folder) else folder
        self.root = h5py.File(path, "r")["VTKHDF"]
        self.times = self.root["Steps/Values"][()]
        if len(self.times) == 0:
            sys.exit(f"{path} holds no states yet")
        offsets, corners = self.root["Offsets"][()], self.root["Connectivity"][()]
        # A triangle repeats its last corner, so that all cells have four.
        last = offsets[1:] - 1
        self.cells = corners[numpy.minimum(offsets[:-1, None] + numpy.arange(4), last[:, None])]
        self.parts = self.root["CellData/part_id"][()]

    def state_at(self, time):
        return int(numpy.argmin(numpy.abs(self.times - time)))

    def points(self, state):
        first = int(self.root["Steps/PointOffsets"][state])
        return self.root["Points"][first:first + int(self.root["NumberOfPoints"][0])]

    def cell_data(self, name, state):
        first = int(self.root["Steps/CellDataOffsets"][name][state])
        return self.root["CellData"][name][first:first + len(self.cells)]

    def field(self, name, state):
        """A number per cell: thickness, the larger principal stress or strain."""
        data = self.cell_data(name, state).astype(float)
        if data.ndim == 1:
            return data
        xx, yy, zz, xy, yz, zx = data.T
        tensors = numpy.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]).transpose(2, 0, 1)
        return numpy.linalg.eigvalsh(tensors)[:, 2]


def view_axes(elevation, azimuth, up):
    """Screen axes as rows: right, up, towards the eye; angles in degrees about the model's up axis."""
    e, a = numpy.radians([elevation, azimuth])
    order = {"x": [2, 0, 1], "y": [1, 2, 0], "z": [0, 1, 2]}[up]
    eye = numpy.array([numpy.cos(e) * numpy.cos(a), numpy.cos(e) * numpy.sin(a), numpy.sin(e)])
    right = numpy.array([-numpy.sin(a), numpy.cos(a), 0.0])
    axes = numpy.array([right, numpy.cross(eye, right), eye])
    turned = numpy.empty_like(axes)
    turned[:, order] = axes
    return turned


def shade_cells(corners, colors):
    """Light from one side and a little from everywhere; both faces of the fabric are alike."""
    normals = numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    flat = numpy.all(corners[:, 3] == corners[:, 2], axis=1)
    normals[flat] = numpy.cross(corners[flat, 1] - corners[flat, 0], corners[flat, 2] - corners[flat, 0])
    length = numpy.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / numpy.where(length > 0, length, 1)
    normals *= numpy.where(normals[:, 2:] < 0, -1.0, 1.0)
    direct = numpy.clip(normals @ (BRIGHT_DIRECTION / numpy.linalg.norm(BRIGHT_DIRECTION)), 0, 1)[:, None]
    gloss = direct ** 24
    return numpy.clip(colors * (0.30 + 0.72 * direct) + 0.16 * gloss, 0, 1)


def draw_state(panel, grid, state, axes, options, scale):
    """Paints the cells from the farthest to the nearest."""
    screen = grid.points(state) @ axes.T
    shown = numpy.isin(grid.parts, options.parts) if options.parts else numpy.ones(len(grid.cells), bool)
    corners = screen[grid.cells[shown]]
    if scale is not None:
        colors = scale.to_rgba(grid.field(options.color, state)[shown])[:, :3]
    else:
        names = {part: index for index, part in enumerate(sorted(set(grid.parts)))}
        table = numpy.array([to_rgb(color) for color in PART_COLORS])
        colors = table[[names[part] % len(table) for part in grid.parts[shown]]]
    colors = shade_cells(corners, colors)
    order = numpy.argsort(corners[:, :, 2].mean(axis=1))
    edges = (0, 0, 0, 0.25) if options.mesh else colors[order]
    panel.add_collection(PolyCollection(corners[order][:, :, :2], facecolors=colors[order], edgecolors=edges,
                                        linewidths=0.3 if options.mesh else 0.2))
    panel.set_aspect("equal")
    panel.axis("off")
    return screen


def draw_shapes(options):
    grid = Grid(options.folder)
    states = [grid.state_at(time) for time in options.times] if options.times else [len(grid.times) - 1]
    axes = view_axes(options.elevation, options.azimuth, options.up)
    scale = None
    if options.color != "part":
        values = numpy.concatenate([grid.field(options.color, state) for state in states])
        scale = ScalarMappable(Normalize(0, numpy.percentile(values, 99) or 1), "viridis")
    figure, panels = pyplot.subplots(1, len(states), squeeze=False, figsize=(options.size * len(states), options.size),
                                     layout="constrained")
    screens = [draw_state(panel, grid, state, axes, options, scale) for panel, state in zip(panels[0], states)]
    low = numpy.min([screen.min(axis=0) for screen in screens], axis=0)
    high = numpy.max([screen.max(axis=0) for screen in screens], axis=0)
    margin = 0.03 * numpy.max(high - low)
    for panel, state in zip(panels[0], states):
        panel.set_xlim(low[0] - margin, high[0] + margin)
        panel.set_ylim(low[1] - margin, high[1] + margin)
        panel.set_title(f"t = {grid.times[state]:.4g}", fontsize=10)
    if scale is not None:
        label = options.color if options.color == "thickness" else f"larger principal {options.color}"
        figure.colorbar(scale, ax=list(panels[0]), shrink=0.7, label=label)
    figure.savefig(options.output, dpi=options.dpi, bbox_inches="tight")


def read_history(path):
    """The columns of a history by name, and the name of the column that tells its entities apart, if it has one."""
    with open(path, newline="", encoding="ascii") as file:
        rows = list(csv.reader(file))
    columns = dict(zip(rows[0], zip(*rows[1:])))
    if not columns:
        sys.exit(f"{path} holds no rows yet")
    entity = rows[0][1] if rows[0][1] in ("airbag", "node", "part", "interface", "wall") else None
    return columns, entity


def draw_history(options):
    columns, entity = read_history(options.file)
    unknown = [name for name in options.columns if name not in columns]
    if unknown:
        sys.exit(f"no column {unknown[0]} in {options.file}; it has: {', '.join(columns)}")
    time = numpy.array(columns["time"], float)
    ids = numpy.array(columns[entity]) if entity else numpy.zeros(len(time), str)
    figure, panels = pyplot.subplots(1, len(options.columns), squeeze=False,
                                     figsize=(options.size * len(options.columns), 0.75 * options.size),
                                     layout="constrained")
    for panel, name in zip(panels[0], options.columns):
        values = numpy.array(columns[name], float)
        for key in dict.fromkeys(ids):
            chosen = ids == key
            panel.plot(time[chosen], values[chosen], linewidth=1.4, label=f"{entity} {key}" if entity else None)
        panel.set_xlabel("time")
        panel.set_title(name.replace("_", " "), fontsize=10)
        panel.grid(alpha=0.3)
    if entity and len(set(ids)) > 1:
        panels[0][0].legend(fontsize=8)
    figure.savefig(options.output, dpi=options.dpi, bbox_inches="tight")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    commands = parser.add_subparsers(dest="command", required=True)
    shape = commands.add_parser("shape", help="the deformed bag")
    shape.add_argument("folder", help="results folder or results.vtkhdf")
    shape.add_argument("--times", type=float, nargs="+", help="one panel each, nearest states (default: the last)")
    shape.add_argument("--color", choices=("part", "thickness", "stress", "strain"), default="part")
    shape.add_argument("--parts", type=int, nargs="+", help="only these parts")
    shape.add_argument("--elevation", type=float, default=28, help="degrees (default 28)")
    shape.add_argument("--azimuth", type=float, default=-60, help="degrees (default -60)")
    shape.add_argument("--up", choices=("x", "y", "z"), default="z", help="axis that points upwards (default z)")
    shape.add_argument("--mesh", action="store_true", help="draw the cells' edges")
    plot = commands.add_parser("plot", help="columns of a history over time")
    plot.add_argument("file", help="a history, for example FOLDER/abstat.csv")
    plot.add_argument("columns", nargs="+")
    for command in (shape, plot):
        command.add_argument("-o", "--output", required=True, help="picture to write (.png, .svg, .pdf)")
        command.add_argument("--size", type=float, default=4, help="inches of a panel (default 4)")
        command.add_argument("--dpi", type=float, default=120)
    return parser.parse_args()


def main():
    options = parse_arguments()
    try:
        if options.command == "shape":
            draw_shapes(options)
        else:
            draw_history(options)
    except OSError as error:
        sys.exit(f"render.py: {error}")


if __name__ == "__main__":
    main()
