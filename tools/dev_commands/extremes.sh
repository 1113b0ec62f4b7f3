# Extreme sizes, places and forms, by the hundred million.
extremes() {
    local log=$PWD/build/release/extremes.log
    install_missing "${build_packages[@]}" "${tool_packages[@]}" doctest-dev libeigen3-dev libgmp-dev python3 >&2
    check_cmake
    build build/release espalier_tests --preset release >&2
    : >"$log"
    run_patterns extremes none "$log"
    sed -nE 's/.*MESSAGE: ((aimed rays|extreme rays|decisions of).*)/\1/p' "$log"
    awk '/decisions of / { sub(/.*: MESSAGE: decisions of [^:]*: /, ""); all += $1 } END { print "decisions in all: " all }' "$log"
    fail_at_failures "$log"
}

without_arguments extremes "$@"
extremes
