#!/usr/bin/env bash
# readme_code.sh BAKE RAY BLOB: bakes a square into BLOB by the README's function and compares what the README's program prints.
set -euo pipefail
"$1" "$3"
printed=$("$2" "$3")
[[ $printed == "t 10, mesh 0, triangle 1, u 0.3125, v 0.25" ]] || { echo "failed: the README's program printed: $printed"; exit 1; }
