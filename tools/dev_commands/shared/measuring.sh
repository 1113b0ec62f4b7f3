# What is published: the meshes that are measured, and their rows.

# measured_meshes: those of ESPALIER_MESHES or ../shared/meshes, and the house of Debian's assimp-testmodels, one a line
measured_meshes() {
    local folder=${ESPALIER_MESHES:-../shared/meshes} house=build/meshes/house.obj
    [[ -d $folder ]] || fail "name meshes, or set ESPALIER_MESHES to a folder of .obj and .ply files"
    find "$folder" -maxdepth 1 -type f \( -name '*.obj' -o -name '*.ply' \) | LC_ALL=C sort
    install_missing assimp-utils assimp-testmodels >&2
    mkdir -p build/meshes
    [[ -f $house ]] || assimp export /usr/share/assimp/models/IFC/AC14-FZK-Haus.ifc "$house" >&2
    echo "$house"
}

# smaller_meshes MESH...: those of at most 10 MB, one a line
smaller_meshes() { find "$@" -maxdepth 0 -size -10M -printf '%p\n'; }

# publish_rows NAME FILE...: as bench/results/NAME.jsonl, in the place of older rows of its kind; NAME is a date, _ and the kind
publish_rows() {
    local name=$1 grouped=build/$1.grouped
    shift
    bench/group_rows.py "$@" >"$grouped"
    [[ -s $grouped ]] || fail "there are no rows for $name"
    rm -f bench/results/*_"${name#*_}.jsonl"
    mv "$grouped" "bench/results/$name.jsonl"
}
