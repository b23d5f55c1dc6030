#!/usr/bin/env python3
"""includes.py FOLDER: what the sources in FOLDER/include and FOLDER/src may include.

Folders are the stages that data passes through, and nothing includes to the right; what comes before ros includes
nothing of ROS; and a public header includes public ones only, since the private ones are not installed."""
import os
import re
import sys
import tempfile

ORDER = ["", "lie", "section", "rod", "compliance", "analysis", "estimation", "parallel", "calibration", "rig", "ros",
         "bags", "programs"]
# Headers of ROS packages, and the package's own generated messages (UpperCamel).
ROS = re.compile(r"(ros|rosbag|tf|topic_tools|diagnostic_updater|[a-z0-9_]+_msgs)/|tf2|live_stiffness/[A-Z]")


def faults_of(folder):
    """Lines PATH:LINE: FAULT, and the number of files read."""
    faults, count = [], 0
    for top in ("include/live_stiffness", "src"):
        for path, _, names in os.walk(os.path.join(folder, top)):
            for name in sorted(name for name in names if name.endswith((".h", ".cpp"))):
                count += 1
                file = os.path.join(path, name)
                stage = os.path.relpath(path, os.path.join(folder, top)).split(os.sep)[0].replace(".", "")
                for number, line in enumerate(open(file, encoding="utf-8"), 1):
                    found = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line)
                    fault = found and fault_in(folder, top, stage, found.group(1))
                    if fault:
                        faults.append("%s:%d: %s" % (os.path.relpath(file, folder), number, fault))
    return faults, count


def fault_in(folder, top, stage, included):
    """What is wrong with a file of a stage that includes this; None if nothing is."""
    if stage not in ORDER:
        return "folder %s is not in the order of stages: give it its place in test/includes.py" % stage
    if ROS.match(included):
        return None if ORDER.index(stage) >= ORDER.index("ros") else "%s must not know ROS" % (stage or "the top")
    public = included.startswith("live_stiffness/")
    if not public and not os.path.exists(os.path.join(folder, "src", included)):
        return None  # another package's
    if top != "src" and not public:
        return "public, but includes %s, which is private" % included
    parts = included.split("/")[1 if public else 0:]
    other = parts[0] if len(parts) > 1 else ""
    if other not in ORDER or ORDER.index(other) > ORDER.index(stage):
        return "%s includes %s, to its right" % (stage or "the top", included)
    return None


def check_itself():
    """It finds one fault of each kind in a small tree."""
    with tempfile.TemporaryDirectory() as folder:
        for path, text in {"include/live_stiffness/rod/a.h": '#include "rod/b.h"', "src/rod/b.h": "#include <cmath>",
                           "src/lie/c.cpp": '\n#include "rod/b.h"', "src/lie/d.cpp": "#include <ros/ros.h>",
                           "src/ros/e.cpp": '#include "rod/b.h"\n#include <ros/ros.h>\n#include "live_stiffness/rod/a.h"'
                           }.items():
            os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
            with open(os.path.join(folder, path), "w", encoding="utf-8") as file:
                file.write(text)
        places = sorted(fault.split(": ")[0] for fault in faults_of(folder)[0])
        assert places == ["include/live_stiffness/rod/a.h:1", "src/lie/c.cpp:2", "src/lie/d.cpp:1"], places


check_itself()
found_faults, files = faults_of(sys.argv[1])
print("\n".join(found_faults + ["%d files, %d faults" % (files, len(found_faults))]))
sys.exit(1 if found_faults or files < 100 else 0)
