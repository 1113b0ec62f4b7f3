#!/usr/bin/env bash
# check_rows.sh FOLDER: whether `rows.sh check` notices what takes more than its budget and what was not measured at all.
# Exit status: 0 it does, 77 a tool is missing, other: it does not.
set -euo pipefail

rows=$1/rows.txt
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if ! command -v arm-none-eabi-g++ >/dev/null; then
    echo "skipped: arm-none-eabi-g++ is not installed (tools/dev prove firmware installs it)"
    exit 77
fi
mkdir -p "$1"

# Rows that take just what the budgets allow.
allowed() {
    awk '/^#/ { next } NF == 5 { print; next } { print $1, $2, $3, $4, 1, $5, $6, $7, $8, $9, 0 }' <(bash "$here/rows.sh" lines)
}

# expect STATUS WHAT: of the rows, which `rows.sh check` must answer with that
expect() {
    local status=0 said
    said=$(bash "$here/rows.sh" check "$rows") || status=$?
    if [[ $said == "not held"* ]]; then
        echo "skipped: $said"
        exit 77
    fi
    if [[ $status -ne $1 ]]; then
        echo "failed: rows.sh check answered $status to $2, not $1: $said"
        exit 1
    fi
}

allowed >"$rows"
expect 0 "what the budgets allow"
allowed | grep -v ' torus ' >"$rows"
expect 0 "what the budgets allow, a mesh left out"
for column in 6 7 8 9 10; do
    allowed | awk -v column="$column" '/^m4f fast bunny raycast / { ++$column } { print }' >"$rows"
    expect 1 "a ray of which column $column is one more"
done
allowed | awk '/^m4f fast bunny others / { ++$10 } { print }' >"$rows"
expect 1 "a deeper stack of the others"
{ allowed && echo m4f fast bunny contains 1 1 1 1 1 9999 0; } >"$rows"
expect 1 "a deep stack of a query without a line"
allowed | awk '$1 == "m0" && $4 == "in_steps" { ++$5 } { print }' >"$rows"
expect 1 "a byte more code"
allowed | grep -v '^m4f fast bunny raycast ' >"$rows"
expect 1 "a query that was not measured"
allowed | awk '!($1 == "m0" && $4 == "in_steps")' >"$rows"
expect 1 "an image that was not measured"
allowed | awk '!($3 == "blob" && $4 == "level")' >"$rows"
expect 1 "a blob that was not measured"
: >"$rows"
expect 1 "nothing at all"
