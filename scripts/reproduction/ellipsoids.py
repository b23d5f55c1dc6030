"""Figures 8, 9 and 18: compliance ellipsoids along a segment, at the tips of two, and of a parallel robot."""
import numpy

from .drawing import X_Z, Y_Z, common_scale, ellipse, plane_axes, save, shades, subplots
from .robot import PATTERN, Solved, evenly, place, sweep
from .section import Section

FRACTIONS = (0.5, 0.6, 0.7, 0.8, 1.0)
FIGURE_8 = {"a": ("one pair", 1.5), "b": ("two pairs, +x", 1.5), "c": ("all", 0.9)}
BACKBONE = evenly(21)
APART_CM = 2.0  # straight robots, drawn side by side


def figure8(context):
    section = Section("figure8", "Figure 8: compliance ellipsoids along a segment", text=(
        "NCM, `paper_one_segment.yaml`, pressures in steps of 0.3 bar. Eigenvalues are those of the translational "
        "block of the material compliance, cm/N. Where the robot bends, two of the three axes lie in the plane of "
        "bending: the printed 3.60 is the larger of these two, and the third, across the plane, is larger still."))
    figure, axes = subplots(1, 3, (12.0, 5.0), gridspec_kw={"width_ratios": [5.6, 6.2, 9.6]}, sharey=True)
    rows = {}
    for ax, (panel, (pattern, largest)) in zip(axes[0], FIGURE_8.items()):
        rows[panel] = context.programs.stations(sorted(set(BACKBONE) | set(FRACTIONS)),
                                                pressures_bar=sweep(PATTERN[pattern], largest, 0.3))
        for i, (row, colour) in enumerate(zip(rows[panel], shades(len(rows[panel])))):
            aside = numpy.array([APART_CM * i if panel == "c" else 0.0, 0.0, 0.0])
            points = numpy.array([row.position_cm(place(1, f)) for f in BACKBONE]) + aside
            ax.plot(points[:, 0], points[:, 2], color=colour, linewidth=1.8)
            for f in FRACTIONS:
                ellipse(ax, row.position_cm(place(1, f)) + aside, row.compliance(before=place(1, f)), 0.2,
                        facecolor=colour + (0.25,), edgecolor=colour)
        low, high = (rows[panel][i].eigenvalues() for i in (0, -1))
        plane_axes(ax, X_Z, "(%s) %s\ntip: %.2f to %.2f cm/N at rest,\n%.2f to %.2f cm/N at %g bar" % (
            panel, {"a": "P1 = P2", "b": "P3 = P4 = P5 = P6", "c": "all six, set apart"}[panel], low[0], low[-1],
            high[0], high[-1], largest))
    save(figure, context.figures, "figure8")
    section.figures.append(("figure8", "Shadows of the ellipsoids on the x-z plane, scaled by 0.2 N, at 0.5, 0.6, 0.7, "
                                       "0.8 and 1 of the length. Darker: more pressure."))
    rest, bent, long = rows["a"][0], rows["a"][-1], rows["c"][-1]
    half = place(1, 0.5)
    section.number("tip at rest, largest, cm/N", 1.84, rest.eigenvalues()[2], 2)
    section.number("tip at rest, smallest, cm/N", 0.13, rest.eigenvalues()[0], 5)
    section.number("tip, P1 = P2 = 1.5 bar, largest in plane, cm/N", 3.60, bent.in_plane_eigenvalues()[1], 2)
    section.number("tip, P1 = P2 = 1.5 bar, smallest in plane, cm/N", 0.36, bent.in_plane_eigenvalues()[0], 5)
    section.number("tip, P1 = P2 = 1.5 bar, largest of all three, cm/N", 3.60, bent.eigenvalues()[2])
    section.number("tip, all at 0.9 bar, largest, cm/N", 9.34, long.eigenvalues()[2], 2)
    section.number("middle at rest, largest, cm/N", 0.40, rest.eigenvalues(half)[2])
    section.number("middle at rest, smallest, cm/N", 0.06, rest.eigenvalues(half)[0])
    section.number("middle, 1.5 bar, largest, cm/N", 0.72, bent.eigenvalues(half)[2])
    section.number("middle, 1.5 bar, largest in plane, cm/N", 0.72, bent.in_plane_eigenvalues(half)[1])
    section.number("middle, 1.5 bar, smallest, cm/N", 0.11, bent.eigenvalues(half)[0])
    growing = all((numpy.diff([row.eigenvalues(place(1, f))[i] for f in FRACTIONS]) > 0).all()
                  for i in (0, 2) for row in rows["a"]) and all(
        (numpy.diff([row.eigenvalues(place(1, f))[i] for row in rows["a"]]) > 0).all()
        for i in (0, 2) for f in FRACTIONS)
    section.statement("(a): compliance grows from middle to tip and with pressure", "monotonically",
                      "monotonically" if growing else "not everywhere", growing)
    ratios = rows["b"][-1].eigenvalues() / bent.eigenvalues()
    section.statement("tip at 1.5 bar, (b) over (a), smallest and largest eigenvalue", "about 2 to 3 times",
                      "%.2f and %.2f times" % (ratios[0], ratios[2]), 1.8 < min(ratios) and max(ratios) < 3.2)
    section.bounds = (
        "Bounds: 2 % at the tip, where the scene was inferred from other numbers of the paper (Table 5), and 5 % where "
        "two printed digits are all there is. None in the middle: at rest the printed 0.40 is 0.22 of the tip's 1.84; "
        "a straight uniform rod, at half its length, has between 0.125 (bending alone) and 0.5 (shear alone), and the "
        "shear that Table 5 asks for gives 0.19.")
    return section


