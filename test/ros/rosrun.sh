#!/usr/bin/env bash
# rosrun finds the programs of a build in the source folder, as the README has it. rosrun.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
if [ "$(readlink -f "$source/devel")" != "$(readlink -f "$build/devel")" ]; then
  echo "skipped: this build was not made by scripts/build"
  exit 77
fi
set +u; source "$build/devel/setup.bash"; set -u
cd /
for program in stiffness_solve stiffness_map replay; do
  help=$(rosrun live_stiffness $program --help)  # whole, since a program whose reader leaves early has failed
  grep -q "^$program " <<<"$help"
done
