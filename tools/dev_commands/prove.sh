# What tools/dev test leaves out, in parts of at most 20 minutes each. A part that passes leaves its line in docs/proven.md.

proven=docs/proven.md

# The parts, in the order in which `prove --all` runs them.
parts=(cases instruction_sets sanitizers small_code i686 armhf aarch64 riscv64 s390x compilers firmware wasm windows python packages
    release coverage lint extremes counts mutants fuzz bench)

# part_sources PART: a pattern of the files whose change can break it
part_sources() {
    local libraries='^(CMakeLists.txt|lib/(CMakeLists.txt|runtime|baker|espalier|cmake))' tests='|^tests/(support|oracle|main.cpp)'
    case $1 in
        cases | sanitizers) echo "$libraries|^tests/|^fuzz/" ;;
        instruction_sets) echo "$libraries$tests|^tests/(runtime|baker|promises|oracle|c|platform)" ;;
        small_code | coverage) echo "$libraries$tests|^tests/(small_code|runtime)" ;;
        i686 | armhf | aarch64 | riscv64 | s390x | compilers) echo "$libraries|^tests/(platform|format_versions)" ;;
        firmware) echo "$libraries|^tests/(firmware|platform)|^docs/examples/firmware" ;;
        wasm) echo "$libraries|^lib/wasm|^tests/(wasm|platform)" ;;
        windows) echo "$libraries|^tools/|^tests/(tools|platform)" ;;
        python) echo "$libraries|^lib/(python|shared)|^tests/(python|c/shared|c/declarations)|^docs/examples/python" ;;
        packages) echo "$libraries|^lib/shared|^tools/|^tests/(package|build_step|c/shared)|^docs/examples" ;;
        release) echo "^(CMakeLists.txt|LICENSE|lib/cmake)|^tools/" ;;
        lint) echo "^lib/|^tools/" ;;
        extremes | counts) echo "$libraries$tests|^tests/runtime" ;;
        mutants) echo "$libraries$tests|^tests/(runtime|baker|mutation)" ;;
        fuzz) echo "$libraries|^fuzz/|^tests/support|^tools/import" ;;
        bench) echo "$libraries|^bench/|^tests/support" ;;
    esac
}

# The build of `tools/dev test`, or the targets of it that a part needs, and the tests with the part's label.
prove_labelled() { # PART TARGET...
    build_test_targets "${@:2}"
    run_tests build/test --label-regex "^prove_$1\$"
    summarise
}

build_test_targets() {
    local target
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}"
    check_cmake
    for target in "$@"; do build build/test "$target" --preset test; done
}

# Each include of each file, since nothing is precompiled and no two files are compiled as one; what is released; every random case.
prove_cases() {
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}"
    check_cmake
    build build/release all --preset release -DESPALIER_WARNINGS_ARE_ERRORS=ON
    run_tests build/release --label-regex '^(unit|promises|oracle|c)$'
    run_tests build/release --tests-regex '^(platform: (scalar|sse42|avx2|avx512) |fuzz: )'
    summarise
}

# Every case with no more than each instruction set, and more of the answers of each than tools/dev test compares.
prove_instruction_sets() {
    local set status here=$PWD/build/test/tests/platform
    build_test_targets all
    for set in scalar sse42 avx2 avx512; do
        status=0
        bash tests/platform/check_golden.sh tests/platform/golden.txt 2000 "$here/blobs" "$here/espalier_query_answers" --set "$set" ||
            status=$?
        [[ $status -ne 77 ]] || continue
        [[ $status -eq 0 ]] || failed=$((failed + 1))
        ESPALIER_TEST_SET=$set quick_cases quick run_tests build/test --label-regex '^(unit|promises|oracle|c)$'
    done
    summarise
}

prove_sanitizers() {
    install_missing "${build_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}"
    check_cmake
    build build/sanitize all --preset sanitize
    run_tests build/sanitize --label-exclude '^emulated$'
    build_test_targets
    cmake --preset test >/dev/null
    run_tests build/test --label-regex '^prove_sanitizers$'
    summarise
}

prove_small_code() { prove_labelled small_code espalier_query_answers espalier_platform_blobs; }
prove_firmware() {
    install_missing "${firmware_packages[@]}"
    prove_labelled firmware espalier_firmware espalier_command
}
prove_packages() {
    install_missing "${package_test_packages[@]}"
    prove_labelled packages all
}
prove_windows() {
    install_missing "${windows_packages[@]}"
    prove_labelled windows espalier_query_answers espalier_command
}

# prove_platform NAME...: the bits of tests/platform/golden.txt on other machines, or by other compilers and options
prove_platform() {
    local name status
    install_missing "${build_packages[@]}"
    check_cmake
    for name in "$@"; do
        status=0
        bash tests/platform/run_platform.sh "$name" 2000 "$PWD/build/platforms/$name" cmake Ninja || status=$?
        case $status in
            0) passed=$((passed + 1)) ;;
            77) skipped=$((skipped + 1)) ;;
            *) failed=$((failed + 1)) ;;
        esac
    done
    summarise
}
prove_i686() { install_missing qemu-user g++-i686-linux-gnu && prove_platform i686; }
prove_armhf() { install_missing qemu-user g++-arm-linux-gnueabihf && prove_platform armhf; }
prove_aarch64() { install_missing qemu-user g++-aarch64-linux-gnu && prove_platform aarch64; }
prove_riscv64() { install_missing qemu-user g++-riscv64-linux-gnu && prove_platform riscv64; }
prove_s390x() { install_missing qemu-user g++-s390x-linux-gnu && prove_platform s390x; }
prove_compilers() {
    install_missing clang
    prove_platform {gcc,clang}-{O0,O1,O2,O3,O3-native}
}

