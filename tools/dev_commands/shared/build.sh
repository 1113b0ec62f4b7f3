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

# Where the programs are that measure, and what they wrote.
bench_folder=build/bench

# build_bench TARGET CMAKE_OPTION...: a program that measures; all are in one build, whose libraries are compiled once
build_bench() {
    check_cmake
    build "$bench_folder" "$1" -DCMAKE_BUILD_TYPE=Release -DESPALIER_BENCH=ON -DESPALIER_TESTS=OFF -DESPALIER_TOOLS=OFF "${@:2}" >&2
}

# build_firmware FOLDER: the programs of tests/firmware that run on this machine, and the blobs of the images
build_firmware() {
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}" "${firmware_packages[@]}" >&2
    check_cmake
    build "$1" espalier_firmware -DCMAKE_BUILD_TYPE=Release -DESPALIER_TOOLS=OFF -DESPALIER_BENCH=OFF >&2
}

# test_programs FOLDER: the programs of tests of a build, one a line
test_programs() { find "$1/tests" -maxdepth 1 -type f -executable -name 'espalier_tests_*' | sort; }
