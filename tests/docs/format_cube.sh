#!/usr/bin/env bash
# format_cube.sh ESPALIER DOCUMENT FOLDER: bakes the document's mesh and compares the dump with the document's, line by line.
set -euo pipefail

espalier=$1 document=$2 folder=$3
block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$document" | sed '1d;$d'; }

mkdir -p "$folder"
cd "$folder"
block obj >cube.obj
block dump >documented.txt
[[ -s cube.obj && -s documented.txt ]] || { echo "failed: $document has no obj block or no dump block"; exit 1; }
"$espalier" bake cube.obj -o cube.espl --bits 8 --ids -q
"$espalier" dump cube.espl >dumped.txt
diff documented.txt dumped.txt || { echo "failed: $document shows other bytes (<) than the command makes (>)"; exit 1; }
