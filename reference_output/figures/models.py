#!/usr/bin/env python3
"""Pictures of models, drawn from the VTU files of a deck: bodies, magnified displacements and the pressure of a joint.

    models.py PROGRAM FOLDER [NAME...]

runs the decks of `input` below with OUTPUT = VTU and writes FOLDER/model_NAME.png. It needs PyVista (`pip install pyvista`), which
nothing else in the project does.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import pyvista as pv

ROOT = pathlib.Path(__file__).resolve().parents[2]
WHITE, GREY, EDGE = "white", "#c9ced6", "#5b6470"

# deck, stage (MODE k: a natural mode), magnification, mirror plane of the half model, view (from, up), joints drawn beside it
PICTURES = {
    "bracket": dict(stage=2, scale=200, mirror="y", view=((1.0, -1.3, 0.8), (0, 0, 1)), joint=1, joint_view=((0, 0, 1), (0, 1, 0))),
    "flanged_column": dict(stage=2, scale=300, mirror="x", view=((1.5, -1.2, 0.5), (0, 0, 1)), joint=1,
                           joint_view=((0, 0, 1), (0, 1, 0))),
}


def column(mesh, name):
    """The array of MESH whose name begins with NAME; behind it stands the unit."""
    key = next(k for k in list(mesh.point_data) + list(mesh.cell_data) if k.split(" [")[0] == name)
    return key, mesh[key]


def whole(mesh, mirror):
    """MESH and its mirror image, displacements included, where a half was modelled."""
    if not mirror:
        return mesh
    other = mesh.reflect({"x": (1, 0, 0), "y": (0, 1, 0)}[mirror], point=(0, 0, 0), transform_all_input_vectors=False)
    key, u = column(other, "displacement")
    u = np.array(u)
    u[:, "xyz".index(mirror)] *= -1
    other[key] = u
    return mesh.merge(other, merge_points=False)


def run(program, deck, folder):
    """Results of DECK with files for ParaView in FOLDER."""
    text = (ROOT / "input" / f"{deck}.bdf").read_text()
    head, rest = text.split("BEGIN BULK", 1)
    lines = [line for line in head.split("\n") if not line.strip().startswith("OUTPUT")]
    where = next(i for i, line in enumerate(lines) if line.startswith("SUBCASE"))
    lines.insert(where, "OUTPUT = NONE, VTU")
    (folder / f"{deck}.bdf").write_text("\n".join(lines) + "BEGIN BULK" + rest)
    link = folder / "gmsh"
    if not link.exists():
        link.symlink_to(ROOT / "input" / "gmsh")
    subprocess.run([program, "-q", "-o", str(folder), str(folder / f"{deck}.bdf")], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def look(plotter, view):
    """The camera, so that the legend has its place below."""
    plotter.view_vector(*view)
    plotter.enable_parallel_projection()
    plotter.camera.zoom(0.97)
    up = 0.12*plotter.camera.parallel_scale*np.array(view[1])
    plotter.camera.position = np.array(plotter.camera.position) - up
    plotter.camera.focal_point = np.array(plotter.camera.focal_point) - up


def draw(name, folder, target):
    what = PICTURES[name]
    bodies = whole(pv.read(folder / f"{name}.{what['stage']}.vtu"), what["mirror"])
    joints = whole(pv.read(folder / f"{name}.{what['stage']}.joint.vtu"), what["mirror"])
    plotter = pv.Plotter(off_screen=True, shape=(1, 2), window_size=(1500, 700), border=False)
    plotter.set_background(WHITE)
    bar = dict(color="black", font_family="arial", title_font_size=24, label_font_size=20, n_labels=4, fmt="%.3g", position_x=0.15,
               width=0.7, height=0.09, position_y=0.01)

    plotter.subplot(0, 0)
    key, u = column(bodies, "displacement")
    bodies["moved"] = u
    bent = bodies.warp_by_vector("moved", factor=what["scale"])
    unit = key.split(" ")[-1]
    title = f"displacement {unit}, drawn {what['scale']} times"
    bent[title] = np.linalg.norm(u, axis=1)
    skin = bent.extract_surface(algorithm="dataset_surface", nonlinear_subdivision=0)
    plotter.add_mesh(skin, scalars=title, cmap="viridis", show_edges=True, edge_color=EDGE, line_width=0.5, scalar_bar_args=bar)
    look(plotter, what["view"])

    plotter.subplot(0, 1)
    one = joints.extract_points(column(joints, "joint")[1] == what["joint"], adjacent_cells=False)
    key, p = column(one, "pressure")
    one[key] = np.where(p > 0.0, p, np.nan)
    title = f"pressure of joint {what['joint']} {key.split(' ')[-1]}, open where white"
    one[title] = one[key]
    bar["n_labels"] = 3
    plotter.add_mesh(one, scalars=title, cmap="inferno_r", clim=(0.0, float(np.nanpercentile(one[title], 99.0))), nan_color=WHITE, lighting=False, show_edges=True, edge_color=EDGE, line_width=0.5,
                     scalar_bar_args=bar)
    look(plotter, what["joint_view"])
    plotter.screenshot(target / f"model_{name}.png")
    plotter.close()


def main():
    program, target = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for name in sys.argv[3:] or PICTURES:
            run(program, name, pathlib.Path(scratch))
            draw(name, pathlib.Path(scratch), target)
            print(target / f"model_{name}.png")


if __name__ == "__main__":
    main()
