#!/usr/bin/env python3
"""Render one frame of an nsframe run to a PNG, or a stretch of time to an animated GIF, without a display.

    render_frame.py RUN_FOLDER -o frame.png [--time 4.2] [--scale 20] [--torsion 100]
    render_frame.py RUN_FOLDER -o motion.gif --from 5 --to 7 [--speed 0.25]

Reads frames.pvd, and summary.json if it is there. Needs pyvista (and Pillow, which comes with it).
"""
import argparse
import json
import math
import pathlib

import numpy as np
import pyvista as pv
from PIL import Image

CONTACT, SLAB = 0, 1  # codes of the cell field "kind"
MARK = "#d55e00"      # vermilion of the Okabe-Ito palette
MARK_FRAMES = 5       # of an animation that show a contact after it was hit


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="folder with frames.pvd")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("frame.png"))
    parser.add_argument("--time", type=float, help="model time [s]; default: the frame with the largest impulse")
    parser.add_argument("--scale", type=float, help="factor on the displacements; default: visible")
    parser.add_argument("--torsion", type=float, metavar="FACTOR",
                        help="factor on the twist of the slabs, about the corner hit; default: that of the displacements")
    parser.add_argument("--true-gaps", action="store_true",
                        help="do not scale the gaps with the displacements (buildings that touch then seem to overlap)")
    parser.add_argument("--field", default="displacement", choices=["displacement", "velocity", "peak_strain_ratio"])
    parser.add_argument("--size", type=int, nargs=2, default=(1140, 760), metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--view", type=float, nargs=3, default=(0.45, -1.0, 0.32), metavar=("X", "Y", "Z"),
                        help="direction from the model to the camera")
    parser.add_argument("--title", help="default: the run's title")
    parser.add_argument("--from", dest="start", type=float, help="of an animation [s]; default: the first frame")
    parser.add_argument("--to", dest="end", type=float, help="of an animation [s]; default: the last frame")
    parser.add_argument("--speed", type=float, default=0.25, help="of an animation: 1 is true time; default: 0.25")
    return parser.parse_args()


def read_frames(run):
    reader = pv.get_reader(str(run / "frames.pvd"))
    return reader, np.asarray(reader.time_values)


def read_frame(reader, index):
    reader.set_active_time_point(int(index))
    mesh = reader.read()
    return mesh[0] if isinstance(mesh, pv.MultiBlock) else mesh


def choose_frame(arguments, reader, times, summary):
    """Index of the frame at --time, else of the first one after the strongest impact, else of the middle one."""
    if arguments.time is not None:
        return int(np.argmin(np.abs(times - arguments.time)))
    impacts = summary.get("impacts", [])
    if impacts:
        strongest = max(impacts, key=lambda impact: impact["impulse"])
        return min(int(np.searchsorted(times, strongest["t"] - 1e-9)), len(times) - 1)
    return len(times) // 2


def visible_scale(mesh):
    """Draws the largest displacement as about 4 % of the model's diagonal, rounded to 1, 2 or 5 times 10^n."""
    largest = np.linalg.norm(mesh["displacement"], axis=1).max()
    wanted = 0.04 * mesh.length
    if largest <= 0 or largest >= wanted:
        return 1.0
    decade = 10 ** math.floor(math.log10(wanted / largest))
    return max(1.0, decade * min((1, 2, 5, 10), key=lambda lead: abs(lead - wanted / largest / decade)))


def reach(points, origin, normal, radius):
    """How far the solid around a contact's node stands out beyond it along the normal."""
    near = points[np.linalg.norm(np.cross(points - origin, normal), axis=1) < radius]
    return max(0.0, float(np.max((near - origin) @ normal, initial=0.0)))


def structure_offsets(mesh, scale):
    """How far each structure moves apart so that the gaps are drawn `scale` times wider too, between the faces of the
    solids instead of the nodes: contacts then close where the solids touch."""
    structure, kind = mesh.cell_data["structure"], mesh.cell_data["kind"]
    solids = {int(s): np.asarray(pick(mesh, (structure == s) & (kind != CONTACT)).points)
              for s in np.unique(structure[kind != CONTACT])}
    steps = {}
    for cell in np.flatnonzero(kind == CONTACT):
        first, second = np.asarray(mesh.get_cell(int(cell)).points)
        near = min(solids, key=lambda s: np.min(np.linalg.norm(solids[s] - second, axis=1)))
        if near != structure[cell]:
            own, gap = int(structure[cell]), np.linalg.norm(second - first)
            normal = (second - first) / gap if gap > 0 else np.zeros(3)
            faces = (reach(solids[own], first, normal, 0.05 * mesh.length) +
                     reach(solids[near], second, -normal, 0.05 * mesh.length))
            steps.setdefault((own, near), []).append((scale - 1) * (second - first) + faces * normal)
    offsets = {}
    for start in solids:
        if start in offsets:
            continue
        offsets[start], waiting = np.zeros(3), [start]
        while waiting:
            known = waiting.pop()
            for (a, b), moves in steps.items():
                for here, there, sign in ((a, b, 1), (b, a, -1)):
                    if here == known and there not in offsets:
                        offsets[there] = offsets[known] + sign * np.mean(moves, axis=0)
                        waiting.append(there)
    return offsets


