#!/usr/bin/env python3
"""Checks a results folder of billow from outside: results.vtkhdf against the published VTKHDF 2.0 layout, results.xdmf
against the same arrays, the CSV histories against their columns. Where VTK 9.3 or newer is installed, its reader opens
the file too.

usage: check_results.py FOLDER      exit code 0: all is well, 1: problems (listed), 2: not a results folder

Needs python3-numpy and python3-h5py.
"""
import csv
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

COLUMNS = {
    "glstat.csv": "time,cycle,time_step,kinetic_energy,internal_energy,hourglass_energy,damping_energy,contact_energy,"
                  "external_work,airbag_work,total_energy,energy_ratio,dt_element",
    "abstat.csv": "time,airbag,volume,pressure,internal_energy,mass_flow_in,density,mass_flow_out,mass,temperature,"
                  "area,reaction,mass_flow_out_porosity,mass_flow_out_vent",
    "abstat_parts.csv": "time,airbag,part,unblocked_area,blocked_area,mass_flow_out",
    "nodout.csv": "time,node,x,y,z,ux,uy,uz,vx,vy,vz,ax,ay,az",
    "rbdout.csv": "time,part,x,y,z,vx,vy,vz,ax,ay,az",
    "rcforc.csv": "time,interface,side,fx,fy,fz",
    "gceout.csv": "time,entity,part,fx,fy,fz,mx,my,mz",
    "rwforc.csv": "time,wall,normal_force,fx,fy,fz",
    "matsum.csv": "time,part,internal_energy,kinetic_energy,hourglass_energy,mass,x_momentum,y_momentum,z_momentum",
}
CORNERS = {5: 3, 9: 4}  # VTK_TRIANGLE, VTK_QUAD


class Problems:
    """Collects what is wrong."""

    def __init__(self):
        self.list = []

    def expect(self, condition, text):
        if not condition:
            self.list.append(text)
        return bool(condition)


def check_attributes(root, problems):
    """Version [2, 0] and a fixed-length ASCII Type."""
    version = root.attrs.get("Version")
    problems.expect(version is not None and list(version) == [2, 0], "Version is not [2, 0]")
    if problems.expect("Type" in root.attrs, "no attribute Type"):
        kind = root.attrs.get_id("Type").get_type()
        problems.expect(not kind.is_variable_str(), "Type is a string of variable length: readers refuse it")
        problems.expect(bytes(root.attrs["Type"]) == b"UnstructuredGrid", "Type is not UnstructuredGrid")


