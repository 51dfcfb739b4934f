"""Write the bar of bar_KIND.bdf as FILE: .msh by meshio; .inp as Abaqus has it, faces as shells; .med as Salome has it, with volumes
that are turned the other way and a family for every group.

   meshio_files.py BAR FILE
"""
import sys

import meshio
import numpy

KIND = {"CTETRA": "tetra10", "CHEXA": "hexahedron20", "CTRIA6": "triangle6", "CQUAD8": "quad8"}
GROUPS = {1: "body", 21: "left", 22: "right", 23: "below", 25: "front"}
ABAQUS = {"tetra10": "C3D10", "hexahedron20": "C3D20", "triangle6": "STRI65", "quad8": "S8R"}
MED = {"tetra10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8],
       "hexahedron20": [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]}

points, kinds = [], []
for line in open(sys.argv[1]):
    fields = [line[k:k + 8].strip() for k in range(0, len(line.rstrip()), 8)]
    if fields[0] == "GRID":
        points.append([float(x) for x in fields[3:6]])
    elif fields[0][:1] == "C":
        kinds.append([KIND[fields[0]], int(fields[2]), [int(n) - 1 for n in fields[3:9]]])
    elif fields[0][:1] == "+":
        kinds[-1][2] += [int(n) - 1 for n in fields[1:9]]
for cell in kinds:
    if cell[0] == "hexahedron20":  # NASTRAN has the edges between the faces before those of the second face
        cell[2] = cell[2][:12] + cell[2][16:] + cell[2][12:16]
file = sys.argv[2]
if file.endswith(".inp"):
    with open(file, "w") as out:
        out.write("*Heading\n*Node\n")
        for n, x in enumerate(points, 1):
            out.write(f"{n}, {x[0]:.12g}, {x[1]:.12g}, {x[2]:.12g}\n")
        for pid, name in GROUPS.items():
            for kind, code in ABAQUS.items():
                some = [(e, cell) for e, (k, ref, cell) in enumerate(kinds, 1) if (k, ref) == (kind, pid)]
                if some:
                    out.write(f"*Element, type={code}, elset={name}\n")
                for e, cell in some:
                    words = [str(e)] + [str(node + 1) for node in cell]
                    out.write(", ".join(words[:12]) + (",\n" + ", ".join(words[12:]) if len(words) > 12 else "") + "\n")
else:
    is_med = file.endswith(".med")
    types = sorted({k for k, _, _ in kinds})
    cells = [(t, numpy.array([[c[n] for n in MED[t]] if is_med and t in MED else c for k, _, c in kinds if k == t])) for t in types]
    refs = [numpy.array([ref for k, ref, _ in kinds if k == t]) for t in types]
    if is_med:
        mesh = meshio.Mesh(points, cells, cell_data={"cell_tags": [-r for r in refs]})
        mesh.cell_tags = {-pid: [name] for pid, name in GROUPS.items()}
        mesh.point_tags = {}
        mesh.write(file)
    else:
        mesh = meshio.Mesh(points, cells, cell_data={"gmsh:physical": refs, "gmsh:geometrical": refs},
                           field_data={name: numpy.array([pid, 3 if pid == 1 else 2]) for pid, name in GROUPS.items()})
        mesh.write(file, "gmsh22")