def draw_apart(mesh, offsets):
    """Moves the points of each structure by its offset; a contact's second point goes with the solid it lies on."""
    structure, kind = mesh.cell_data["structure"], mesh.cell_data["kind"]
    shift = np.zeros((mesh.n_points, 3))
    owner = np.full(mesh.n_points, -1)
    for cell in range(mesh.n_cells):
        if kind[cell] != CONTACT:
            owner[mesh.get_cell(cell).point_ids] = structure[cell]
    for s, offset in offsets.items():
        shift[owner == s] = offset
    known = np.flatnonzero(owner >= 0)
    for cell in np.flatnonzero(kind == CONTACT):
        for point in mesh.get_cell(int(cell)).point_ids:
            shift[point] = shift[known[np.argmin(np.linalg.norm(mesh.points[known] - mesh.points[point], axis=1))]]
    return mesh.points + shift


def struck_corner(mesh, structure):
    """Where the structure was hit hardest in this frame, or None."""
    contacts = np.flatnonzero((mesh.cell_data["kind"] == CONTACT) & (mesh.cell_data["impulse"] > 0))
    if not len(contacts):
        return None
    hardest = contacts[np.argmax(mesh.cell_data["impulse"][contacts])]
    ends = np.asarray(mesh.get_cell(int(hardest)).points)
    own = pick(mesh, (mesh.cell_data["structure"] == structure) & (mesh.cell_data["kind"] == SLAB))
    if own is None:
        return None
    return min(ends, key=lambda end: np.min(np.linalg.norm(own.points - end, axis=1)))


def twist_of(points, displacement):
    """Rotation about z that fits the horizontal displacement of a slab's points best [rad]."""
    arm = points[:, :2] - points[:, :2].mean(axis=0)
    moved = displacement[:, :2] - displacement[:, :2].mean(axis=0)
    return float(np.sum(arm[:, 0] * moved[:, 1] - arm[:, 1] * moved[:, 0]) / np.sum(arm**2))


def added_torsion(mesh, factor):
    """Displacement that `factor` more twist of the slabs gives, about the corner hit, so that contacts stay closed.
    Between the slabs it varies linearly with height, from zero at the base."""
    extra = np.zeros((mesh.n_points, 3))
    structure, kind = mesh.cell_data["structure"], mesh.cell_data["kind"]
    base = mesh.points[:, 2].min()
    for s in np.unique(structure[kind == SLAB]):
        slabs = pick(mesh, (structure == s) & (kind == SLAB))
        floors = {}
        for point, moved in zip(slabs.points, slabs["displacement"]):
            floors.setdefault(round(float(point[2]), 3), []).append((point, moved))
        heights = [base] + sorted(floors)
        twists = [0.0] + [twist_of(*map(np.array, zip(*floors[z]))) for z in sorted(floors)]
        center = struck_corner(mesh, s)
        center = center if center is not None else slabs.points.mean(axis=0)
        own = np.unique(np.concatenate([mesh.get_cell(int(c)).point_ids for c in np.flatnonzero(structure == s)]))
        arm = mesh.points[own] - center
        angle = factor * np.interp(mesh.points[own, 2], heights, twists)
        extra[own, 0], extra[own, 1] = -angle * arm[:, 1], angle * arm[:, 0]
    return extra


def pick(mesh, mask):
    return mesh.extract_cells(np.flatnonzero(mask)) if mask.any() else None


def colors_of(field, mesh):
    """Adds the array to show and returns its name and its label."""
    if field == "peak_strain_ratio":
        return field, "largest strain\nof a fiber /\nyield strain\n"
    values = np.linalg.norm(mesh[field], axis=1)
    mesh["shown"] = 1e3 * values if field == "displacement" else values
    return "shown", "displacement\n(mm)\n" if field == "displacement" else "velocity\n(m/s)\n"


def text_size(plotter, points):
    """Font size for this picture; `points` is right for one of 1000 pixels in height."""
    return max(6, round(points * plotter.window_size[1] / 1000))


def surface_of(mesh):
    return mesh.extract_surface(algorithm="dataset_surface")


