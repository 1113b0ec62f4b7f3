# Two commits beside each other: the runtime and the baker of each become a shared object, bench/ab measures both in turns.
ab() {
    local other="" base name program=build/ab/program/bench/ab/espalier_bench_ab
    if [[ ${1-} == --against ]]; then
        other=${2-}
        [[ -n $other ]] || fail "ab --against COMMIT: the commit is missing"
        shift 2
    fi
    [[ ${1-} == --help || $# -ge 2 ]] || fail "ab [--against COMMIT] COMMIT MESH...: a commit and a mesh are needed; a mesh is a file, or torus, terrain, level, small_mesh or tiny_mesh"
    base=$1
    shift
    install_missing "${build_packages[@]}" libcli11-dev git python3 >&2
    [[ $base == --help ]] || base=$(commit_of "$base")
    [[ -z $other ]] || other=$(commit_of "$other")
    check_cmake
    build build/ab/program espalier_bench_ab -DCMAKE_BUILD_TYPE=Release -DESPALIER_BENCH=ON -DESPALIER_TESTS=OFF -DESPALIER_TOOLS=OFF \
        -DESPALIER_BENCH_PEERS=OFF >&2
    if [[ $base == --help ]]; then
        "$program" --help
        return
    fi
    build_side "build/ab/$base" "$(commit_sources "$base")"
    if [[ -n $other ]]; then
        name=$other
        build_side "build/ab/$other" "$(commit_sources "$other")"
    else
        other=tree
        name="working tree ($(git describe --always --dirty))"
        build_side build/ab/tree "$PWD"
    fi
    # A ratio is the other's time by the base's: below 1 the other is faster.
    "$program" --base "build/ab/$base/libespalier_side.so" --base-name "$base" \
        --other "build/ab/$other/libespalier_side.so" --other-name "$name" "$@" | tee build/ab/rows.jsonl |
        bench/rows.py base base_compiler other other_compiler processor mesh triangles profile instruction_set \
            {base,other}_bytes_per_triangle same_bytes -- \
            questions base_ns ratio ratio_low ratio_high queries found differing other_median_ns other_percentile_99_ns
}

# commit_of NAME: the first 12 digits of its hash
commit_of() { git rev-parse --quiet --verify --short=12 "$1^{commit}" || fail "ab: git finds no commit '$1'"; }

# commit_sources COMMIT: the folder of its library
commit_sources() {
    local folder=$PWD/build/ab/$1/sources
    if [[ ! -d $folder ]]; then
        mkdir -p "$folder.new"
        git archive "$1" CMakeLists.txt lib | tar -x -C "$folder.new"
        mv "$folder.new" "$folder"
    fi
    echo "$folder"
}

# build_side FOLDER SOURCES: FOLDER/libespalier_side.so, by the adapter of the working tree
build_side() {
    echo "building the library of $2 in $1" >&2
    mkdir -p "$1"
    { cmake -S bench/ab/side -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DESPALIER_COMMIT="$2" && cmake --build "$1"; } \
        >"$1/build.log" 2>&1 || { tail -n 60 "$1/build.log" >&2; fail "the build in $1 failed; all of it is in $1/build.log"; }
}

ab "$@"