def step_values(root, problems):
    """The integer columns of Steps as a dictionary; each has one value per step."""
    steps = root["Steps"]
    count = int(steps.attrs["NSteps"])
    columns = {}
    for name in ("PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
        columns[name] = steps[name][()]
    for group, data in (("PointDataOffsets", "PointData"), ("CellDataOffsets", "CellData")):
        problems.expect(set(steps[group]) == set(root[data]), f"{group} and {data} name different arrays")
        for name in steps[group]:
            columns[f"{group}/{name}"] = steps[group][name][()]
    columns["Values"] = steps["Values"][()]
    for name, values in columns.items():
        problems.expect(values.shape == (count,), f"Steps/{name} has shape {values.shape}, not ({count},)")
    problems.expect(numpy.all(numpy.diff(columns["Values"]) > 0), "the times do not grow")
    return count, columns


def read_step(root, columns, step):
    """What a reader of the format gets for one step: the published rules, no knowledge of billow."""
    part = int(columns["PartOffsets"][step])
    parts = int(columns["NumberOfParts"][step])
    assert parts == 1, "one part per step"
    points, cells = int(root["NumberOfPoints"][part]), int(root["NumberOfCells"][part])
    corners = int(root["NumberOfConnectivityIds"][part])
    first_point, first_cell = int(columns["PointOffsets"][step]), int(columns["CellOffsets"][step])
    first_corner = int(columns["ConnectivityIdOffsets"][step])
    result = {
        "Points": root["Points"][first_point:first_point + points],
        "Connectivity": root["Connectivity"][first_corner:first_corner + corners],
        "Offsets": root["Offsets"][first_cell + part:first_cell + part + cells + 1],
        "Types": root["Types"][first_cell:first_cell + cells],
    }
    for group, rows in (("PointData", points), ("CellData", cells)):
        for name, array in root[group].items():
            first = int(columns[f"{group}Offsets/{name}"][step])
            result[f"{group}/{name}"] = array[first:first + rows]
            assert len(result[f"{group}/{name}"]) == rows, f"{group}/{name} ends before step {step} does"
    assert result["Points"].shape == (points, 3), f"Points end before step {step} does"
    return result


def check_mesh(mesh, problems):
    """Cells name points that exist, in the number that their types have."""
    offsets, types = mesh["Offsets"], mesh["Types"]
    problems.expect(types.dtype == numpy.uint8, "Types is not unsigned char")
    problems.expect(offsets.dtype == mesh["Connectivity"].dtype == numpy.int64, "topology is not 64-bit")
    problems.expect(offsets[0] == 0 and offsets[-1] == len(mesh["Connectivity"]), "Offsets do not span Connectivity")
    wanted = numpy.array([CORNERS.get(int(kind), -1) for kind in types])
    problems.expect(numpy.array_equal(numpy.diff(offsets), wanted), "Offsets and Types disagree")
    inside = (mesh["Connectivity"] >= 0) & (mesh["Connectivity"] < len(mesh["Points"]))
    problems.expect(numpy.all(inside), "Connectivity names points that do not exist")
    for name, array in mesh.items():
        problems.expect(numpy.all(numpy.isfinite(array)), f"{name} holds numbers that are not finite")


def read_item(item, folder, files):
    """A DataItem of an XDMF file: FILE:PATH with an optional |start:stride:count:dimensions."""
    where, _, slab = item.text.strip().partition("|")
    name, _, path = where.partition(":")
    if name not in files:
        files[name] = h5py.File(os.path.join(folder, name), "r")
    data = files[name][path]
    wanted = tuple(int(n) for n in item.get("Dimensions").split())
    kinds = {"Float": "f", "Int": "i", "UChar": "u"}
    assert data.dtype.kind == kinds[item.get("NumberType")], f"{path}: another NumberType"
    assert data.dtype.itemsize == int(item.get("Precision")), f"{path}: another Precision"
    if slab:
        start, stride, count, size = ([int(n) for n in part.split()] for part in slab.split(":"))
        assert len(size) == len(data.shape) and all(a <= b for a, b in zip(size, data.shape)), f"{path}: dimensions"
        assert stride == [1] * len(size) and tuple(count) == wanted, f"{path}: count"
        data = data[tuple(slice(a, a + n) for a, n in zip(start, count))]
    assert data.shape == wanted, f"{path}: {data.shape} is not {wanted}"
    return data[()] if isinstance(data, h5py.Dataset) else data


def xdmf_cells(topology, item):
    """Connectivity as VTK has it, from a plain or mixed XDMF topology."""
    kind = topology.get("TopologyType")
    if kind != "Mixed":
        assert kind in ("Triangle", "Quadrilateral")
        return item
    cells, at = [], 0
    while at < len(item):
        corners = {4: 3, 5: 4}[int(item[at])]
        cells.append(item[at + 1:at + 1 + corners])
        at += 1 + corners
    assert len(cells) == int(topology.get("NumberOfElements"))
    return numpy.concatenate(cells)


def check_xdmf(folder, root, count, columns, problems):
    """Every state of the index gives the arrays that the VTKHDF reader gives."""
    grids = ElementTree.parse(os.path.join(folder, "results.xdmf")).getroot().findall("Domain/Grid/Grid")
    if not problems.expect(len(grids) == count, f"results.xdmf has {len(grids)} states, results.vtkhdf {count}"):
        return
    files = {}
    for step, grid in enumerate(grids):
        mesh = read_step(root, columns, step)
        time = float(grid.find("Time").get("Value"))
        problems.expect(time == columns["Values"][step], f"state {step}: another time in results.xdmf")
        topology = grid.find("Topology")
        cells = xdmf_cells(topology, read_item(topology.find("DataItem"), folder, files))
        problems.expect(numpy.array_equal(cells, mesh["Connectivity"]), f"state {step}: another topology")
        points = read_item(grid.find("Geometry/DataItem"), folder, files)
        problems.expect(numpy.array_equal(points, mesh["Points"]), f"state {step}: other points")
        names = set()
        for attribute in grid.findall("Attribute"):
            name = {"Node": "PointData/", "Cell": "CellData/"}[attribute.get("Center")] + attribute.get("Name")
            names.add(name)
            data = read_item(attribute.find("DataItem"), folder, files)
            problems.expect(numpy.array_equal(data, mesh[name]), f"state {step}: another {name}")
        problems.expect(names == {name for name in mesh if "/" in name}, f"state {step}: arrays are missing")


def check_history(folder, name, problems):
    """One CSV file: the contract's columns, finite numbers, growing times."""
    with open(os.path.join(folder, name), newline="", encoding="ascii") as file:
        rows = list(csv.reader(file))
    problems.expect(",".join(rows[0]) == COLUMNS[name], f"{name}: other columns")
    last = -math.inf
    for number, row in enumerate(rows[1:], 2):
        if not problems.expect(len(row) == len(rows[0]), f"{name}:{number}: {len(row)} fields"):
            return
        values = [float(value) for value in row if value not in ("master", "slave", "a", "b")]
        problems.expect(all(map(math.isfinite, values)), f"{name}:{number}: a number is not finite")
        problems.expect(values[0] >= last, f"{name}:{number}: time goes back")
        last = values[0]


def check_with_vtk(path, root, count, columns, problems):
    """The real reader, where there is one that knows temporal files."""
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkVersion
        from vtkmodules.vtkIOHDF import vtkHDFReader
    except ImportError:
        print("VTK is not installed: its reader was not tried")
        return
    version = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion())
    if version < (9, 3):
        print(f"VTK {version[0]}.{version[1]} does not read temporal files (9.3 does): its reader was not tried")
        return
    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    for step in range(count):
        reader.SetStep(step)
        reader.Update()
        grid = reader.GetOutputDataObject(0)
        mesh = read_step(root, columns, step)
        points = vtk_to_numpy(grid.GetPoints().GetData())
        problems.expect(numpy.array_equal(points, mesh["Points"]), f"VTK reads other points in state {step}")
        stress = vtk_to_numpy(grid.GetCellData().GetArray("stress"))
        problems.expect(numpy.array_equal(stress, mesh["CellData/stress"]), f"VTK reads other stress in state {step}")
    print(f"VTK {version[0]}.{version[1]} read all {count} states")


def main():
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder, problems = sys.argv[1], Problems()
    path = os.path.join(folder, "results.vtkhdf")
    histories = [name for name in COLUMNS if os.path.exists(os.path.join(folder, name))]
    if not histories and not os.path.exists(path):
        print(f"{folder} holds no results", file=sys.stderr)
        return 2
    for name in histories:
        check_history(folder, name, problems)
    count = 0
    if os.path.exists(path):
        with h5py.File(path, "r") as file:
            root = file["VTKHDF"]
            check_attributes(root, problems)
            try:
                count, columns = step_values(root, problems)
                for step in range(count):
                    check_mesh(read_step(root, columns, step), problems)
                check_xdmf(folder, root, count, columns, problems)
                check_with_vtk(path, root, count, columns, problems)
            except (AssertionError, KeyError, ElementTree.ParseError, OSError) as error:
                problems.list.append(f"{type(error).__name__}: {error}")
    for text in problems.list[:50]:
        print(f"problem: {text}")
    print(f"{folder}: {count} states, {len(histories)} histories, {len(problems.list)} problems")
    return 1 if problems.list else 0


if __name__ == "__main__":
    sys.exit(main())
