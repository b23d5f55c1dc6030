"""Figures 6 and 12, Tables 3 and 4: where the tip goes under pressure, by the four models."""
import numpy

from .drawing import MODEL_STYLE, X_Z, common_scale, plane_axes, save, subplots
from .robot import MODELS, PATTERN, evenly, place, sweep
from .section import Section

ORDER = ("NCM", "NPCC", "LCM", "LPCC")


def figure6(context):
    section = Section("figure6", "Figure 6: bending by the four models", text=(
        "One segment, P1 = P2 (a) and P3 = P4 = P5 = P6 (b) from 0 to 1.5 bar in steps of 0.3 bar. The paper prints no "
        "numbers for this figure; it says how the curves lie. NCM and LCM under weight (`paper_one_segment.yaml`), "
        "NPCC and LPCC without (`paper_one_segment_npcc.yaml`, `_lpcc.yaml`)."))
    fractions = evenly(21)
    figure, axes = subplots(1, 2, (9.2, 4.3))
    angles = {}
    for ax, pattern in zip(axes[0], ("one pair", "two pairs, +x")):
        for model in ORDER:
            colour, line = MODEL_STYLE[model]
            rows = context.programs.stations(fractions, model=model,
                                             pressures_bar=sweep(PATTERN[pattern], 1.5, 0.3))
            angles[pattern, model] = [row.bending_deg() for row in rows]
            for i, row in enumerate(rows):
                points = numpy.array([row.position_cm(place(1, f)) for f in fractions])
                ax.plot(points[:, 0], points[:, 2], color=colour, linestyle=line, linewidth=1.3,
                        label=model if i == 0 else None)
        plane_axes(ax, X_Z, "(a) P1 = P2" if pattern == "one pair" else "(b) P3 = P4 = P5 = P6")
        if pattern == "one pair":
            section.statement("(a): one pair bends towards", "-x", "x = %.2f cm" % points[-1, 0], points[-1, 0] < 0)
    axes[0][0].legend(loc="lower left")
    common_scale(axes[0])
    save(figure, context.figures, "figure6")
    section.figures.append(("figure6", "Backbones in the x-z plane."))

    def spread(pattern, index):
        values = [angles[pattern, model][index] for model in ORDER]
        return max(values) - min(values)

    section.statement("(a): the models differ less at 0.6 bar than at 1.5", "less",
                      "%.1f against %.1f deg" % (spread("one pair", 2), spread("one pair", 5)),
                      spread("one pair", 2) < spread("one pair", 5))
    section.statement("(b): similar output below 0.3 bar", "similar", "within %.1f of %.1f deg" % (
        spread("two pairs, +x", 1), angles["two pairs, +x", "NCM"][1]), spread("two pairs, +x", 1) < 2.0)
    for pattern, label in (("one pair", "(a)"), ("two pairs, +x", "(b)")):
        last = {model: angles[pattern, model][-1] for model in ORDER}
        text = ", ".join("%s %.1f" % (model, last[model]) for model in ORDER) + " deg"
        section.statement(label + " at 1.5 bar: nonlinear models bend more than linear ones", "more", text,
                          last["NCM"] > last["LCM"] and last["NPCC"] > last["LPCC"])
        section.statement(label + " at 1.5 bar: Cosserat models bend more than PCC ones", "more", "the same",
                          last["NCM"] > last["NPCC"] and last["LCM"] > last["LPCC"])
    section.bounds = '"Similar" is taken as within 2 deg.'
    return section


# Panel: pattern, largest pressure (bar), what is plotted.
PANELS = {"12(a)": ("all", 1.2), "12(b)": ("one pair", 1.5), "12(c)": ("two pairs", 1.2)}


def panel_options(panel, model, bar):
    """The paper's steps up to `bar`: of 0.15 bar for one pair; n = 6 for two, and here for three, where it is "
    "silent."""
    if model not in ("NCM", "NPCC") or panel == "12(b)" or bar == 0:
        return []
    return ["--pressure-step-pa", "%.17g" % (1e5 * bar / 6 * (1 + 1e-12))]


