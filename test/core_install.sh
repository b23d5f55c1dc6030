#!/usr/bin/env bash
# Installs a build without ROS to a temporary prefix, and builds and runs examples/ against it. BUILD_DIR
set -euo pipefail
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$1" --prefix "$prefix" >"$1/core_install.log"
"$(dirname "$0")/installed_example.sh" "$prefix"
