#!/usr/bin/env bash
# catkin_prepare_release, on which bloom builds, takes the package as it is: version, changelog, tag. SOURCE_DIR
set -euo pipefail
command -v catkin_prepare_release >/dev/null || { echo "no catkin_prepare_release"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/package"
cp "$1/package.xml" "$1/CHANGELOG.rst" "$1/CMakeLists.txt" "$1/LICENSE" "$work/package"
cd "$work/package"
export HOME=$work   # no settings of the user's
git config --global user.name release
git config --global user.email release@localhost
git config --global init.defaultBranch main
git init --quiet --bare ../remote.git
git init --quiet
git add .
git commit --quiet -m "As it is"
git remote add origin ../remote.git
git push --quiet -u origin main
catkin_prepare_release --no-push --bump minor -y 2>&1 | tee ../log
version=$(sed -n 's|.*<version>\(.*\)</version>.*|\1|p' package.xml)
[ "$(git describe --tags)" = "$version" ] || { echo "no tag $version"; exit 1; }
grep -q "^$version (20" CHANGELOG.rst || { echo "the changelog's 'Forthcoming' did not become $version"; exit 1; }
if grep -iq warning ../log; then exit 1; fi