FIGURE_9 = {"a": [1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0], "b": [1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1]}
TWO = {"paper_two_segments": "as Table 5", "paper_two_segments_table6": "as Table 6"}


def figure9(context):
    section = Section("figure9", "Figure 9: compliance ellipsoids at the tips of two segments", text=(
        "NCM, 0 to 1.2 bar in steps of 0.3 bar. The paper gives no data of the second segment and prints the "
        "eigenvalues in the picture only; its text gives ratios. Two scenes: `paper_two_segments.yaml`, two times the "
        "segment of Table 5 with weight (drawn), and `paper_two_segments_table6.yaml` (see Table 6)."))
    figure, axes = subplots(1, 2, (9.2, 5.0))
    smallest = {}
    for scene, label in TWO.items():
        for ax, (panel, pattern) in zip(axes[0], FIGURE_9.items()):
            rows = context.programs.stations(BACKBONE, scene=scene, pressures_bar=sweep(pattern, 1.2, 0.3))
            if scene == "paper_two_segments":
                draw_two_segments(ax, rows)
                plane_axes(ax, X_Z, "(%s) %s" % (panel, "P1 = P2 = P7 = P8" if panel == "a" else
                                                 "P1 = P2 = P9 to P12"))
            smallest[panel, label] = compare_two_segments(section, panel, label, rows)
        section.statement("%s: smallest eigenvalue at tip 2 at 1.2 bar" % label, "varies less in (b) than in (a)",
                          "%.2f and %.2f cm/N" % (smallest["b", label], smallest["a", label]),
                          smallest["b", label] < smallest["a", label])
    common_scale(axes[0])
    save(figure, context.figures, "figure9")
    section.figures.append(("figure9", "Shadows on the x-z plane, scaled by 0.1 N. Blue: first segment, red: second, "
                                       "black: connection. Darker: more pressure."))
    section.bounds = (
        "90 to 100 % is met if within 5 points of that; 6 to 8 times, if it rounds to that. **Not reproduced**: the "
        "latter. At rest, where little but the lengths decides, ours is above 8 with both scenes, and it grows in (b).")
    return section


def draw_two_segments(ax, rows):
    for row, blue, red in zip(rows, shades(len(rows)), shades(len(rows), "#fcae91", "#99000d")):
        points = [numpy.array([row.position_cm(place(k, f)) for f in BACKBONE]) for k in (1, 2)]
        ax.plot(*zip(points[0][-1][[0, 2]], points[1][0][[0, 2]]), color="black", linewidth=2.5)
        for k, colour in ((1, blue), (2, red)):
            ax.plot(points[k - 1][:, 0], points[k - 1][:, 2], color=colour, linewidth=1.8)
            ellipse(ax, row.position_cm(place(k, 1)), row.compliance(before=place(k, 1)), 0.1,
                    facecolor=colour + (0.25,), edgecolor=colour)


def compare_two_segments(section, panel, label, rows):
    """Returns the smallest eigenvalue at the tip under the largest pressure, cm/N."""
    largest = {k: [row.eigenvalues(place(k, 1))[2] for row in rows] for k in (1, 2)}
    ratios = [b / a for a, b in zip(largest[1], largest[2])]
    if panel == "a":
        growth = [100 * (largest[k][-1] / largest[k][0] - 1) for k in (1, 2)]
        section.statement("(a), %s: largest eigenvalues grow by" % label, "90 to 100 %",
                          "%.0f %% and %.0f %%" % tuple(growth), all(85 < g < 105 for g in growth))
    section.statement("(%s), %s: tip 2 over tip 1, largest" % (panel, label), "about 6 to 8 times",
                      "%.1f to %.1f times" % (min(ratios), max(ratios)), 6 <= min(ratios) and max(ratios) <= 8.5,
                      checked=False)
    return rows[-1].eigenvalues(place(2, 1))[0]


