#!/usr/bin/env python3
"""What README.md, CONTRIBUTING.md and docs/*.md tell people to do is possible: BUILD_DIR SOURCE_DIR.

Links lead somewhere; commands name programs, scripts, launch files, options and arguments that exist; scenes and
parameter files shown are accepted by the programs that would read them; the README's C++ is examples/solve.cpp.
"""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

BUILD, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
PROGRAMS = BUILD / "devel/lib/live_stiffness"
failures = []
helps = {}
counts = {"links": 0, "commands": 0, "files": 0}


def anchors(text):
    """As GitHub makes them from headings."""
    headings = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def check_links(page, text):
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"\w+:", target):
            continue
        counts["links"] += 1
        path, _, anchor = target.partition("#")
        file = (page.parent / path) if path else page
        if not file.exists():
            failures.append("%s: link to %s, which is not there" % (page.name, target))
        elif anchor and anchor not in anchors(file.read_text()):
            failures.append("%s: link to %s: no such heading" % (page.name, target))


def help_of(program):
    if program not in helps:
        shown = subprocess.run([str(PROGRAMS / program), "--help"], stdout=subprocess.PIPE, universal_newlines=True)
        helps[program] = shown.stdout
    return helps[program]


def check_program(where, program, words):
    if not (PROGRAMS / program).exists():
        failures.append("%s: program %s does not exist" % (where, program))
        return
    options = [word.split("=")[0] for word in words if re.match(r"--?[a-z]", word)]
    for option in options:
        if not re.search(r"(^|[\s\[])%s\b" % re.escape(option), help_of(program)):
            failures.append("%s: %s has no option %s" % (where, program, option))


def check_launch(where, words):
    file = SOURCE / "launch" / words[0]
    if not file.exists():
        failures.append("%s: launch file %s does not exist" % (where, words[0]))
        return
    known = {arg.get("name") for arg in ElementTree.parse(file).getroot().findall("arg") if arg.get("value") is None}
    for word in words[1:]:
        name, colon, _ = word.partition(":=")
        if colon and name not in known:
            failures.append("%s: %s has no argument %s" % (where, words[0], name))


def check_command(where, command):
    try:
        words = shlex.split(command, comments=True)
    except ValueError:
        return  # half of a command, in running text
    while words and (re.match(r"[A-Z_]+=", words[0]) or words[0] in ("nice", "sudo")):
        words = words[1:]
    if not words:
        return
    own = {path.name for path in PROGRAMS.iterdir()}
    if words[0] == "rosrun" and words[1:2] == ["live_stiffness"] and len(words) > 2 and re.match(r"[a-z_]+$", words[2]):
        check_program(where, words[2], words[3:])
    elif words[0] in own:
        check_program(where, words[0], words[1:])
    elif words[0] == "roslaunch" and words[1:2] == ["live_stiffness"] and words[2].endswith(".launch"):
        check_launch(where, words[2:])
    elif re.match(r"(\./)?scripts/", words[0]):
        if not (SOURCE / words[0]).exists():
            failures.append("%s: %s does not exist" % (where, words[0]))
    else:
        return
    counts["commands"] += 1


def check_commands(page, text):
    blocks = re.findall(r"^ *```bash\n(.*?)^ *```", text, re.M | re.S)
    inline = re.findall(r"`([^`\n]+)`", re.sub(r"^ *```.*?^ *```", "", text, flags=re.M | re.S))
    lines = [line for block in blocks for line in block.replace("\\\n", " ").splitlines()] + inline
    for line in lines:
        for command in re.split(r"\s[|&]+\s|\s[|&]+$|;", line):
            check_command(page.name, re.sub(r"[<>] ?\S+", "", command.strip().strip("|&")))


def check_yaml(page, text):
    for block in re.findall(r"^```yaml\n(.*?)^```", text, re.M | re.S):
        name = re.match(r"# (\w+)\.yaml", block)
        if not name:
            continue
        counts["files"] += 1
        if "chain:" in block:
            with tempfile.NamedTemporaryFile("w", suffix=".yaml") as scene:
                scene.write(block)
                scene.flush()
                table = "p_1_pa,p_2_pa,p_3_pa\n0,0,0\n40e3,0,0\n"
                solved = subprocess.run([str(PROGRAMS / "stiffness_solve"), scene.name], input=table,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
                rows = [line.split(",") for line in solved.stdout.splitlines()[1:]]
                # Chamber 1 lies at azimuth 0, so its pressure bends the tip towards -x, as the tutorial says.
                if [row[0] for row in rows] != ["ok", "ok"] or not float(rows[1][3]) < -1e-3:
                    failures.append("%s: %s.yaml: %s%s" % (page.name, name.group(1), solved.stdout, solved.stderr))
            if len(block.splitlines()) > 20:
                failures.append("%s: %s.yaml has more than twenty lines" % (page.name, name.group(1)))
        else:
            known = (SOURCE / "config/stiffness_node.yaml").read_text()
            for key in re.findall(r"^(\w+):", block, re.M):
                if not re.search(r"^%s:" % key, known, re.M):
                    failures.append("%s: %s.yaml: stiffness_node has no parameter %s" % (page.name, name.group(1), key))


def check_example():
    shown = re.search(r"^```cpp\n(.*?)^```", (SOURCE / "README.md").read_text(), re.M | re.S)
    if shown is None or shown.group(1) != (SOURCE / "examples/solve.cpp").read_text():
        failures.append("README.md: the C++ shown is not examples/solve.cpp")


def main():
    check_example()
    pages = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md"] + sorted((SOURCE / "docs").glob("*.md"))
    for page in pages:
        text = page.read_text()
        check_links(page, text)
        check_commands(page, text)
        check_yaml(page, text)
    for failure in failures:
        print(failure)
    print("%d pages, %d links, %d commands, %d files" % (len(pages), *counts.values()))
    if failures:
        sys.exit("%d failures" % len(failures))
    if min(counts.values()) == 0:
        sys.exit("nothing of a kind was found: the test has lost sight of it")


main()
