# The quick check: the runtime and the baker with their unit tests, at a twentieth of the random cases of tools/dev test, without meshes
# from files and without the slow tests that tests/scales.txt lists. And whether the runtime in one file compiles, in a few seconds.

check_single_file() {
    local options
    rm -rf build/check/single
    python3 tools/single_file.py build/check/single
    for options in "" "-DESPALIER_SMALL_CODE=1 -fno-exceptions -fno-rtti"; do
        # shellcheck disable=SC2086  # options are words
        (cd build/check/single && g++ -std=c++20 -fsyntax-only -Wall -Wextra -Werror $options espalier.cpp) ||
            fail "what tools/single_file.py makes of lib/runtime does not compile"
    done
}

check() {
    local left_out
    install_missing "${build_packages[@]}" doctest-dev libeigen3-dev python3
    check_cmake
    build build/check espalier_unit_tests --preset check
    check_single_file
    left_out=$(patterns_of check | cut -d ' ' -f 2- | sed 's/[.+^]/\\&/g; s/\*/.*/g' | paste -sd '|')
    ctest --preset check --exclude-regex "^($left_out)\$" --no-tests=error --parallel "$(nproc)" >build/check/tests.log 2>&1 ||
        { tail -n 60 build/check/tests.log >&2; fail "tests failed; all output is in build/check/tests.log"; }
    grep ' tests passed' build/check/tests.log
}

without_arguments check "$@"
check
