# Building, and what was built.

# build FOLDER TARGET CMAKE_OPTION...: quiet when all goes well, the end of the log when not
build() {
    local folder=$1 target=$2
    shift 2
    mkdir -p "$folder"
    echo "building $target in $folder"
    if ! { cmake -S . -B "$folder" -G Ninja "$@" && cmake --build "$folder" --target "$target"; } \
        >"$folder/build.log" 2>&1; then
        tail -n 60 "$folder/build.log" >&2
        echo "tools/dev: the build in $folder failed; all of it is in $folder/build.log" >&2
        return 1
    fi
}

# test_programs FOLDER: the programs of tests of a build, one a line
test_programs() { find "$1/tests" -maxdepth 1 -type f -executable -name 'espalier_tests_*' | sort; }
