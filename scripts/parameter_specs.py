"""The parameters of the nodes, read from the headers that define them: see include/live_stiffness/parameters.h."""
import math
import pathlib
import re
from types import SimpleNamespace

TOP = pathlib.Path(__file__).resolve().parent.parent
FILES = {"stiffness_node": "include/live_stiffness/parameters.h", "parallel_node": "src/parallel/parameters.h",
         "parallel_rig": "src/parallel/parameters.h", "rig_simulator": "src/rig/parameters.h"}
FIELDS = {  # as in live_stiffness/checks.h; the last ones may be missing
    "Number": ("key", "standard", "range", "meaning", "live", "unit"),
    "Boolean": ("key", "standard", "meaning", "live"),
    "Choice": ("key", "standard", "choices", "meaning", "live"),
    "Text": ("key", "standard", "meaning"),
    "Frame": ("key", "standard", "meaning"),
    "File": ("key", "standard", "meaning"),
    "Numbers": ("key", "standard", "range", "meaning"),
    "Texts": ("key", "meaning"),
}
DEFINITION = re.compile(r"^inline const(?:expr)? (\w+)Parameter (k\w+)(?:\{(.*?)\}| = (k\w+));$", re.M | re.S)


class Range:
    def __init__(self, low, high, low_open=False, high_open=False):
        self.low, self.high, self.low_open, self.high_open = low, high, low_open, high_open

    @staticmethod
    def finite():
        return Range(-math.inf, math.inf, True, True)

    @staticmethod
    def positive():
        return Range(0.0, math.inf, True, True)

    @staticmethod
    def nonnegative():
        return Range(0.0, math.inf, False, True)

    def text(self):
        if math.isinf(self.low):
            return "" if math.isinf(self.high) else "%s %g" % ("<" if self.high_open else "<=", self.high)
        if math.isinf(self.high):
            return "%s %g" % (">" if self.low_open else ">=", self.low)
        return "%g to %g" % (self.low, self.high)


def constants():
    """Names that definitions use."""
    names = {"Range": Range, "false": False, "true": True, "Live": SimpleNamespace()}
    for header in ("conventions.h", "parameters.h"):
        text = (TOP / "include/live_stiffness" / header).read_text()
        for name, value in re.findall(r"^(?:inline )?constexpr (?:double|int) (k\w+) = ([\w./ ]+);", text, re.M):
            names[name] = eval(value, names)
    levels = re.search(r"enum Level : unsigned \{(.*?)\}", (TOP / "include/live_stiffness/checks.h").read_text())
    for level, value in re.findall(r"(\w+) = (\d+)", levels.group(1)):
        setattr(names["Live"], level, int(value))
    return names


def parameter(kind, text, names):
    """Of the text between the outer braces."""
    values = eval("[%s]" % text.replace("{", "[").replace("}", "]").replace("::", "."), names)
    found = SimpleNamespace(kind=kind, live=0, choices=[], range=Range.finite(), standard=[])
    for field, value in zip(FIELDS[kind], values):
        setattr(found, field, Range(*value) if field == "range" and isinstance(value, list) else value)
    return found


def sections(node):
    """[title, comment, [parameters]] of a node, in the order of its header; the scene's file, which has no section, is not
    among them. A line `// === NODE ===` begins the parameters of a second node in the same file."""
    names = constants()
    found = []
    for path in dict.fromkeys(["include/live_stiffness/parameters.h", FILES[node]]):
        found, owner = [], next(name for name in FILES if FILES[name] == path)
        text = re.sub(r"\A.*?^namespace live_stiffness \{$", "", (TOP / path).read_text(), flags=re.M | re.S)
        for block in re.split(r"\n(?=// |inline )", text):
            definition, heading = DEFINITION.search(block), re.match(r"// (---|===) (.*?) \1", block)
            if definition:
                kind, name, body, other = definition.groups()
                names[name] = names[other] if other else parameter(kind, body, names)
                if found and owner == node:
                    found[-1][2].append(names[name])
            elif heading and heading.group(1) == "===":
                owner = heading.group(2)
            elif heading and owner == node:
                found.append([heading.group(2), "", []])
            elif block.startswith("//") and found and not found[-1][2]:
                found[-1][1] = (found[-1][1] + " " + block[3:].strip()).strip()
    return found


def parameters(node):
    return [one for section in sections(node) for one in section[2]]
