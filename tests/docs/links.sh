#!/usr/bin/env bash
# links.sh PROJECT: every relative link of a Markdown file leads to something that is there.
set -euo pipefail

cd "$1"
broken=0
while read -r document; do
    folder=$(dirname "$document")
    while read -r target; do
        [[ $target == *://* || $target == \#* ]] && continue
        if [[ ! -e $folder/${target%%#*} ]]; then
            echo "$document links to $target, which is not there"
            broken=1
        fi
    done < <(sed '/^```/,/^```/d' "$document" | grep -oE '\]\([^)]+\)' | sed 's/^](//; s/)$//')
done < <(find . -name '*.md' -not -path './build*' -not -path '*/node_modules/*' | sort)
exit "$broken"
