#!/usr/bin/env bash
# scripts/reproduce as a user runs it, quickly: pages, pictures, exit status; and that a number of the paper which does
# not fit makes it fail. PROGRAM_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
/usr/bin/python3 -c 'import matplotlib, yaml' || { echo "skipped: python3-matplotlib or python3-yaml is missing"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; cat "$work/out" "$work/err"; exit 1; }
reproduce() { status=0; "$source/scripts/reproduce" --programs "$build" "$@" >"$work/out" 2>"$work/err" || status=$?; }

reproduce --quick --output "$work/all"
[ $status = 0 ] || fail "exit status $status: a comparison with the paper left its bound"
page=$work/all/reproduction.md
for n in 6 7 8 9 10 12 17 18; do grep -q "^## Figure $n:" "$page" || fail "no figure $n"; done
for n in 3 4 5 6 7; do grep -q "^## Table $n:" "$page" || fail "no table $n"; done
pictures=$(grep -o 'figures/[a-z0-9_]*\.svg' "$page")
[ "$(wc -l <<<"$pictures")" = 9 ] || fail "nine pictures"
for picture in $pictures; do grep -q '</svg>' "$work/all/$picture" || fail "$picture"; done
grep -qi '\bnan\b' "$page" && fail "NaN in the page"

# The same picture again, byte by byte.
reproduce --only "Fig. 8" table5 --output "$work/some"
[ $status = 0 ] || fail "exit status $status of --only"
[ "$(grep -c '^## ' "$work/some/reproduction.md")" = 2 ] && grep -q '^## Table 5' "$work/out" || fail "--only"
cmp "$work/all/figures/figure8.svg" "$work/some/figures/figure8.svg" || fail "pictures differ from run to run"

# Another number in the paper: it must be noticed.
mkdir "$work/copy" "$work/copy/test"
cp -r "$source/scripts" "$source/config" "$work/copy"
cp -r "$source/test/data" "$work/copy/test"
sed -i 's/NCM: {c: \[9.34,/NCM: {c: [9.84,/' "$work/copy/test/data/paper_tables.yaml"
source=$work/copy
reproduce --only table5 --output "$work/wrong"
[ $status = 1 ] && grep -q "OUTSIDE ITS BOUND: table5: 0.9 111111, NCM" "$work/err" || fail "a wrong number is not noticed"
[ "$(grep -c OUTSIDE "$work/err")" = 1 ] && grep -q exceeded "$work/wrong/reproduction.md" || fail "only that one"

reproduce --only figure11
[ $status = 2 ] && grep -q "figure11: must be one of figure6" "$work/err" || fail "an unknown figure"
reproduce --help
[ $status = 0 ] && grep -q table7 "$work/out" || fail help
build=$work
reproduce --only table5 --output "$work/none"
[ $status = 2 ] && grep -q "stiffness_solve is not built" "$work/err" || fail "no programs"
echo ok
