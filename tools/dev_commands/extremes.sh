# Extreme sizes, places and forms, by the hundred million.

# extremes [LIST]: the tests of a list of tests/scales.txt, or of both
extremes() {
    local list log=$PWD/build/release/extremes.log
    [[ $# -gt 0 ]] || set -- aimed_rays extremes
    for list in "$@"; do
        [[ $list =~ ^(aimed_rays|extremes)$ ]] || fail "extremes [aimed_rays | extremes]: there is no list '$list'"
    done
    install_missing "${build_packages[@]}" "${tool_packages[@]}" doctest-dev libeigen3-dev libgmp-dev python3 >&2
    check_cmake
    build build/release espalier_tests --preset release >&2
    : >"$log"
    for list in "$@"; do run_patterns "$list" none "$log"; done
    sed -nE 's/.*MESSAGE: ((aimed rays|extreme rays|decisions of).*)/\1/p' "$log"
    awk '/decisions of / { sub(/.*: MESSAGE: decisions of [^:]*: /, ""); all += $1 } END { if (all) print "decisions in all: " all }' "$log"
    fail_at_failures "$log"
}

extremes "$@"
