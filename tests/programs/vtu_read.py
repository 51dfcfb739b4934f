#!/usr/bin/env python3
"""Read .vtu and .pvd files back with readers that are not ours.

   vtu_read.py FOLDER             the files of vtu_sample, value by value
   vtu_read.py FOLDER X.pvd ...   and any other collections: every file opens, sizes agree, all values are finite,
                                   files of natural modes (part 2) hold shapes

The .pvd is read with xml.etree. The .vtu are read with meshio and with vtk, each where it can be imported; what cannot
be done is said and counts nothing. Ends with `N passed, N failed`; status 1 where anything failed.
"""
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

try:
    import meshio
except ImportError:
    meshio = None
try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None
try:
    import numpy
except ImportError:
    numpy = meshio = vtk = None

MESHIO_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13, "triangle6": 22,
                "quad8": 23, "tetra10": 24, "hexahedron20": 25, "wedge15": 26}
WEDGE_OF_MESHIO = [0, 2, 1, 3, 5, 4]  # meshio turns the triangles of VTK's wedge round
counts = {"passed": 0, "failed": 0}


def check(condition, what):
    if condition:
        counts["passed"] += 1
    else:
        counts["failed"] += 1
        print("FAILED: " + what)
    return condition


# A grid is a dictionary: points, cells as pairs of VTK type and list of nodes, point_data, cell_data.

def read_meshio(path):
    mesh = meshio.read(path)
    cells = []
    for block in mesh.cells:
        order = WEDGE_OF_MESHIO if block.type == "wedge" else range(block.data.shape[1])
        cells += [(MESHIO_TYPES[block.type], [int(nodes[k]) for k in order]) for nodes in block.data]
    cell_data = {name: numpy.concatenate(blocks) for name, blocks in mesh.cell_data.items()}
    return {"points": mesh.points, "cells": cells, "point_data": dict(mesh.point_data), "cell_data": cell_data}


def read_vtk(path):
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *words: errors.append(words))
    if not reader.CanReadFile(path):
        raise ValueError("vtk cannot read it")
    reader.SetFileName(path)
    reader.Update()
    if errors or reader.GetErrorCode():
        raise ValueError("vtk reports an error")
    grid = reader.GetOutput()
    cells = []
    for c in range(grid.GetNumberOfCells()):
        nodes = vtk.vtkIdList()
        grid.GetCellPoints(c, nodes)
        cells.append((grid.GetCellType(c), [nodes.GetId(k) for k in range(nodes.GetNumberOfIds())]))
    n_points = grid.GetNumberOfPoints()
    points = vtk_to_numpy(grid.GetPoints().GetData()) if n_points else numpy.zeros((0, 3))

    def arrays(data):
        return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}

    return {"points": points, "cells": cells, "point_data": arrays(grid.GetPointData()),
            "cell_data": arrays(grid.GetCellData())}


def solid(stage):
    """What write_solid of vtu_sample.f90 writes."""
    n, length, types = 12, [8, 6, 4, 4, 3, 2, 1], [12, 13, 10, 9, 5, 3, 1]
    point, cell = range(1, n + 1), range(1, 8)

    def columns(m, over, value):
        return [[stage * value(i, j) for j in range(1, m + 1)] for i in over]

    return {
        "points": [[(i * j - 5) / 7 for j in (1, 2, 3)] for i in point],
        "cells": [(types[c - 1], [(3 * c + 5 * j) % n for j in range(1, length[c - 1] + 1)]) for c in cell],
        "point_data": {
            "displacement": (columns(3, point, lambda i, j: (i - 2 * j) / 3), "float64"),
            "stress": (columns(6, point, lambda i, j: i * j / 11), "float64"),
            "lambda & <p>": ([stage * (1 / i) for i in point], "float64"),
            "node": ([stage * 100 * i for i in point], "int32"),
            "triple": (columns(3, point, lambda i, j: i - j), "int32")},
        "cell_data": {
            "energy": ([stage * (c / 13) for c in cell], "float64"),
            "flow": (columns(3, cell, lambda c, j: (j - c) / 17), "float64"),
            "strain": (columns(6, cell, lambda c, j: c * j / 19), "float64"),
            "property": ([stage * 7 * c for c in cell], "int32"),
            "pair": (columns(2, cell, lambda c, j: c * j), "int32")}}


def joint():
    return {
        "points": [[(3 * i + j) / 3 for j in (1, 2, 3)] for i in range(5)],
        "cells": [(1, [i]) for i in range(5)],
        "point_data": {},
        "cell_data": {"branch": ([1, 2, 3, 4, 1], "int32")}}


