# The quick check: the runtime and the baker with their unit tests, at a twentieth of the random cases of tools/dev test, without meshes
# from files and without the slow tests that tests/scales.txt lists. And whether the runtime in one file compiles, in a few seconds.

single_file_compiles() {
    rm -rf build/check/single
    python3 tools/single_file.py build/check/single
    (cd build/check/single && g++ -std=c++20 -fsyntax-only -Wall -Wextra -Werror espalier.cpp)
}

check() {
    local left_out single_file
    install_missing "${build_packages[@]}" doctest-dev libeigen3-dev python3
    check_cmake
    build build/check espalier_unit_tests --preset check
    single_file_compiles &
    single_file=$!
    left_out=$(patterns_of check | cut -d ' ' -f 2- | sed 's/[.+^]/\\&/g; s/\*/.*/g' | paste -sd '|')
    ctest --preset check --exclude-regex "^($left_out)\$" --no-tests=error --parallel "$(nproc)" >build/check/tests.log 2>&1 ||
        { tail -n 60 build/check/tests.log >&2; fail "tests failed; all output is in build/check/tests.log"; }
    wait "$single_file" || fail "what tools/single_file.py makes of lib/runtime does not compile"
    grep ' tests passed' build/check/tests.log
}

without_arguments check "$@"
check