def add_structures(plotter, reference, deformed, field, highest=None):
    name, label = colors_of(field, deformed)
    kind = deformed.cell_data["kind"]
    highest = highest or float(np.max(deformed[name], initial=0)) or 1.0
    style = dict(scalars=name, cmap="viridis", clim=(0, highest), show_scalar_bar=False)
    plain = dict(color="#c8ccd0") if field == "peak_strain_ratio" else style  # of elastic members, slabs
    measured = deformed.cell_data[name] > 0 if field == "peak_strain_ratio" else np.full(deformed.n_cells, True)
    shown = None
    for mask, look in (((kind > SLAB) & measured, style), ((kind > SLAB) & ~measured, plain)):
        solids = pick(deformed, mask)
        if solids is not None:
            surface = surface_of(solids)
            actor = plotter.add_mesh(surface, ambient=0.25, specular=0.1, line_width=3, **look)
            shown = actor if look is style else shown
            if look is not style and surface.n_lines:
                lines = [cell for cell in range(surface.n_cells) if surface.get_cell(cell).dimension == 1]
                plotter.add_mesh(surface.extract_cells(lines), color="#777777", line_width=3, lighting=False)
    slabs = pick(deformed, kind == SLAB)
    if slabs is not None:
        actor = plotter.add_mesh(slabs, opacity=0.55, ambient=0.3, **plain)
        shown = actor if plain is style else shown
        plotter.add_mesh(surface_of(slabs).extract_feature_edges(20), color="#333333", line_width=2)
    rest = pick(reference, kind == SLAB)
    if rest is not None:
        plotter.add_mesh(surface_of(rest).extract_feature_edges(20), color="#999999", line_width=1)
    if shown is not None:
        plotter.add_scalar_bar(label, mapper=shown.mapper, vertical=True, position_x=0.89, position_y=0.22, height=0.5,
                               width=0.05, title_font_size=text_size(plotter, 25),
                               label_font_size=text_size(plotter, 23), color="black", fmt="%.3g",
                               n_labels=5)


def add_contacts(plotter, deformed, size):
    contacts = pick(deformed, deformed.cell_data["kind"] == CONTACT)
    if contacts is None:
        return 0
    plotter.add_mesh(contacts, color="#666666", line_width=2)
    hit = contacts.cell_data["impulse"] > 0
    for cell in np.flatnonzero(hit):
        impulse = contacts.cell_data["impulse"][cell]
        center = np.asarray(contacts.get_cell(int(cell)).points).mean(axis=0)
        plotter.add_mesh(pv.Sphere(radius=0.016 * size, center=center), color=MARK, ambient=0.4)
        plotter.add_point_labels([center + [0, 0, 0.025 * size]], [f"{impulse:.0f} N s"], text_color=MARK, font_size=text_size(plotter, 27),
                                 shape="rounded_rect", shape_color="white",
                                 shape_opacity=0.75, show_points=False, always_visible=True, bold=True)
    return int(hit.sum())


def add_axes(plotter, mesh):
    """A box of whole steps around the model, with its grid behind."""
    spans = np.array(mesh.bounds).reshape(3, 2)
    largest = np.ptp(spans, axis=1).max()
    step = min((lead * 10.0**n for n in range(-3, 5) for lead in (1, 2, 5)), key=lambda s: abs(largest / s - 6))
    low, high = np.floor(spans[:, 0] / step + 0.2) * step, np.ceil(spans[:, 1] / step - 0.2) * step
    high = np.maximum(high, low + step)
    counts = np.rint((high - low) / step).astype(int) + 1
    plotter.show_bounds(bounds=np.column_stack([low, high]).ravel().tolist(), xtitle="x (m)", ytitle="y (m)",
                        ztitle="z (m)", color="black", font_size=text_size(plotter, 22), location="outer", ticks="outside", grid="back",
                        n_xlabels=int(counts[0]), n_ylabels=int(counts[1]), n_zlabels=int(counts[2]),
                        fmt="%g", use_3d_text=False)