def compare(found, expected, where):
    """Equal to the last bit: the file holds the numbers as they are."""
    check(numpy.array_equal(found["points"], numpy.array(expected["points"])), where + ": points")
    check(found["points"].dtype == numpy.float64, where + ": kind of the points")
    check(found["cells"] == expected["cells"], where + ": cells")
    for data in ("point_data", "cell_data"):
        check(sorted(found[data]) == sorted(expected[data]), where + ": names of " + data)
        for name, (values, kind) in expected[data].items():
            if check(name in found[data], where + ": no " + name):
                check(numpy.array_equal(found[data][name], numpy.array(values)), where + ": values of " + name)
                check(found[data][name].dtype == kind, where + ": kind of " + name)


def consistent(grid, where):
    n_points, n_cells = len(grid["points"]), len(grid["cells"])
    check(numpy.isfinite(grid["points"]).all(), where + ": points are finite")
    check(all(0 <= k < n_points for _, nodes in grid["cells"] for k in nodes), where + ": nodes of the cells")
    for data, n in (("point_data", n_points), ("cell_data", n_cells)):
        for name, values in grid[data].items():
            check(len(values) == n, where + ": size of " + name)
            check(numpy.isfinite(values).all(), where + ": " + name + " is finite")


def temperatures(point_data, time, history, where):
    """All nodes are as warm as HISTORY says, T0:T1:..., at the times 0, 1, ... and on straight lines between; empty: no field."""
    name = "temperature [deg]"
    if not history:
        check(name not in point_data, where + ": no temperatures")
    elif check(name in point_data, where + ": no " + name):
        values = [float(t) for t in history.split(":")]
        expected = numpy.interp(time, range(len(values)), values)
        check(abs(point_data[name] - expected).max() < 1e-7 * abs(expected), where + ": temperature is %r" % expected)


def shapes(grid, where):
    """Natural modes: nothing but the numbers of the nodes and a vector a mode, in the order of frequencies; none is zero."""
    names = [name for name in grid["point_data"] if name != "node"]
    words = [re.fullmatch(r"mode (\d+), frequency (\S+)", name) for name in names]
    if not check(names and all(words), where + ": its fields are modes: %r" % names):
        return
    of_mode = sorted((int(word[1]), float(word[2]), name) for word, name in zip(words, names))
    check([mode[0] for mode in of_mode] == list(range(of_mode[0][0], of_mode[0][0] + len(names))), where + ": numbers of the modes")
    check(all(a[1] <= b[1] for a, b in zip(of_mode, of_mode[1:])), where + ": frequencies ascend")
    for name in names:
        values = grid["point_data"][name]
        check(values.shape == (len(grid["points"]), 3) and abs(values).max() > 0, where + ": shape of " + name)
    check(not grid["cell_data"], where + ": no fields of elements")


def read_list(path):
    """The rows of a .pvd: (time, part, file)."""
    root = ElementTree.parse(path).getroot()
    check(root.tag == "VTKFile" and root.get("type") == "Collection", path + ": type of file")
    return [(float(row.get("timestep")), int(row.get("part")), row.get("file"))
            for row in root.findall("Collection/DataSet")]


def attempt(read, path, name):
    where = "%s, %s" % (os.path.basename(path), name)
    try:
        return read(path), where
    except Exception as error:  # whatever the reader says of the file
        check(False, "%s: %s" % (where, error))
        return None, where


def main():
    folder, lists = sys.argv[1], sys.argv[2:]
    readers = {}
    if meshio is not None:
        readers["meshio"] = read_meshio
    if vtk is not None:
        readers["vtk"] = read_vtk
    for name in ("meshio", "vtk"):
        print("%s: %s" % (name, "reads the files" if name in readers else "not there, skipped"))

    rows = read_list(os.path.join(folder, "sample.pvd"))
    check(rows == [(1.0, 0, "sample.1.vtu"), (1.0, 1, "sample.1.joint.vtu"), (3.0, 0, "sample.2 & <3>.vtu"),
                   (3.0, 1, "sample.2.joint.vtu")], "sample.pvd: its rows")
    expected = {"sample.1.vtu": solid(1), "sample.1.joint.vtu": joint(), "sample.2 & <3>.vtu": solid(2)}
    for name, read in readers.items():
        for _, _, file in rows:
            if name == "meshio" and file not in expected:
                continue  # meshio has no word for a grid without cells
            grid, where = attempt(read, os.path.join(folder, file), name)
            if grid is None:
                continue
            if file in expected:
                compare(grid, expected[file], where)
            else:
                check(len(grid["points"]) == 0 and len(grid["cells"]) == 0, where + ": empty")

    for path in lists:
        path, _, history = path.partition("@")
        rows = read_list(path)
        check(len(rows) > 0, path + ": has rows")
        for time, part, file in rows:
            file = os.path.join(os.path.dirname(path), file)
            check(os.path.isfile(file), file + " is there")
            for name, read in readers.items():
                grid, where = attempt(read, file, name)
                if grid is not None:
                    consistent(grid, where)
                    if part == 0:
                        temperatures(grid["point_data"], time, history, where)
                    if part == 2:
                        shapes(grid, where)

    print("%d passed, %d failed" % (counts["passed"], counts["failed"]))
    sys.exit(counts["failed"] > 0)


main()
