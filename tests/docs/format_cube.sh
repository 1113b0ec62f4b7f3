#!/usr/bin/env bash
# format_cube.sh ESPALIER DOCUMENT FOLDER: bakes the document's mesh and compares the dump with the document's, line by line.
set -euo pipefail

espalier=$1 document=$2 folder=$3
block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$document" | sed '1d;$d'; }

mkdir -p "$folder"
cd "$folder"
block obj >cube.obj
block dump >documented.txt
block strips >documented_strips.txt
for file in cube.obj documented.txt documented_strips.txt; do
    [[ -s $file ]] || { echo "failed: $document has no obj block, no dump block or no strips block"; exit 1; }
done
"$espalier" bake cube.obj -o cube.espl --bits 8 --ids --profile fast -q
"$espalier" dump cube.espl >dumped.txt
"$espalier" bake cube.obj -o strips.espl --bits 8 --ids --profile balanced -q
"$espalier" dump strips.espl | sed -n '/^-- nodes/,$p' >dumped_strips.txt
for kind in "" _strips; do
    diff "documented$kind.txt" "dumped$kind.txt" ||
        { echo "failed: $document shows other bytes (<) than the command makes (>)"; exit 1; }
done
