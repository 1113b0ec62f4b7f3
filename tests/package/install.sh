#!/usr/bin/env bash
# install.sh BUILD STAGE CMAKE: installs what BUILD has built, moves it to STAGE/installed, the runtime alone to STAGE/runtime alone,
# and bakes STAGE/table.espl with the command that was moved. The consumers (consume.sh) share them.
set -euo pipefail

build=$1 stage=$2 cmake=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rm -rf "$stage"
mkdir -p "$stage"
"$cmake" --install "$build" --prefix "$stage/first place" >"$stage/install.log"
"$cmake" --install "$build" --prefix "$stage/first runtime" --component runtime >>"$stage/install.log"
mv "$stage/first place" "$stage/installed"
mv "$stage/first runtime" "$stage/runtime alone"

# Neither where it was built nor where it was installed first may matter.
if strangers=$(grep -rlF -e "$build" -e "first place" -e "$(cd "$here/../.." && pwd)" "$stage/installed/lib"*/{cmake,pkgconfig}); then
    echo "failed: these files name folders of the machine that built them: $strangers"
    exit 1
fi
"$stage/installed/bin/espalier" bake "$here/program/table.obj" -o "$stage/table.espl" --tolerance 0.001 --quiet
echo "installed, moved, baked $(stat -c %s "$stage/table.espl") bytes"
