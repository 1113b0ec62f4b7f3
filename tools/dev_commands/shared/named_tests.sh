# Running the tests that tests/scales.txt lists.

# patterns_of COMMAND: the factor and the pattern of each of its lines
patterns_of() { sed -nE "s/^$1 ([0-9.]+ .*)/\1/p" tests/scales.txt; }

# run_patterns COMMAND FOLDER LOG: runs the tests of the command on the meshes of the folder, one on each core, and adds to the log
run_patterns() {
    local folder=$2 log=$3 factor pattern parts number=100
    parts=$(mktemp -d)
    while read -r factor pattern; do
        echo "running: $pattern" >&2
        number=$((number + 1))
        run_pattern "$folder" "$factor" "$pattern" >"$parts/$number" &
        while [[ $(jobs -rp | wc -l) -ge $(nproc) ]]; do wait -n; done
    done < <(patterns_of "$1")
    wait
    cat "$parts"/* >>"$log"
    rm -r "$parts"
}

# run_pattern FOLDER FACTOR PATTERN: prints what its tests print, and a line that begins with FAILED if one does or there is none
run_pattern() {
    local program output found=no
    for program in $(test_programs build/release); do
        output=$(ESPALIER_MESHES=$1 ESPALIER_TEST_SCALE=$2 "$program" -tc="$3" 2>&1) || output+=$'\n'"FAILED: $3"
        grep -qE "test cases: +0 " <<<"$output" && continue
        found=yes
        echo "$output"
    done
    [[ $found == yes ]] || echo "FAILED: no test matches $3"
}

# fail_at_failures LOG
fail_at_failures() { ! grep -E "ERROR|FAILED" "$1" >&2 || fail "these tests failed; their output is in $1"; }
