# How often each query is compared with the loop over all triangles.

# add_up_calls LOG: one row for each query and mesh, from the counts that the tests print (tests/support/testing.hpp)
add_up_calls() {
    echo "| query | mesh | random calls | adversarial calls |"
    echo "|---|---|---|---|"
    awk 'match($0, /calls of .* on .*: [0-9]+ random, [0-9]+ adversarial/) {
             query = text = substr($0, RSTART + 9, RLENGTH - 9)
             sub(/: [0-9]+ random, [0-9]+ adversarial$/, "", query)
             sub(/ on /, " | ", query)
             sub(/.*: /, "", text)
             split(text, words, " ")
             random[query] += words[1]
             adversarial[query] += words[3]
         }
         END { for (query in random) print "| " query " | " random[query] " | " adversarial[query] " |" }' "$1" | sort
}

counts() {
    local folder=${1-} log=$PWD/build/release/claims.log
    [[ -z $folder || -d $folder ]] || fail "there is no folder $folder"
    install_missing "${build_packages[@]}" "${tool_packages[@]}" doctest-dev libeigen3-dev libgmp-dev python3 >&2
    check_cmake
    build build/release espalier_tests --preset release >&2
    : >"$log"
    run_patterns counts none "$log"
    [[ -z $folder ]] || run_patterns counts_real "$folder" "$log"
    add_up_calls "$log"
    fail_at_failures "$log"
}

counts "$@"