def panel_values(context, panel, step=0.15):
    """Model: elongation (cm) or bending (deg) at every pressure."""
    pattern, largest = PANELS[panel]
    values = {}
    for model in ORDER:
        rows = [context.programs.solve([pressures], model=model, options=panel_options(panel, model, max(pressures)))[0]
                for pressures in sweep(PATTERN[pattern], largest, step)]
        heights = [row.position_cm()[2] for row in rows]
        values[model] = numpy.array([height - heights[0] for height in heights] if panel == "12(a)" else
                                    [row.bending_deg() for row in rows])
    return values


CONTINUOUS = ["--stepping", "continuous"]


def departure(curve):
    """Largest distance of a curve from the line between its ends, over its end."""
    return float(numpy.abs(curve - numpy.linspace(curve[0], curve[-1], len(curve))).max() / curve[-1])


def elongation_ratio(context, panel, options=None):
    """Of the backbone at the largest pressure, NCM: length of 400 chords, 1e-5 short."""
    pattern, largest = PANELS[panel]
    fractions = evenly(401)
    row, = context.programs.stations(fractions, model="NCM", options=options or panel_options(panel, "NCM", largest),
                                     pressures_bar=[[largest * share for share in PATTERN[pattern]]])
    points = numpy.array([row.position_cm(place(1, f)) for f in fractions])
    return float(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1).sum() / 4.0 - 1.0)


def figure12(context):
    section = Section("figure12", "Figure 12: nonlinear response, model curves", text=(
        "All chambers (a), one pair (b), two pairs (c). The experiments are not printed but for their ends: 2.7 cm, "
        "and angles of about 110 deg (90 deg in section 5.3). Steps of 0.15 bar in (b), n = 6 in (c) as the paper "
        "says, and n = 6 in (a), where it does not."))
    figure, axes = subplots(1, 3, (10.5, 3.6))
    found = {}
    for ax, (panel, (pattern, largest)) in zip(axes[0], PANELS.items()):
        found[panel] = panel_values(context, panel)
        pressures = numpy.linspace(0, largest, len(found[panel]["NCM"]))
        for model in ORDER:
            colour, line = MODEL_STYLE[model]
            ax.plot(pressures, found[panel][model], color=colour, linestyle=line, linewidth=1.6, label=model)
        end = 2.7 if panel == "12(a)" else 110
        ax.plot([largest], [end], "o", color="#3a86ff", markersize=6, label="experiment, its end", clip_on=False)
        ax.set_xlabel("pressure, bar")
        ax.set_ylabel("elongation, cm" if panel == "12(a)" else "bending angle, deg")
        ax.set_title({"12(a)": "(a) all chambers", "12(b)": "(b) one pair", "12(c)": "(c) two pairs"}[panel],
                     fontsize=10)
    axes[0][0].legend(loc="upper left", fontsize=8)
    save(figure, context.figures, "figure12")
    section.figures.append(("figure12", "Steps of 0.15 bar; NCM and NPCC in (a) and (c) with n = 6 steps each."))

    elongation = found["12(a)"]
    fine, = context.programs.solve([[1.2] * 6], options=CONTINUOUS)
    rest, = context.programs.solve([[0.0] * 6])
    limit = fine.position_cm()[2] - rest.position_cm()[2]
    section.number("(a) experiment at 1.2 bar, beside NCM with n = 6, cm", 2.7, elongation["NCM"][-1])
    section.number("(a) the same beside the limit of small steps, cm", 2.7,
                   limit)
    section.number("(a) linear models: experiment less their largest error, cm", 2.7 - 1.06, elongation["LCM"][-1], 10)
    section.number("(b) elongation ratio by NCM at the end", 0.2, elongation_ratio(context, "12(b)"), 10)
    section.number("(c) the same, n = 6", 0.4, elongation_ratio(context, "12(c)"))
    section.number("(c) the same in the limit of small steps", 0.4, elongation_ratio(context, "12(c)", CONTINUOUS))
    for panel in PANELS:
        off = {model: 100 * departure(found[panel][model]) for model in ORDER}
        section.statement("(%s) linear models behave in a linear way compared to nonlinear ones" % panel[3], "linear",
                          "off a line by " + ", ".join("%s %.1f %%" % item for item in off.items()),
                          max(off["LCM"], off["LPCC"]) < 0.5 * min(off["NCM"], off["NPCC"]))
    section.bounds = (
        "Bounds: 10 %%, since the paper gives 0.2 to one digit, and 1.06 cm is the largest error at a pressure that it "
        "does not name; linear: half as far off a line as the nonlinear models. 2.7 cm and 0.4 have no bound. **Not "
        "reproduced**: the paper's NCM and NPCC err by at most 0.13 cm from 2.7 cm. Ours are shorter: the modulus "
        "comes from Table 5, and six steps of 0.2 bar stretch the robot by %.0f %% less than small ones do." % (
            100 * (1 - elongation["NCM"][-1] / limit)))
    return section


