#!/usr/bin/env bash
# links.sh PROJECT: every relative link in README.md, docs/ and docs/log/ leads to something that is there.
set -euo pipefail

cd "$1"
broken=0
for document in README.md docs/*.md docs/log/*.md; do
    folder=$(dirname "$document")
    while read -r target; do
        [[ $target == *://* || $target == \#* ]] && continue
        if [[ ! -e $folder/${target%%#*} ]]; then
            echo "$document links to $target, which is not there"
            broken=1
        fi
    done < <(sed '/^```/,/^```/d' "$document" | grep -oE '\]\([^)]+\)' | sed 's/^](//; s/)$//')
done
exit "$broken"
