"""Reading the CSV files of speed_report and chain_report, finding rows in them, and printing numbers and tables."""
import csv
import os


def read(folder, name, delimiter=","):
    """Rows of folder/name.csv as dictionaries, numbers as floats; empty when there is no such file."""
    def value(text):
        try:
            return float(text)
        except (TypeError, ValueError):
            return text
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file, delimiter=delimiter)]


# --- Rows of methods.csv ----------------------------------------------------------------------------------------------
def panel(rows, segments=1, gravity=1, start="warm"):
    """What converged on one scene."""
    return [row for row in rows if (row["segments"], row["gravity"], row["start"]) == (segments, gravity, start) and
            row["converged"] == 1]


def method(rows, family, variant=None, **where):
    """The one row of a method in a panel, or None."""
    for row in panel(rows, **where):
        if row["family"] == family and variant in (None, row["variant"]):
            return row
    return None


def library(rows, accuracy, family="library", **where):
    return method(rows, family, "accuracy %g" % accuracy, **where)


def largest_error(row):
    return max(row["pose_max"], row["tangent_max"], row["material_max"])


def pareto(rows):
    """Rows that no other beats in both time and error, fastest first."""
    front, best = [], float("inf")
    for row in sorted(rows, key=lambda row: (row["median_us"], largest_error(row))):
        if largest_error(row) < best:
            front.append(row)
            best = largest_error(row)
    return front


# --- Rows of chains.csv -----------------------------------------------------------------------------------------------
def chain_methods(chains):
    return list(dict.fromkeys(row["method"] for row in chains))


# --- Printing ---------------------------------------------------------------------------------------------------------
def us(x):
    return "%.2f" % x if x < 10 else "%.1f" % x if x < 100 else "%.0f" % x


def small(x):
    return "%.1e" % x if x > 0 else "0"


def number(x, form="%.1e"):
    """Cells that may be empty or words stay as they are."""
    return form % x if isinstance(x, float) else x


def named(row):
    return "%s, %s" % (row["family"], row["variant"])


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])