def table3(context):
    section = Section("table3", "Table 3: errors of the models against experiments", text=(
        "Errors against recordings that the paper does not print, so they cannot be recomputed. What can be: how far "
        "the models are from one another. If all of them err most at the largest pressure and to the same side, as "
        "Figure 12 suggests, the differences of their printed largest errors are the differences of the models there. "
        "The table has the distance of each model from NCM."))
    printed = context.paper["table_3"]
    for panel in PANELS:
        values = panel_values(context, panel)
        unit = " cm" if panel == "12(a)" else " deg"
        for model in ("NPCC", "LCM", "LPCC"):
            difference = values["NCM"] - values[model]
            what = "%s, NCM - %s at the end" % (panel, model)
            papers = printed[panel][model][0] - printed[panel]["NCM"][0]
            if papers:
                section.number(what, papers, difference[-1], unit=unit)
            else:
                section.statement(what, "at most 0.26" + unit, "%.2f" % difference[-1] + unit,
                                  abs(difference[-1]) <= 0.26)
            least = abs(printed[panel][model][2] - printed[panel]["NCM"][2])
            rms = float(numpy.sqrt(numpy.mean(difference ** 2)))
            section.statement("%s, RMS of NCM - %s" % (panel, model), "at least %.2f" % least + unit,
                              "%.2f" % rms + unit, rms >= least, checked=panel == "12(b)")
    section.bounds = (
        "RMS: two curves can lie no closer together than their RMS errors against the same third one differ, provided "
        "the same pressures are weighted alike. That is checked for (b), where it is met, and stated for the others. "
        "Two models that err by at most 0.13 cm each are at most 0.26 cm apart.")
    return section


def triangles(largest_bars, order):
    """Quasi-static rise and fall of the patterns one after another, for every amplitude."""
    ramp = [i / 20 for i in range(21)] + [i / 20 for i in range(19, -1, -1)]
    return [[bar * share * on for on in pattern] for bar in largest_bars for pattern in order for share in ramp]


TABLE_4 = {
    "13(a)": triangles((0.9, 1.2, 1.5), ([0, 0, 1, 1, 0, 0], [0, 0, 0, 0, 1, 1], [1, 1, 0, 0, 0, 0])),
    "13(b)": triangles((0.6, 0.9, 1.2), ([1, 1, 1, 1, 0, 0], [0, 0, 1, 1, 1, 1], [1, 1, 0, 0, 1, 1])),
}


def table4(context):
    section = Section("table4", "Table 4: tip position errors of the models", text=(
        "Again errors against recordings that are not printed. Two models can lie no closer together than their "
        "largest errors against the same recording differ; so the largest distance between models over the triangles "
        "of Figure 13 (three amplitudes, pairs in turn) must reach the difference of the printed numbers."))
    printed = context.paper["table_4"]
    for panel, pressures in TABLE_4.items():
        tips = {model: numpy.array([row.position_cm() for row in context.programs.solve(pressures, model=model)])
                for model in MODELS}
        for model in ("NPCC", "LCM", "LPCC"):
            ours = numpy.abs(tips["NCM"] - tips[model]).max(axis=0)
            least = [abs(a - b) for a, b in zip(printed[panel]["NCM"][:3], printed[panel][model][:3])]
            holds = all(o >= 0.9 * l - 0.005 for o, l in zip(ours, least))
            section.statement("%s, largest distance NCM - %s in x, y, z" % (panel, model),
                              "at least " + ", ".join("%.2f" % l for l in least) + " cm",
                              ", ".join("%.2f" % o for o in ours) + " cm", holds, checked=model != "NPCC")
    section.bounds = (
        "With a tenth to spare, since the parameters are inferred and the printed numbers rounded. **Not reproduced** "
        "for NPCC: the printed errors put it further from NCM than its rows of Table 5 allow, as Table 3 puts it "
        "closer for two pairs.")
    return section
