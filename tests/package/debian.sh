#!/usr/bin/env bash
# debian.sh BUILD STAGE FOLDER CMAKE CPACK GENERATOR COMPILER: makes the Debian packages of BUILD, installs them and has a consumer
# find them. As root dpkg installs, with this machine's list of packages, so that dependencies must be met, but into a folder: the
# machine stays as it is. Otherwise the packages are only unpacked.
# Exit status: 0 good, 77 a tool is missing, other: a failure.
set -euo pipefail

build=$1 stage=$2 folder=$3 cmake=$4 cpack=$5 generator=$6 compiler=$7
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for tool in dpkg-shlibdeps gzip file; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool"; exit 77; }
done
fail() { echo "failed: $*"; exit 1; }

rm -rf "$folder"
root=$folder/root
mkdir -p "$root"
"$cpack" -G DEB -B "$folder/packages" --config "$build/CPackConfig.cmake" >"$folder/cpack.log" 2>&1 ||
    { cat "$folder/cpack.log"; fail "no packages"; }
development=$(echo "$folder"/packages/libespalier-dev_*.deb)
command=$(echo "$folder"/packages/espalier_*.deb)

importers=$(echo "$folder"/packages/libespalier-import-dev_*.deb)
for library in libespalier-dev libassimp-dev libdraco-dev libexpat1-dev libmeshoptimizer-dev zlib1g-dev; do
    [[ $(dpkg-deb -f "$importers" Depends) == *$library* ]] || fail "the importers do not depend on $library"
done
[[ -z $(dpkg-deb -f "$development" Depends) ]] || fail "the libraries depend on $(dpkg-deb -f "$development" Depends)"
for library in libassimp libdraco libexpat libmeshoptimizer libpng zlib libstdc++ libc6; do
    [[ $(dpkg-deb -f "$command" Depends) == *$library* ]] || fail "the command does not depend on $library"
done

if [[ $(id -u) -eq 0 ]]; then
    how="dpkg installs them"
    cp -a /var/lib/dpkg "$folder/database"
    dpkg --admindir="$folder/database" --instdir="$root" --no-triggers --force-unsafe-io -i "$development" "$importers" "$command" >"$folder/dpkg.log" 2>&1 ||
        { cat "$folder/dpkg.log"; fail "dpkg does not install them"; }
    [[ $(dpkg-query --admindir="$folder/database" -W -f '${Status}' espalier) == "install ok installed" ]] || fail "not installed"
    rm -rf "$folder/database"
else
    how="unpacked, since only root may install"
    for package in "$development" "$importers" "$command"; do dpkg-deb -x "$package" "$root"; done
fi
"$root/usr/bin/espalier" bake "$here/program/table.obj" -o "$folder/table.espl" --tolerance 0.001 --quiet
cmp "$folder/table.espl" "$stage/table.espl"
ln -s root/usr "$folder/installed"
"$here/consume.sh" find_package "$folder" "$folder/consumer" "$cmake" "$generator" "$compiler"
echo "$(basename "$development"), $(basename "$importers") and $(basename "$command"): $how"
