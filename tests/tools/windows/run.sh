#!/usr/bin/env bash
# run.sh BUILD_FOLDER TEST ARGUMENT...: runs a test of the command with the one that build.sh built for Windows in BUILD_FOLDER,
# by Wine.
# Exit status: that of the test; 77 where there is no such build.
set -euo pipefail

build=$(realpath "$1") test=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [[ ! -e $build/espalier/tools/espalier.exe ]]; then
    echo "skipped: the command was not built for Windows; the test that builds it prints the reason"
    exit 77
fi
# A program of this system that is the command there.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf '#!/usr/bin/env bash\nexec bash %q %q %q "$@"\n' "$(realpath "$here/../../platform/other/run_wine.sh")" "$build/wine" \
    "$build/espalier/tools/espalier.exe" >"$folder/espalier"
chmod +x "$folder/espalier"
export ESPALIER_SYSTEM=windows
bash "$test" "$folder/espalier" "${@:3}"
