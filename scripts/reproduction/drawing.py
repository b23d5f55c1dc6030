"""What several figures draw: backbones and ellipses in a plane of the robot."""
import numpy

from report_figures import plt, save  # the same style, and SVG that is the same for the same numbers  # noqa: F401

X_Z, Y_Z = (0, 2), (1, 2)
MODEL_STYLE = {"LPCC": ("#222222", ":"), "NPCC": ("#d62828", ":"), "LCM": ("#2a9134", "-"), "NCM": ("#c2188f", "-")}


def subplots(rows, columns, size, **options):
    return plt.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False, **options)


def shades(count, start="#9ecae1", end="#08306b"):
    """Colours from pale to dark, for growing pressure."""
    ends = [numpy.array([int(c[i:i + 2], 16) for i in (1, 3, 5)]) / 255 for c in (start, end)]
    return [tuple(ends[0] + (ends[1] - ends[0]) * i / max(count - 1, 1)) for i in range(count)]


def ellipse(ax, centre_cm, compliance_cm_per_n, scale_n, plane=X_Z, **style):
    """Shadow on a plane of the image of the unit ball: all displacements under forces of scale_n."""
    rows = scale_n * compliance_cm_per_n[list(plane)]
    size, axes = numpy.linalg.eigh(rows @ rows.T)
    angle = numpy.linspace(0, 2 * numpy.pi, 73)
    points = axes @ (numpy.sqrt(numpy.maximum(size, 0))[:, None] * numpy.array([numpy.cos(angle), numpy.sin(angle)]))
    a, b = plane
    style = {"facecolor": "#3a86ff40", "edgecolor": "#1d4e89", "linewidth": 0.8, **style}
    ax.fill(centre_cm[a] + points[0], centre_cm[b] + points[1], **style)


def plane_axes(ax, plane=X_Z, title=None):
    ax.set_aspect("equal")
    ax.set_xlabel("%s, cm" % "xyz"[plane[0]])
    ax.set_ylabel("%s, cm" % "xyz"[plane[1]])
    if title:
        ax.set_title(title, fontsize=10)


def common_scale(axes):
    """Makes all axes as wide and as high as the largest needs, about their own middle."""
    spans = [(ax.get_xlim(), ax.get_ylim()) for ax in axes]
    for which in (0, 1):
        half = max(span[which][1] - span[which][0] for span in spans) / 2
        for ax, span in zip(axes, spans):
            middle = sum(span[which]) / 2
            (ax.set_ylim if which else ax.set_xlim)(middle - half, middle + half)
