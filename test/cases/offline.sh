#!/usr/bin/env bash
# The inputs of make_cases.py through the programs that need no master, each with what is right. BUILD_DIR SOURCE_DIR [WORD]
set -euo pipefail
build=$1 source=$2 programs=$1/devel/lib/live_stiffness
set +u; source "$build/devel/setup.bash"; set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$source/test/cases/simulate.sh" "$programs" "$source" "$work/sim.bag"
mkdir "$work/cases"
/usr/bin/python3 "$source/test/cases/make_cases.py" "$work/cases" "$work/sim.bag"
/usr/bin/python3 "$source/test/cases/offline_cases.py" "$programs" "$work/cases" "${3:-}"
