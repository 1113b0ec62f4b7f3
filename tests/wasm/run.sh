#!/usr/bin/env bash
# run.sh SIMD128_BUILD SCALAR_BUILD ANSWERS FOLDER: makes the npm package in FOLDER/node_modules of the modules that
# tests/platform built for wasm32, and runs its tests; ANSWERS is the program of answers.
# Exit status 77: a module or a tool is missing.
set -euo pipefail
simd128=$1 scalar=$2 answers=$3 folder=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
modules=("$simd128/espalier/lib/wasm/espalier.wasm" "$scalar/espalier/lib/wasm/espalier_scalar.wasm")
if ! command -v node >/dev/null; then
    echo "skipped: node is not installed (tools/dev prove installs it)"
    exit 77
fi
for module in "${modules[@]}"; do
    if [[ ! -f $module ]]; then
        echo "skipped: $module was not built: a tool for wasm32 is missing (tools/dev prove installs it)"
        exit 77
    fi
done
mkdir -p "$folder/node_modules"
folder=$(cd "$folder" && pwd)
bash "$here/../../lib/wasm/make_package.sh" "${modules[@]}" "$folder/node_modules"
export ESPALIER_WASM_FOLDER=$folder ESPALIER_WASM_ANSWERS=$answers ESPALIER_WASM_PLATFORM=$simd128
cd "$folder"
exec node --no-warnings --test "$here"/*.test.mjs
