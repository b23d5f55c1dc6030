#!/usr/bin/env bash
# orthonormality_report as scripts/report runs it: columns, rows, exit status. PROGRAM
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; cat "$work"/*; exit 1; }

"$program" "$work" >/dev/null || fail "exit status"
table=$work/orthonormality.csv
[ "$(head -1 "$table")" = method,elements,fraction,error ] || fail header
awk -F, 'NR > 1 && !(NF == 4 && $2 >= 1 && $3 >= 0 && $3 <= 1 && $4 >= 0 && $4 < 1) {exit 1}' "$table" || fail values
for method in rk4_figure_17 rk4_ncm; do
  [ "$(grep -c "^$method,[0-9]*,1," "$table")" = 50 ] || fail "$method: a tip for 1 to 50 elements"
  [ "$(grep -c "^$method,50," "$table")" = 51 ] || fail "$method: all along for 50"
done
[ "$(grep -c '^live_stiffness,' "$table")" = 51 ] || fail "the library all along"

for arguments in "" "$work/missing" "$work $work"; do
  if "$program" $arguments >/dev/null 2>"$work/err"; then fail "accepts '$arguments'"; fi
  grep -q orthonormality_report "$work/err" || fail "no message for '$arguments'"
done
