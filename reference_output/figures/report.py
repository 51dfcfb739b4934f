#!/usr/bin/env python3
"""A report of a deck: one HTML page with all pictures inside.

    report.py PROGRAM DECK FOLDER

runs DECK with files for ParaView and writes FOLDER/NAME.report.html: answer, model, deflected shape, joints with contoured pressure, bolts,
modes, response, backbone, warnings. Bodies are drawn by PyVista where it is installed, else by gnuplot, which also draws curves (deck.sh).
"""
import base64
import csv
import html
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FORMATS = {"Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B"}
# VTK cells: faces of solids by corners; of second-order cells the number of corners, and the edges of the mid-side nodes
SOLIDS = {10: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
          12: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
          13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
          14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))}
EDGES = {24: (4, (0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
         25: (8, (0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
         26: (6, (0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))}
SOLIDS.update({24: SOLIDS[10], 25: SOLIDS[12], 26: SOLIDS[13]})
FLAT = {5: 3, 22: 3, 9: 4, 23: 4}  # corners
BANDS = ["#fff7c9", "#fee391", "#fec44f", "#fe9929", "#f0701f", "#d94801", "#b5300a", "#862008", "#5c120a", "#37070a"]
SCALE = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"]  # of displacements
VIEWER = (0.549, -0.713, 0.436)  # where the viewer stands
COLOURS = ["#7b9fc7", "#c9a66b", "#8fb58a", "#b48ead", "#a3a3a3", "#d08770", "#6fb7b7", "#c2b280"]
class Grid:
    """Points, cells (kind, nodes) and columns of a VTU file; of a column 'pressure [N/MM2]' UNITS has ' [N/mm2]'."""

    def __init__(self, path):
        data = path.read_bytes()
        end = data.index(b"<AppendedData")
        start = data.index(b"_", data.index(b">", end)) + 1
        self.columns, self.units = {}, {}
        for kind, name, offset in re.findall(r'<DataArray type="(\w+)" Name="([^"]*)"[^>]*offset="(\d+)"', data[:end].decode()):
            at, form = start + int(offset), FORMATS[kind]
            count = struct.unpack_from("<Q", data, at)[0]//struct.calcsize(form)
            key, _, unit = name.partition(" [")
            self.columns[key], self.units[key] = struct.unpack_from(f"<{count}{form}", data, at + 8), unit and " [" + re.sub(r"(k?)n\b", r"\1N", unit.lower())
        self.points = list(zip(*[iter(self.columns["points"])]*3))
        offsets = (0,) + self.columns["offsets"]
        nodes = self.columns["connectivity"]
        self.cells = [(kind, nodes[offsets[i]:offsets[i + 1]]) for i, kind in enumerate(self.columns["types"])]

    def faces(self):
        """(cell, corners, mid-side nodes or ()) of flat cells and of sides of solids that one solid has."""
        single = {}
        for i, (kind, nodes) in enumerate(self.cells):
            if kind in FLAT:
                n = FLAT[kind]
                single[i] = (i, nodes[:n], nodes[n:2*n])
            first, *edges = EDGES.get(kind, (0,))
            middle = {frozenset(e): nodes[first + k] for k, e in enumerate(edges)}
            for side in SOLIDS.get(kind, ()):
                key, outline = frozenset(nodes[c] for c in side), zip(side, side[1:] + side[:1])
                single[key] = None if key in single else (i, tuple(nodes[c] for c in side),
                                                          tuple(middle[frozenset(e)] for e in outline) if middle else ())
        return [face for face in single.values() if face]

dot = lambda a, b: sum(x*y for x, y in zip(a, b))

def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]

def ring(face):
    """The nodes of a face in the order of its outline."""
    _, corners, middle = face
    return [n for pair in zip(corners, middle) for n in pair] if middle else list(corners)

def figure(picture, caption):
    """An SVG, or the PNG of a path, with its caption."""
    if isinstance(picture, pathlib.Path):
        picture = f'<img alt="{picture.stem}" src="data:image/png;base64,{base64.b64encode(picture.read_bytes()).decode()}">'
    return f"<figure>{picture}<figcaption>{html.escape(caption)}</figcaption></figure>"

is_plane = lambda points: max(p[2] for p in points) - min(p[2] for p in points) <= 1e-9
def draw_pyvista(png, points, faces, values, title):
    import pyvista as pv
    mesh = pv.PolyData(points, [k for face in faces for k in (len(ring(face)), *ring(face))])
    plotter = pv.Plotter(off_screen=True, window_size=(1000, 760))
    how = dict(scalars="values", show_edges=True, edge_color="#5b6470", line_width=0.5, ambient=0.35)
    if isinstance(values[0], str):
        mesh.cell_data["values"] = [[int(values[face[0]][k:k + 2], 16) for k in (1, 3, 5)] for face in faces]
        plotter.add_mesh(mesh, rgb=True, **how)
    else:
        mesh["values"] = values
        bar = dict(title=title + " ", color="black", n_labels=4, fmt="%.3g", vertical=True, position_x=0.86, position_y=0.25, height=0.5)
        plotter.add_mesh(mesh, cmap="viridis", scalar_bar_args=bar, **how)
    plotter.view_vector(*(((0, 0, 1), (0, 1, 0)) if is_plane(points) else (VIEWER, (0, 0, 1))))
    plotter.screenshot(str(png))
    plotter.close()

def pieces_of(points, faces, values, cells):
    """Triangles of the faces that the viewer sees, none larger than 3 % of the model: corners (x, y, depth), colour as a number."""
    flat, across = is_plane(points), math.hypot(*VIEWER[:2])
    right = (-VIEWER[1]/across, VIEWER[0]/across, 0.0)
    axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1)) if flat else (right, cross(VIEWER, right), VIEWER)
    seen = [tuple(dot(axis, p) for axis in axes) for p in points]
    largest = 0.03*max(max(q[k] for q in seen) - min(q[k] for q in seen) for k in range(2))
    by_cell = isinstance(values[0], str)
    low, high = (0.0, 1.0) if by_cell else (min(values), max(values))
    for face in faces:
        nodes, cell = ring(face), cells[face[0]][1]
        normal = cross(*([seen[n][k] - seen[face[1][0]][k] for k in range(3)] for n in face[1][1:3]))
        inner = [sum(seen[n][k] for n in cell)/len(cell) - seen[face[1][0]][k] for k in range(3)]
        if not flat and len(cell) != len(nodes) and dot(normal, inner)*normal[2] >= 0:
            continue  # a side of a solid that is turned away
        unit = [x/(math.hypot(*normal) or 1.0) for x in normal]
        shade = 1.0 if flat else 0.55 + 0.45*abs(dot(unit, (0.35, 0.45, 0.82)))
        corners = [seen[n] + (0.0 if by_cell else (values[n] - low)/((high - low) or 1.0),) for n in nodes]
        middle = tuple(sum(c[k] for c in corners)/len(corners) for k in range(4))
        stack = [corners] if len(corners) == 3 else [[c, corners[(k + 1) % len(corners)], middle] for k, c in enumerate(corners)]
        while stack:
            piece = stack.pop()
            k = max(range(3), key=lambda i: math.dist(piece[i][:3], piece[(i + 1) % 3][:3]))
            a, b, c = piece[k], piece[(k + 1) % 3], piece[(k + 2) % 3]
            if math.dist(a[:3], b[:3]) > largest:
                half = tuple((x + y)/2 for x, y in zip(a, b))
                stack += [[a, half, c], [half, b, c]]
                continue
            at = (a[3] + b[3] + c[3])/3*(len(SCALE) - 1)
            i = min(int(at), len(SCALE) - 2)
            one, two = (values[face[0]],)*2 if by_cell else SCALE[i:i + 2]
            rgb = [int(shade*(int(one[k:k + 2], 16)*(i + 1 - at) + int(two[k:k + 2], 16)*(at - i))) for k in (1, 3, 5)]
            yield [q[:3] for q in (a, b, c)], rgb[0]*65536 + rgb[1]*256 + rgb[2]
def draw_gnuplot(png, points, faces, values, title, cells):
    data, spots = png.with_suffix(".faces"), []
    with open(data, "w") as file:
        for piece, colour in pieces_of(points, faces, values, cells):
            spots += piece
            a, b, c = (" ".join(f"{x:.7g}" for x in q) + f" {colour}" for q in piece)
            file.write(f"{a}\n{b}\n\n{c}\n{c}\n\n\n")
    span = [(min(q[k] for q in spots), max(q[k] for q in spots)) for k in range(3)]
    span[2] = (span[2][0], max(span[2][1], span[2][0] + 1e-3*(span[0][1] - span[0][0])))
    ranges = "; ".join(f"set {axis}range [{low:.9g}:{high:.9g}]" for axis, (low, high) in zip("xyz", span))
    wide, tall, deep = (high - low for low, high in span)
    zoom = 1.8*max(wide, tall, deep)/max(wide, tall)*(0.85 if wide > tall else 1.0)
    scale = "unset colorbox" if isinstance(values[0], str) else f"""set cbrange [{min(values):.6g}:{max(max(values), 1e-30):.6g}]; set cbtics
set palette defined ({", ".join(f'{k} "{c}"' for k, c in enumerate(SCALE))}); set colorbox user origin 0.84, 0.25 size 0.02, 0.5"""
    subprocess.run(["gnuplot"], check=True, text=True, stderr=subprocess.DEVNULL, input=f"""set terminal pngcairo size 1000,760 font 'DejaVu Sans,15'
set output '{png}'; set pm3d depthorder corners2color c1; {ranges}; set view 0, 0, {zoom:.4g}; set view equal xyz; unset border; unset key; set lmargin at screen 0.02
set rmargin at screen 0.86; unset xtics; unset ytics; unset ztics; {scale}
set cblabel '{title}'; set format cb '%.3g'; splot '{data}' using 1:2:3:4 with pm3d fillcolor rgb variable, NaN with lines palette
""")

def draw_bodies(png, grid, points, values, title=""):
    try:
        draw_pyvista(png, points, grid.faces(), values, title)
    except Exception:  # PyVista is not installed, or has no display
        draw_gnuplot(png, points, grid.faces(), values, title, grid.cells)
    return png

def clip(polygon, limit, sign):
    """The part of POLYGON, a list of (x, y, p), where sign p >= sign limit."""
    out = []
    for k, b in enumerate(polygon):
        a = polygon[k - 1]
        inside = [sign*(q[2] - limit) >= 0 for q in (a, b)]
        if inside[0] != inside[1]:
            t = (limit - a[2])/(b[2] - a[2])
            out.append(tuple(x + t*(y - x) for x, y in zip(a, b)))
        if inside[1]:
            out.append(b)
    return out

def joint_picture(grid, joint, highest, normal):
    """SVG of the pressure of a joint: its faces filled between lines of equal pressure, white where it is open."""
    faces = [f for f in grid.faces() if grid.columns["joint"][f[1][0]] == joint]
    if not faces or not any(normal):
        return ""
    k = min(range(3), key=lambda i: round(abs(normal[i]), 6))
    across = [(i == k) - normal[k]*normal[i] for i in range(3)]
    across = [x/math.hypot(*across) for x in across]
    flat = {n: [dot(v, grid.points[n]) for v in (across, cross(normal, across))] for n in {n for f in faces for n in ring(f)}}
    low, high = ([f(flat[n][k] for n in flat) for k in range(2)] for f in (min, max))
    scale = min(410/(high[0] - low[0]), 340/(high[1] - low[1]))
    spot = {n: (10 + (x - low[0])*scale, 10 + (high[1] - y)*scale, max(0.0, grid.columns["pressure"][n])) for n, (x, y) in flat.items()}

    def polygon(corners, style):
        return f'<polygon points="{" ".join(f"{q[0]:.1f},{q[1]:.1f}" for q in corners)}" {style}/>'
    out = []
    for face in faces:
        nodes = [spot[n] for n in ring(face)]
        if len(nodes) == 6:  # corners and mid-side nodes: four triangles
            pieces = [[nodes[k - 1], nodes[k], nodes[k + 1]] for k in (0, 2, 4)] + [nodes[1::2]]
        else:
            middle = tuple(sum(q[k] for q in nodes)/len(nodes) for k in range(3))
            pieces = [nodes] if len(nodes) == 3 else [[nodes[k - 1], q, middle] for k, q in enumerate(nodes)]
        for piece in pieces:
            if max(q[2] for q in piece) <= 0.0:
                continue
            for band, colour in enumerate(BANDS):
                part = clip(clip(piece, highest*band/len(BANDS), 1), highest*(band + 1)/len(BANDS), -1)
                if len(part) > 2:
                    out.append(polygon(part, f'fill="{colour}" stroke="{colour}" stroke-width="0.3"'))
        out.append(polygon(nodes, 'fill="none" stroke="#8a97a5" stroke-width="0.4"'))
    right, tall = 24 + (high[0] - low[0])*scale, max(20 + (high[1] - low[1])*scale, 230)
    for k, colour in enumerate(BANDS):
        y = 10 + 20*(len(BANDS) - 1 - k)
        out.append(f'<rect x="{right:.0f}" y="{y}" width="16" height="20" fill="{colour}"/>'
                   f'<text x="{right + 20:.0f}" y="{y + 5}" font-size="11">{highest*(k + 1)/len(BANDS):.3g}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{right + 75:.0f}" height="{tall:.0f}" '
            f'font-family="DejaVu Sans,Arial">{"".join(out)}</svg>')

def rows_of(path, *keys):
    """The rows of a CSV file; with KEYS the last row of each group."""
    rows = list(csv.DictReader(open(path, newline=""))) if path.exists() else []
    return list({tuple(row[k] for k in keys): row for row in rows}.values()) if keys else rows

def table(rows, columns):
    """ROWS as a table of COLUMNS: names of the CSV file, or name=heading; empty ones are left out."""
    def cell(text):
        try:
            value = float(text)
        except ValueError:
            return html.escape(text)
        return text if re.fullmatch(r"-?\d+", text) else f"{value:.0f}" if 1e4 <= abs(value) < 1e7 else f"{value:.4g}"
    pairs = [column.partition("=")[::2] for column in columns.split(", ")]
    pairs = [(k, name or k.replace("_", " ")) for k, name in pairs if any(row.get(k) for row in rows)]
    head = "".join(f"<th>{html.escape(name)}</th>" for _, name in pairs)
    body = "".join("<tr>" + "".join(f"<td>{cell(row.get(k) or '')}</td>" for k, _ in pairs) + "</tr>" for row in rows)
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>' if rows else ""

def with_vtu(deck):
    """The text of DECK that asks for files for ParaView; paths of INCLUDE become absolute."""
    def include(match):
        return f"{match[1]}'{deck.parent.resolve() / match[2].strip().strip(chr(39) + chr(34))}'"
    text = re.sub(r"(?im)^(\s*INCLUDE\s*=?\s*)([^$\n]+)", include, deck.read_text(errors="replace"))
    head, begin, bulk = (re.split(r"(?im)^([ \t]*BEGIN[ \t]+BULK)", text, maxsplit=1) + ["", ""])[:3]
    head = re.sub(r"(?im)^([ \t]*OUTPUT[ \t]*=[^$\n]*?)[ \t]*(\$.*)?$", lambda m: m[0] if "VTU" in m[1].upper() else m[1] + ", VTU", head)
    if "OUTPUT" not in re.split(r"(?im)^[ \t]*SUBCASE", re.sub(r"(?m)\$.*", "", head))[0].upper():
        head = re.sub(r"(?im)^(?=[ \t]*SUBCASE)|\Z", "OUTPUT = LAST, VTU\n", head, count=1)
    return head + begin + bulk

def shapes(work, name, kind):
    """Figures of the displacements at the ends of the stages (kind ''), or of the modes (kind '.modes')."""
    text = []
    for path in sorted(work.glob(f"{name}.*vtu"), key=lambda path: [int(n) for n in re.findall(r"\.(\d+)\.", path.name)]):
        stage = re.fullmatch(re.escape(name) + r"(?:\.(\d+))?" + re.escape(kind) + r"\.vtu", path.name)
        if not stage:
            continue
        grid, words = Grid(path), f"Stage {stage[1]}: " if stage[1] else ""
        for i, key in enumerate([k for k in grid.columns if k.startswith("mode ")][:8] if kind else ["displacement"]):
            vectors, unit = list(zip(*[iter(grid.columns[key])]*3)), grid.units[key]
            size = [math.hypot(*v) for v in vectors]
            span = max(max(p[k] for p in grid.points) - min(p[k] for p in grid.points) for k in range(3))
            scale = float(f"{(0.1 if kind else 0.06)*span/max(size):.0e}") if max(size) > 0 else 1.0
            points = [tuple(p[k] + scale*u[k] for k in range(3)) for p, u in zip(grid.points, vectors)]
            picture = draw_bodies(work / f"{path.stem}.{i}.png", grid, points, size, "shape" if kind else f"displacement{unit}")
            text.append(figure(picture, words + (f"{key.split(',')[0]}, {float(key.split()[-1]):.4g} Hz" if kind else
                                                 f"displacement{unit} up to {max(size):.4g}, drawn {scale:g} times")))
    return "".join(text)

def joints(work, name, stages):
    text = []
    grids = {s: Grid(p) for s in dict.fromkeys(r["stage"] for r in stages) for p in [work / f"{name}.{s}.joint.vtu",
             work / f"{name}.joint.vtu"] if p.exists()}
    for row in sorted(stages, key=lambda row: int(row["joint"])):
        joint, grid = int(row["joint"]), grids.get(row["stage"])
        highest = max((p for g in grids.values() for p, j in zip(g.columns["pressure"], g.columns["joint"]) if j == joint), default=0.0)
        picture = joint_picture(grid, joint, highest, [float(row["normal_" + x]) for x in "xyz"]) if grid and highest > 0 else ""
        if picture:
            text.append(figure(picture, f"Joint {joint}, stage {row['stage']}: pressure{grid.units['pressure']}, largest "
                                        f"{float(row['p_max']):.4g}, contact {100*float(row['contact']):.1f} %; white: open"))
    return "".join(text)

def bolts(rows):
    text = table(rows, "stage, bolt, force, change, tightened, largest, whole_load, share, stress, edge_stress, use=of ST, joint, clamping, "
                       "loss, safety=mu N/T")
    if rows and "by_forces" in rows[0]:
        text += "<p>Change of the tension since assembly</p>" + table(rows, "stage, bolt, by_forces, by_temperature, by_pressure, by_several, "
                                                                            "share, share_pressure")
    if rows and "assembly_force" in rows[0]:
        text += "<p>One real bolt after VDI 2230: forces, stress amplitude, safeties</p>" + table(rows, "stage, bolt, assembly_force, "
            "allowed_force, working_load, residual, amplitude, yield, fatigue, fatigue_rolled=fatigue rolled last, slip, opening")
    return text

def warnings_of(listing, said):
    found = [" ".join(w.split()) for w in re.findall(r"^  WARNING: (.*(?:\n {11,}\S.*)*)", listing, re.M)]
    said = [re.sub(r"^\S*\.\w+: ", "", line).strip() for line in said.splitlines() if not re.search(r"warnings? in the listing$", line)]
    found += [w for w in said if w and w.upper()[:40] not in " ".join(found)]
    return "".join(f'<div class="warning">{html.escape(w)}</div>' for w in found) or "<p>None.</p>"

def build_page(name, work, run):
    listing = (work / f"{name}.out").read_text()
    lines = [line.strip() for line in listing.splitlines()]
    stages = rows_of(work / f"{name}.stage.csv", "stage", "joint")
    answers = [a.rstrip() for a in re.split(r"\n(?= ANSWER )", run.stdout) if a.startswith(" ANSWER")]
    summary = re.search(r"MODEL SUMMARY\n\n(.*?)\n\n", listing, re.S)
    parts = {"Answer": table(rows_of(work / f"{name}.watch.csv"), "stage, node, u_x=u x, u_y=u y, u_z=u z, load, along=movement along it, stiffness")
             + table(stages, "stage, joint, u_max=largest displacement, mises_max=largest von Mises, contact, p_max=largest pressure, "
                             "gap_max=largest gap, slipping, n=N, t=T, safety=mu N/T")
             + "".join(f"<details><summary>{html.escape(a.split(chr(10))[0])}</summary><pre>{html.escape(a)}</pre></details>" for a in answers)}
    grid = next((Grid(p) for p in sorted(work.glob(f"{name}*.vtu")) if re.fullmatch(r"(\.\d+)?\.vtu", p.name[len(name):])), None)
    if grid:
        ids = sorted(set(grid.columns["property"]))
        colours = [COLOURS[ids.index(p) % len(COLOURS)] for p in grid.columns["property"]]
        parts["Model"] = figure(draw_bodies(work / "model.png", grid, grid.points, colours), "Bodies, coloured by property")
    parts["Model"] = parts.get("Model", "") + (f"<pre>{html.escape(summary[1])}</pre>" if summary else "")
    parts["Deflected shape"] = shapes(work, name, "")
    parts["Joints"] = joints(work, name, stages)
    said = subprocess.run([str(HERE / "deck.sh"), "-", str(work / f"{name}.bdf"), str(work)], capture_output=True, text=True).stdout
    curves = [(pathlib.Path(p), *p.split(".")[-3:-1]) for p in said.split("\n") if p.endswith(".png")]
    loops = ("normal", "shear_x", "shear_y") if parts["Joints"] else ("pressure", "deflection", "normal", "shear_x", "shear_y")
    parts["Joints"] += "".join(figure(p, f"Joint {j}: {kind.replace('_', ' ')}") for p, j, kind in curves if kind in loops)
    parts["Bolts"] = bolts(rows_of(work / f"{name}.bolt.csv", "stage", "bolt"))
    parts["Modes"] = table(rows_of(work / f"{name}.modes.csv"), "stage, mode, frequency, mass_x=effective mass x, mass_y=effective mass y, "
                           "mass_z=effective mass z, loss_factor, kind=most energy in, id, energy=its share") + shapes(work, name, ".modes")
    for words, kinds in (("Response", ("response",)), ("Backbone", ("backbone", "loops"))):
        parts[words] = "".join(figure(p, f"{kind.capitalize()}, stage {stage}") for p, kind, stage in curves if kind in kinds)
    parts["Warnings"] = warnings_of(listing, run.stderr)
    title = lines[2] if not lines[2].startswith("DECK ") else name
    about = next(line for line in lines if line.startswith("DECK "))
    parts = {k: v for k, v in parts.items() if v}
    style = (HERE / "report.css").read_text()
    slug = {k: k.lower().replace(" ", "-") for k in parts}
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f"<title>{html.escape(title)}</title><style>{style}</style></head><body><h1>{html.escape(title)}</h1><p>{html.escape(about)}. {html.escape(lines[-1])}</p><nav>"
            + "".join(f'<a href="#{slug[k]}">{k}</a>' for k in parts) + "</nav>\n"
            + "\n".join(f'<section id="{slug[k]}"><h2>{k}</h2>{v}</section>' for k, v in parts.items()) + "\n</body></html>\n")

def main():
    program, deck, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    deck.is_file() or sys.exit(f"there is no deck {deck}")
    shutil.which("gnuplot") or sys.exit("make report needs gnuplot: apt-get install gnuplot-nox")
    work = folder / f"{deck.stem}.files"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    copy = work / f"{deck.stem}.bdf"
    copy.write_text(with_vtu(deck))
    run = subprocess.run([program, "-q", "-o", str(work), str(copy)], capture_output=True, text=True)
    if not (work / f"{deck.stem}.out").exists():
        print(run.stderr, end="", file=sys.stderr)
        print(f"{deck} ended with status {run.returncode}: there is no report")
    else:
        (folder / f"{deck.stem}.report.html").write_text(build_page(deck.stem, work, run))
        print(folder / f"{deck.stem}.report.html")
    sys.exit(run.returncode)

if __name__ == "__main__":
    main()