prove_mutants() { tools/dev mutate --sample 100; }
prove_fuzz() { tools/dev fuzz 45; }

# Every benchmark builds, and what can be tested of one in a moment is right.
prove_bench() {
    install_missing "${build_packages[@]}" libcli11-dev libembree-dev libbullet-dev libode-dev libfcl-dev libmeshoptimizer-dev zlib1g-dev \
        doctest-dev libeigen3-dev libgmp-dev python3
    check_cmake
    build build/bench espalier_benches -DCMAKE_BUILD_TYPE=Release -DESPALIER_TOOLS=OFF -DESPALIER_UNITY=ON
    run_tests build/bench --label-regex '^bench$'
    summarise
}

# run_part PART: runs it, shows the end of its output, and writes its line of docs/proven.md
run_part() {
    local part=$1 log=build/prove/$1.log start=$SECONDS status=0
    mkdir -p build/prove
    echo "proving $part; all output is in $log"
    (
        export WERROR=-Wno-error
        compile_by_ccache
        if declare -F "prove_$part" >/dev/null; then "prove_$part"; else tools/dev "$part"; fi  # a part of the same name
    ) >"$log" 2>&1 || status=$?
    local seconds=$((SECONDS - start)) result
    result=$(tail -n 1 "$log" | tr -d '|' | cut -c 1-100)
    if [[ $status -ne 0 ]]; then
        tail -n 60 "$log" >&2
        echo "tools/dev prove: $part failed after $seconds s; all output is in $log" >&2
        return 1
    fi
    echo "$part: $seconds s: $result"
    write_line "$part" "$seconds" "$result"
}

# write_line PART SECONDS RESULT: replaces the part's line of docs/proven.md
write_line() {
    local commit processor flags set sets="" lines part line
    commit=$(git rev-parse --short=12 HEAD)
    git diff --quiet HEAD -- . ":!$proven" || commit+=+changes
    processor=$(sed -nE '/^model name/ { s/.*: //p; q }' /proc/cpuinfo)
    flags=" $(sed -nE '/^flags/ { s/.*: //p; q }' /proc/cpuinfo) "
    for set in sse4_2:SSE4.2 avx2:AVX2 avx512_vbmi2:AVX-512; do
        [[ $flags != *" ${set%:*} "* ]] || sets+=${sets:+, }${set#*:}
    done
    line="| $1 | $commit | $(nproc) × $processor | ${sets:-none} | $2 | $3 |"
    lines=$(grep -E '^\| [a-z0-9_]+ \| ' "$proven" 2>/dev/null | grep -v "^| $1 |" | grep -v '^| part ' || true)
    {
        cat <<'TEXT'
# What was proven when

`tools/dev prove` writes this page: of each part the last run that passed.
[testing.md](testing.md#two-tiers) describes what the parts are.

| part | commit | processor | instruction sets | seconds | result |
|---|---|---|---|---|---|
TEXT
        for part in "${parts[@]}"; do
            if [[ $part == "$1" ]]; then echo "$line"; else grep "^| $part |" <<<"$lines" || true; fi
        done
    } >"$proven.new"
    mv "$proven.new" "$proven"
}

# drawn_part: one part, by the hash of the commit, of those whose last run took at most 12 minutes
drawn_part() {
    local known
    mapfile -t known < <(awk -F ' *[|] *' '$6 ~ /^[0-9]+$/ && $6 <= 720 { print $2 }' "$proven")
    [[ ${#known[@]} -gt 0 ]] || fail "prove --drawn: $proven lists no part of at most 12 minutes"
    echo "${known[$((0x$(git rev-parse HEAD | cut -c 1-8) % ${#known[@]}))]}"
}

# parts_since COMMIT: those whose sources differ from the commit's, one a line
parts_since() {
    local part changed
    git rev-parse --quiet --verify "$1^{commit}" >/dev/null || fail "prove --since: git finds no commit '$1'"
    changed=$(git diff --name-only "$1")
    for part in "${parts[@]}"; do
        if grep -qE "$(part_sources "$part")" <<<"$changed"; then echo "$part"; fi
    done
}

prove() {
    local chosen=() part failures=()
    case ${1-} in
        --all) chosen=("${parts[@]}") ;;
        --since)
            [[ $# -eq 2 ]] || fail "prove --since COMMIT: one commit is needed"
            mapfile -t chosen < <(parts_since "$2")
            ;;
        --drawn) chosen=("$(drawn_part)") ;;
        --list) printf '%s\n' "${parts[@]}" && return ;;
        "" | -*) fail "prove PART... | --since COMMIT | --all | --drawn | --list: the parts are ${parts[*]}" ;;
        *) chosen=("$@") ;;
    esac
    for part in "${chosen[@]}"; do
        [[ " ${parts[*]} " == *" $part "* ]] || fail "prove: there is no part '$part'; the parts are ${parts[*]}"
    done
    for part in "${chosen[@]}"; do run_part "$part" || failures+=("$part"); done
    [[ ${#failures[@]} -eq 0 ]] || fail "prove: these parts failed: ${failures[*]}"
    echo "${#chosen[@]} passed, 0 failed"
}

prove "$@"
