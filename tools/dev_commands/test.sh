# What an ordinary change can break, in a few minutes; `tools/dev prove` runs the rest.

# test_hostile_bytes: the cases about hostile bytes and the corpora of the fuzz targets, under the address sanitizer
test_hostile_bytes() {
    local program=build/hostile/tests/espalier_tests_hostile log=build/hostile/hostile_tests.log cases status=0
    build build/hostile espalier_tests_hostile --preset hostile "${options[@]}" &&
        build build/hostile espalier_fuzz_targets --preset hostile "${options[@]}" || return 1
    run_tests build/hostile --tests-regex '^fuzz: '
    echo "running the cases about hostile bytes under the address sanitizer"
    cases=$("$program" --count | sed -nE 's/.*current filters: //p')
    "$program" --last="$((cases / 2))" >"$log" 2>&1 {lock}>&- &
    "$program" --first="$((cases / 2 + 1))" >"$log.second" 2>&1 || status=$?
    wait "$!" || status=$?
    [[ $status -eq 0 ]] || { tail -n 60 "$log" "$log.second" >&2; failed=$((failed + 1)); }
    grep -v 'test cases:' "$log.second" >>"$log"  # each half counts the cases of both
    count_cases "$log"
}

run_quick_tests() {
    local options=(-DESPALIER_WARNINGS_ARE_ERRORS=OFF)
    export WERROR=-Wno-error  # for the tests that run a compiler
    case ${1-} in
        --strict) options=(-DESPALIER_WARNINGS_ARE_ERRORS=ON) WERROR=-Werror ;;
        ?*) fail "test [--strict]: '$1' is no option" ;;
    esac
    one_at_a_time
    unset ESPALIER_SET  # these are the tests with every set
    compile_by_ccache
    # What only the tests use is installed while this machine compiles. Who must install by hand gets one list.
    [[ $(id -u) -eq 0 ]] ||
        install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}" $(formatter_packages)
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}"
    check_cmake
    late_test_packages+=($(formatter_packages))  # known from now on: what is installed has brought the lists
    install_missing "${late_test_packages[@]}" &
    local installation=$! is_built=yes
    build build/test all --preset test "${options[@]}" || is_built=no
    wait "$installation" || fail "packages are missing"
    # A compiler may have met a library that the installation was replacing. Where the build fails again, its error is the
    # last that is printed, not a list of tests that could not run.
    [[ $is_built == yes ]] || build build/test all --preset test "${options[@]}" || exit 1
    quick_cases quick run_tests build/test --label-exclude '^(prove_|bench$)'
    quick_cases quick test_hostile_bytes || failed=$((failed + 1))
    summarise
}

run_quick_tests "$@"
