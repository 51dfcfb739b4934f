#!/usr/bin/env python3
"""Pictures of models, drawn from the VTU files of a deck: deformed bodies, the pressure of a joint, natural modes.

    models.py PROGRAM FOLDER [NAME...]

runs the decks of `input` below with OUTPUT = VTU and writes FOLDER/model_NAME.png. It needs PyVista (`pip install pyvista`, and
`apt-get install libgl1 libxrender1 xvfb` on a machine without a screen: `xvfb-run -a models.py ...`), which nothing else in the project does.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import pyvista as pv

ROOT = pathlib.Path(__file__).resolve().parents[2]
EDGE, TEXT = "#5b6470", "black"
SHADED = dict(ambient=0.45, diffuse=0.6)
FROM_TOP, UP_Z = (0, 0, 1), (0, 0, 1)

# deck, stage, magnification, mirror plane of a half model, view of the bodies (from, up), joints drawn beside them and their view
PICTURES = {
    "bracket": dict(stage=2, scale=200, mirror="y", view=((1.0, -1.3, 0.8), UP_Z), joints=[1], joint_view=(FROM_TOP, (0, 1, 0))),
    "flanged_column": dict(stage=2, scale=300, mirror="x", view=((1.5, -1.2, 0.5), UP_Z), joints=[1], joint_view=(FROM_TOP, (0, 1, 0))),
    "box_column": dict(stage=2, scale=150, mirror=None, view=((1.0, -1.6, 0.6), UP_Z), joints=[1], joint_view=(FROM_TOP, (0, 1, 0))),
    "slideway": dict(stage=3, scale=10000, mirror=None, view=((1.2, 0.9, -1.5), (0, 1, 0)), joints=[1, 2],
                     joint_view=((0, 1, 0), (0, 0, -1))),
    "column_modes_08": dict(stage=2, modes=[1, 2, 3], view=((1.3, -1.2, 0.5), UP_Z)),
}


def column(mesh, name):
    """The array of MESH whose name begins with NAME; the unit stands behind it."""
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
    for name in ("gmsh", "vibration"):
        if not (folder / name).exists():
            (folder / name).symlink_to(ROOT / "input" / name)
    subprocess.run([program, "-q", "-o", str(folder), str(folder / f"{deck}.bdf")], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def skin_of(mesh):
    return mesh.extract_surface(algorithm="dataset_surface", nonlinear_subdivision=0)


def look(plotter, view, title, room=0.16):
    """The camera of a panel, with ROOM for the legend below and for TITLE above."""
    plotter.view_vector(*view)
    plotter.enable_parallel_projection()
    plotter.camera.zoom(0.85)
    up = np.array(view[1], dtype=float)
    along = np.array(view[0], dtype=float)/np.linalg.norm(view[0])
    up -= up.dot(along)*along
    up *= 0.5*room*plotter.camera.parallel_scale/np.linalg.norm(up)
    plotter.camera.position = np.array(plotter.camera.position) - up
    plotter.camera.focal_point = np.array(plotter.camera.focal_point) - up
    plotter.add_text(title, position=(0.03, 0.94), viewport=True, font_size=13, color=TEXT, font="arial")


def colours(plotter, mesh, values, cmap, limits, panel, **how):
    """MESH coloured by VALUES, with its legend below."""
    mesh["values"] = values
    plotter.add_mesh(mesh, scalars="values", cmap=cmap, clim=limits, show_edges=True, edge_color=EDGE, line_width=0.5,
                     show_scalar_bar=False, copy_mesh=True, interpolate_before_map=True, **how)
    plotter.add_scalar_bar(title=" "*(panel + 1), color=TEXT, font_family="arial", label_font_size=22, n_labels=3, fmt="%.3g", position_x=0.2,
                           width=0.6, height=0.07, position_y=0.02)


def open_is_white(highest):
    table = pv.LookupTable("inferno_r", n_values=512, scalar_range=(0.0, highest))
    values = table.values.copy()
    values[0] = (255, 255, 255, 255)
    table.values = values
    return table


def outline(plotter, mesh):
    """The edges of the bodies before they deform."""
    plotter.add_mesh(skin_of(mesh).extract_feature_edges(30.0), color="#9aa3ad", line_width=1.5)


def draw_state(name, what, folder, plotter):
    bodies = whole(pv.read(folder / f"{name}.{what['stage']}.vtu"), what["mirror"])
    joints = whole(pv.read(folder / f"{name}.{what['stage']}.joint.vtu"), what["mirror"])
    plotter.subplot(0, 0)
    key, u = column(bodies, "displacement")
    bodies["moved"] = u
    skin = skin_of(bodies.warp_by_vector("moved", factor=what["scale"]))
    size = np.linalg.norm(skin["moved"], axis=1)
    outline(plotter, bodies)
    colours(plotter, skin, size, "viridis", (0.0, float(size.max())), 0, **SHADED)
    look(plotter, what["view"], f"displacement {key.split(' ')[-1].lower()}, drawn {what['scale']} times")

    plotter.subplot(0, 1)
    one = joints.extract_points(np.isin(column(joints, "joint")[1], what["joints"]), adjacent_cells=False)
    key, p = column(one, "pressure")
    highest = float(np.percentile(p[p > 0.0], 99.0))
    colours(plotter, one, p, open_is_white(highest), (0.0, highest), 1, lighting=False)
    which = " and ".join(str(j) for j in what["joints"])
    unit = key.split(" ")[-1].replace("N/MM2", "N/mm2").replace("KGF/MM2", "kgf/mm2")
    look(plotter, what["joint_view"], f"pressure of joint{'s' if len(what['joints']) > 1 else ''} {which} {unit}; white: open")


def draw_modes(name, what, folder, plotter):
    bodies = pv.read(folder / f"{name}.{what['stage']}.modes.vtu")
    span = max(np.ptp(bodies.points, axis=0))
    for i, mode in enumerate(what["modes"]):
        key = next(k for k in bodies.point_data if k.startswith(f"mode {mode},"))
        shape = np.array(bodies[key])
        shape *= 0.12*span/np.linalg.norm(shape, axis=1).max()
        moved = bodies.copy()
        moved["shape"] = shape
        skin = skin_of(moved.warp_by_vector("shape"))
        size = np.linalg.norm(skin["shape"], axis=1)
        plotter.subplot(0, i)
        outline(plotter, bodies)
        colours(plotter, skin, size/size.max(), "viridis", (0.0, 1.0), i, **SHADED)
        look(plotter, what["view"], f"mode {mode}: {float(key.split()[-1]):.1f} Hz")


def draw(name, folder, target):
    what = PICTURES[name]
    panels = len(what.get("modes", [])) or 2
    plotter = pv.Plotter(off_screen=True, shape=(1, panels), window_size=(1500, 700), border=False)
    plotter.set_background("white")
    (draw_modes if "modes" in what else draw_state)(name, what, folder, plotter)
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
