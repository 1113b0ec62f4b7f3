#!/usr/bin/env bash
# readme_commands.sh ESPALIER DEMO_MESH README FOLDER: runs the README's commands on the demo's mesh, and compares the source
# triangle that its ray hits. The baked triangle and the last digits change with the baker.
set -euo pipefail

espalier=$1 demo_mesh=$2 readme=$3 folder=$4
fail() {
    echo "failed: $*"
    exit 1
}
# block KIND PATTERN: the block of that kind which has a line with the pattern
block() {
    awk -v kind="\`\`\`$1" -v pattern="$2" '
        inside && $0 == "```" { if (text ~ pattern) printf "%s", text; inside = 0 }
        inside { text = text $0 "\n" }
        $0 == kind { inside = 1; text = "" }' "$readme"
}

rm -rf "$folder"
mkdir -p "$folder/build/demo/cmake/tools"
cd "$folder"
ln -s "$espalier" build/demo/cmake/tools/espalier
"$demo_mesh" build/demo/knot.obj
commands=$(block sh "espalier bake")
documented=$(block text "hit triangle" | grep -oE 'file [0-9]+, mesh [0-9]+, triangle [0-9]+') || true
[[ -n $commands && -n $documented ]] || fail "$readme has no commands, or does not show what they print"
printed=$(bash -euo pipefail -c "$commands" 2>stderr.txt) || fail "a command of $readme: $(cat stderr.txt)"
[[ $printed == *"$documented"* ]] || fail "$readme shows: $documented"$'\n'"The commands print: $printed"
[[ -s build/knot.espl && -s build/knot.png ]] || fail "the commands of $readme made no blob or no picture"
