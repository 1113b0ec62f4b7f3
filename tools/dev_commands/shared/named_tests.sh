# Running the tests that tests/scales.txt lists.

# patterns_of COMMAND: the factor and the pattern of each of its lines
patterns_of() { sed -nE "s/^$1 ([0-9.]+ .*)/\1/p" tests/scales.txt; }

# run_patterns COMMAND FOLDER LOG: runs the tests of the command on the meshes of the folder, and adds to the log
run_patterns() {
    local folder=$2 log=$3 factor pattern program output found
    while read -r factor pattern; do
        echo "running: $pattern" >&2
        found=no
        for program in $(test_programs build/counts); do
            output=$(ESPALIER_MESHES=$folder ESPALIER_TEST_SCALE=$factor "$program" -tc="$pattern" 2>&1) ||
                output+=$'\n'"FAILED: $pattern"
            grep -qE "test cases: +0 " <<<"$output" && continue
            found=yes
            echo "$output" >>"$log"
        done
        [[ $found == yes ]] || echo "FAILED: no test matches $pattern" >>"$log"
    done < <(patterns_of "$1")
}

# fail_at_failures LOG
fail_at_failures() { ! grep -E "ERROR|FAILED" "$1" >&2 || fail "these tests failed; their output is in $1"; }
