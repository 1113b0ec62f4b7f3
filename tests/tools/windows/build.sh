#!/usr/bin/env bash
# build.sh BUILD_FOLDER CMAKE: builds the command for Windows in BUILD_FOLDER, where tests/platform/run_platform.sh built the
# libraries; without the parts whose libraries Debian does not have for Windows.
# Exit status: 77 where there are no such libraries.
set -euo pipefail

build=$1 cmake=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [[ ! -e $build/make_blobs.exe ]]; then
    echo "skipped: the libraries were not built for Windows; the test of that platform prints the reason"
    exit 77
fi
bash "$here/../../../lib/cmake/toolchains/header_libraries.sh" "$build/headers"
"$cmake" -DESPALIER_TOOLS=ON -DESPALIER_IMPORT=ON -DESPALIER_COMMAND_PARTS= -DCMAKE_FIND_ROOT_PATH="$build/headers" "$build" >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; exit 1; }
"$cmake" --build "$build" --target espalier_command --parallel 2 >"$build/build.log" 2>&1 || { tail -n 60 "$build/build.log"; exit 1; }
