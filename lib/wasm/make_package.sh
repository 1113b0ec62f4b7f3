#!/usr/bin/env bash
# make_package.sh SIMD128_MODULE SCALAR_MODULE FOLDER: makes the npm package in FOLDER/espalier, and of it
# FOLDER/espalier-VERSION.tgz, as `npm pack` does. Equal modules give equal bytes.
set -euo pipefail
simd128=$(realpath "$1") scalar=$(realpath "$2") folder=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
version=$(sed -nE 's/^project\(espalier VERSION ([0-9.]+) .*/\1/p' "$here/../../CMakeLists.txt")
[[ -n $version ]] || { echo "make_package.sh: CMakeLists.txt has no version" >&2; exit 1; }

package=$folder/espalier
rm -rf "$package"
mkdir -p "$package"
cp -r "$here"/package/. "$here/../../LICENSE" "$package"
rm "$package/package.json.in"
sed "s/@VERSION@/$version/" "$here/package/package.json.in" >"$package/package.json"
cp "$simd128" "$package/espalier.wasm"
cp "$scalar" "$package/espalier_scalar.wasm"
find "$package" -type f -exec chmod 644 {} +
# npm's tarballs have one folder, package, and this time, so that equal files give equal bytes.
(cd "$folder" && find espalier -type f -print0 | LC_ALL=C sort -z | tar --create --null --files-from=- --owner=0 --group=0 \
    --numeric-owner --mtime='1985-10-26 08:15:00Z' --format=ustar --transform 's,^espalier,package,') | gzip --no-name --best >"$folder/espalier-$version.tgz"