def draw(arguments, summary, mesh, time, scale, highest=None, still=False):
    """The picture of one frame. `highest`: the end of the colour bar, in its unit; `still`: the camera looks at the model at rest."""
    scale_gaps = scale != 1 and not arguments.true_gaps
    if scale_gaps:
        mesh.points = draw_apart(mesh, structure_offsets(mesh, scale))
    deformed = mesh.copy()
    deformed.points = mesh.points + scale * mesh["displacement"]
    if arguments.torsion:
        deformed.points += added_torsion(mesh, arguments.torsion - scale)

    plotter = pv.Plotter(off_screen=True, window_size=list(arguments.size), lighting="light kit")
    plotter.set_background("white")
    add_structures(plotter, mesh, deformed, arguments.field, highest)
    hits = add_contacts(plotter, deformed, mesh.length)

    add_axes(plotter, mesh)
    title = arguments.title or summary.get("title") or "nsframe"
    plotter.add_text(title, position=(0.03, 0.945), viewport=True, font_size=text_size(plotter, 18), color="black")
    marks = f",  {hits} contact{'s' if hits != 1 else ''} hit (marked)" if hits else ""
    gaps = " and gaps" if scale_gaps else ""
    torsion = f", torsion x {arguments.torsion:g}" if arguments.torsion else ""
    plotter.add_text(f"t = {time:.3f} s,  displacements{gaps} x {scale:g}{torsion}{marks}", position=(0.03, 0.905),
                     viewport=True, font_size=text_size(plotter, 14), color="#333333")
    center = np.array(mesh.center)
    plotter.camera_position = [center + 3 * mesh.length * np.array(arguments.view), center, (0, 0, 1)]
    plotter.reset_camera(bounds=mesh.bounds if still else None)
    plotter.camera.zoom(1.06 if still else 1.14)
    plotter.camera.SetWindowCenter(0.06, 0.01)  # the title is above, the colour bar at the right
    plotter.enable_anti_aliasing("ssaa")
    picture = Image.fromarray(plotter.screenshot(return_img=True))
    plotter.close()
    return picture


def gif_palette():
    """Viridis lit, in shade and through a slab, greys and the mark's colour: one palette for all frames, so that none flickers."""
    steps = np.linspace(0, 1, 36)
    viridis = np.array([pv.LookupTable("viridis").map_value(step)[:3] for step in steps])
    greys = np.linspace(0, 1, 24)[:, None] * np.ones(3)
    mark = np.array([int(MARK[k:k + 2], 16) for k in (1, 3, 5)]) / 255
    slabs = [0.55 * shade * viridis + 0.45 for shade in (1, 0.85, 0.7)]
    colors = np.concatenate([viridis, 0.75 * viridis, *slabs, greys, [mark, 0.75 * mark, 0.5 * mark + 0.5]])
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.rint(255 * colors).astype(np.uint8).ravel().tolist())
    return palette


def animate(arguments, summary, reader, times):
    """The frames from --from to --to, each for the time to the next over the speed; marks stay for some frames."""
    start = times[0] if arguments.start is None else arguments.start
    end = times[-1] if arguments.end is None else arguments.end
    chosen = np.flatnonzero((times >= start - 1e-9) & (times <= end + 1e-9))
    if len(chosen) < 2:
        raise SystemExit(f"there are {len(chosen)} frames from {start:g} to {end:g} s, of {times[0]:g} to {times[-1]:g} s")
    meshes = [read_frame(reader, index) for index in chosen]
    scale = arguments.scale or visible_scale(max(meshes, key=lambda mesh: np.abs(mesh["displacement"]).max()))
    names = [colors_of(arguments.field, mesh)[0] for mesh in meshes]
    highest = max(float(np.max(mesh[name], initial=0)) for name, mesh in zip(names, meshes))
    impulses = [mesh.cell_data["impulse"].copy() for mesh in meshes]
    pictures = []
    for k, (index, mesh) in enumerate(zip(chosen, meshes)):
        mesh.cell_data["impulse"] = np.max(impulses[max(0, k + 1 - MARK_FRAMES):k + 1], axis=0)
        pictures.append(draw(arguments, summary, mesh, times[index], scale, highest, still=True))
    frames = [picture.quantize(palette=gif_palette(), dither=Image.Dither.NONE) for picture in pictures]
    milliseconds = np.diff(times[chosen], append=times[chosen[-1]] + times[1] - times[0]) * 1e3 / arguments.speed
    frames[0].save(arguments.output, save_all=True, append_images=frames[1:], loop=0, optimize=True,
                   duration=[int(round(value)) for value in milliseconds])
    print(f"{arguments.output}: {len(frames)} frames, displacements x {scale:g}")


def main():
    arguments = parse()
    summary_file = arguments.run / "summary.json"
    summary = json.loads(summary_file.read_text()) if summary_file.exists() else {}
    reader, times = read_frames(arguments.run)
    pv.OFF_SCREEN = True
    if arguments.output.suffix == ".gif":
        animate(arguments, summary, reader, times)
        return
    index = choose_frame(arguments, reader, times, summary)
    mesh = read_frame(reader, index)
    scale = arguments.scale or visible_scale(mesh)
    draw(arguments, summary, mesh, times[index], scale).save(arguments.output, optimize=True)
    print(f"{arguments.output}: t = {times[index]:.3f} s, displacements x {scale:g}")


if __name__ == "__main__":
    main()
