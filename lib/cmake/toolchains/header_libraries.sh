#!/usr/bin/env bash
# header_libraries.sh FOLDER: makes FOLDER/include and FOLDER/share of those libraries of this system that are headers alone and
# that the command needs, for a build for another system (CMAKE_FIND_ROOT_PATH). The other headers of this system stay out.
# Exit status: 77, with a reason, where one is missing.
set -euo pipefail

folder=$1
rm -rf "$folder"
mkdir -p "$folder/include"
folder=$(realpath "$folder")
for package in CLI11:CLI nlohmann_json:nlohmann; do
    config=$(cd /usr && find share/cmake lib/cmake -maxdepth 1 -name "${package%:*}" 2>/dev/null | head -n 1) || true
    if [[ -z $config || ! -d /usr/include/${package#*:} ]]; then
        echo "skipped: ${package%:*} is not installed (tools/dev prove installs it)"
        exit 77
    fi
    (cd /usr && cp -r --parents "$config" "$folder")
    ln -s "/usr/include/${package#*:}" "$folder/include"
done