# Panel: position (m), turn about y (deg), scale (N).
FIGURE_18 = {"a": ((0.0, 0.0, 0.5), 0.0, 250.0), "b": ((0.1, 0.0, 0.4), 0.0, 60.0), "c": ((0.0, 0.0, 0.4), 30.0, 15.0)}
RODS, POINTS = 6, 21


def figure18(context):
    section = Section("figure18", "Figure 18: a parallel continuum robot", text=(
        "`stewart_gough.yaml`: six steel rods; the paper prints neither rods nor holes, so both were chosen, once, so "
        "that (a) and (b) come out (see there). The pose of (b) is printed; those of (a) and (c) were chosen: straight "
        "at 0.5 m, and turned by 30 deg at 0.4 m. Compliance by (53); its tangent is beside it."))
    table = ["x_m,y_m,z_m,qw,qx,qy,qz"]
    for position, turn, _ in FIGURE_18.values():
        half = numpy.radians(turn) / 2
        table.append(",".join("%.17g" % v for v in (*position, numpy.cos(half), 0.0, numpy.sin(half), 0.0)))
    rows = [Solved(row) for row in context.programs.run(
        "parallel_solve", [context.programs.scene("stewart_gough"), "--inverse", "--points", str(POINTS)],
        "\n".join(table) + "\n")]
    figure, axes = subplots(2, 3, (10.0, 7.6))
    for column, (panel, (_, turn, scale)) in enumerate(FIGURE_18.items()):
        for ax, plane in zip(axes[:, column], (X_Z, Y_Z)):
            draw_parallel(ax, rows[column], plane, scale)
            plane_axes(ax, plane, "(%s) %s, scaled by %g N" % (
                panel, {"a": "elongates", "b": "translates", "c": "bends"}[panel], scale) if plane == X_Z else None)
    common_scale(list(axes.flat))
    save(figure, context.figures, "figure18")
    section.figures.append(("figure18", "Rods, platform, and shadow of the compliance ellipsoid."))
    a, b, c = (numpy.diag(row.compliance()) for row in rows)
    tangents = [numpy.diag(row.compliance("c")) for row in rows]
    section.number("(a) compliance along x over z", 110, a[0] / a[2], 5, "%.1f")
    section.number("(a) the same by the tangent", 110, tangents[0][0] / tangents[0][2], 5, "%.1f")
    section.number("(a) compliance along x over y", 1.0, a[0] / a[1], 0.1, "%.4f")
    section.number("(b) compliance along x over y", 2.0, b[0] / b[1], 10)
    section.number("(b) the same by the tangent", 2.0, tangents[1][0] / tangents[1][1], 10)
    largest = [row.eigenvalues()[2] for row in rows]
    text = ", ".join("%.2g" % value for value in largest) + " cm/N"
    section.statement("largest eigenvalue from (a) to (b)", "increases", text, largest[1] > largest[0])
    section.statement("largest eigenvalue from (b) to (c)", "further increases", text, largest[2] > largest[1])
    section.statement("(c) x over y closer to 1 than in (b)", "more isotropic",
                      "%.2f against %.2f" % (c[0] / c[1], b[0] / b[1]),
                      abs(numpy.log(c[0] / c[1])) < abs(numpy.log(b[0] / b[1])))
    section.bounds = (
        "Bounds: 5 and 10 %, as much as \"around 110\" and \"about 2 times\" bear. 0.1 % for the isotropy, which "
        "symmetry demands.")
    return section


def draw_parallel(ax, row, plane, scale):
    ends = []
    for rod in range(1, RODS + 1):
        points = 100 * numpy.array([row.numbers(["r%d_%d_%s_m" % (rod, i, axis) for axis in "xyz"])
                                    for i in range(1, POINTS + 1)])
        ends.append((points[0], points[-1]))
        ax.plot(points[:, plane[0]], points[:, plane[1]], color="#1d4e89", linewidth=1.2)
    for which, colour in ((0, "#888888"), (1, "#222222")):
        ring = numpy.array([end[which] for end in ends + ends[:1]])
        ax.plot(ring[:, plane[0]], ring[:, plane[1]], color=colour, linewidth=2.0)
    ellipse(ax, row.position_cm(), row.compliance(), scale, plane, facecolor="#e0a45866", edgecolor="#c1121f")
