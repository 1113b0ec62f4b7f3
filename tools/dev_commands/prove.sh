# What tools/dev test leaves out, in parts of at most 20 minutes each. A part that passes leaves its line in docs/proven.md.

proven=docs/proven.md

# The parts, in the order in which `prove --all` runs them.
parts=(cases instruction_sets sanitizers small_code i686 armhf aarch64 riscv64 s390x compilers firmware wasm windows python packages
    release coverage lint aimed_rays extremes counts mutants fuzz bench)

# Those that take one core most of the time: two of them run at once.
emulated_parts=(i686 armhf aarch64 riscv64 s390x)

# part_sources PART: a pattern of the files whose change can break it
part_sources() {
    local build='CMakeLists.txt|CMakePresets.json|tools/dev$|tools/dev_commands/(shared/|prove.sh)|lib/(CMakeLists.txt|cmake)'
    local libraries="^($build|lib/(runtime|baker|espalier))" command='|^(tools/([^d]|demo/)|lib/import/)|^tests/import'
    local labels='|^tests/(CMakeLists.txt|discover_tests.cmake)'
    local tests="$labels|^tests/(main.cpp|scales.txt|support|oracle)|^docs/examples/game"
    local platform='|^tests/(platform|format_versions)'
    case $1 in
        cases | sanitizers) echo "$libraries$command|^tests/|^fuzz/|^docs/|^README.md" ;;
        instruction_sets) echo "$libraries$tests$platform|^tests/(runtime|baker|promises|c)" ;;
        small_code) echo "$libraries$tests$platform|^tests/(small_code|runtime)" ;;
        coverage) echo "$libraries$tests$platform|^tests/(runtime|baker|promises)|^tools/dev_commands/(coverage|branches)" ;;
        i686 | armhf | aarch64 | riscv64 | s390x | compilers) echo "$libraries$platform" ;;
        firmware) echo "$libraries$command$labels$platform|^tests/(firmware|promises|support)|^docs/(examples/firmware|embedding)|^tools/dev_commands/firmware" ;;
        wasm) echo "$libraries$platform|^lib/wasm|^tests/wasm|^bench/wasm|^docs/(wasm|format_cube)|^LICENSE|^tools/dev_commands/wasm" ;;
        windows) echo "$libraries$command$labels$platform|^tests/tools" ;;
        python) echo "$libraries$command|^lib/(python|shared)|^tests/(python|c)/|^docs/examples/python|^tools/dev_commands/python" ;;
        packages) echo "$libraries$command$labels|^lib/shared|^tests/(package|build_step|c)/|^docs/(examples|embedding)|^README.md" ;;
        release) echo "$libraries$command|^tests/platform/other|^(LICENSE|README.md|docs/(changelog.md|schema))|^tools/dev_commands/release" ;;
        lint) echo "$libraries$command$labels|^lib/|^tests/promises|^\\.(clang|cppcheck)|^tools/dev_commands/lint" ;;
        aimed_rays | extremes) echo "$libraries$tests|^tests/(runtime|baker|promises)|^tools/dev_commands/extremes" ;;
        counts) echo "$libraries$tests|^tests/(runtime|baker|promises)|^tools/dev_commands/counts" ;;
        mutants) echo "$libraries$tests$platform|^tests/(runtime|baker|promises|c|small_code|mutation)|^fuzz/|^tools/dev_commands/mutate" ;;
        fuzz) echo "$libraries$tests$command|^fuzz/|^tools/dev_commands/fuzz" ;;
        bench) echo "$libraries$tests$command|^bench/|^docs/examples/engines" ;;
    esac
}

# prove_labelled PART TARGET...: the targets that the part needs, in the build of `tools/dev test`, and the tests with its label. One that
# leaves itself out fails the part, which has installed what it needs.
prove_labelled() {
    local before=$skipped_tests
    build_test_targets "${@:2}"
    run_tests build/test --label-regex "^prove_$1\$"
    failed=$((failed + skipped_tests - before))
    summarise
}

# build_test_targets TARGET...: with none the build is configured, which names its tests
build_test_targets() {
    local target
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}"
    check_cmake
    cmake --fresh --preset test -DESPALIER_WARNINGS_ARE_ERRORS=OFF >/dev/null
    for target in "$@"; do build build/test "$target"; done
}

# Each include of each file, since nothing is precompiled and no two files are compiled as one; what is released; every random case.
prove_cases() {
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}"
    check_cmake
    build build/release all --fresh --preset release -DESPALIER_WARNINGS_ARE_ERRORS=ON
    run_tests build/release --label-regex '^(unit|promises|oracle|c)$'
    run_tests build/release --tests-regex '^(platform: (scalar|sse42|avx2|avx512) |fuzz: )'
    summarise
}

# The cases of tools/dev test with no more than each instruction set, and more of the golden answers of each.
prove_instruction_sets() { prove_sets scalar sse42 avx2 avx512; }
prove_scalar() { prove_sets scalar; }
prove_sse42() { prove_sets sse42; }
prove_avx2() { prove_sets avx2; }
prove_avx512() { prove_sets avx512; }

# prove_sets SET...: those that the processor has
prove_sets() {
    local set status here=$PWD/build/test/tests/platform
    build_test_targets all
    for set in "$@"; do
        status=0
        bash tests/platform/check_golden.sh tests/platform/golden.txt 2000 "$here/blobs" "$here/espalier_query_answers" --set "$set" ||
            status=$?
        [[ $status -ne 77 ]] || { echo "this processor has no $set"; continue; }
        [[ $status -eq 0 ]] || failed=$((failed + 1))
        ESPALIER_SET=$set quick_cases quick run_tests build/test --label-regex '^(unit|promises|oracle|c)$'
    done
    summarise
}

prove_sanitizers() {
    install_missing "${build_packages[@]}" "${test_packages[@]}" "${late_test_packages[@]}"
    check_cmake
    build build/sanitize all --fresh --preset sanitize
    run_tests build/sanitize --label-exclude '^(emulated|prove_)'
    prove_labelled sanitizers
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
    install_missing clang "${windows_packages[@]}"
    install_missing $(wasm_packages)  # Microsoft's mode of Clang compiles with their C++ library
    prove_labelled windows espalier_query_answers espalier_command
}

# prove_platform NAME...: the bits of tests/platform/golden.txt on other machines, or by other compilers and options
prove_platform() {
    local name
    install_missing "${build_packages[@]}"
    check_cmake
    for name in "$@"; do
        if bash tests/platform/run_platform.sh "$name" 2000 "$PWD/build/platforms/$name" cmake Ninja; then passed=$((passed + 1))
        else failed=$((failed + 1))
        fi
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

# Each of these ends with a line about the passed tests.
prove_wasm() {
    tools/dev wasm | tee build/prove/wasm.out
    awk '/^(#|ℹ) (pass|fail|skipped) / { count[$2] += $3 }
         END { print count["pass"] + 0 " passed, " count["fail"] + 0 " failed, " count["skipped"] + 0 " skipped" }' build/prove/wasm.out
}
prove_python() {
    tools/dev python | tee build/prove/python.out
    grep -oE '[0-9]+ passed(, [0-9]+ skipped)?' build/prove/python.out | tail -n 1
}
prove_release() {
    tools/dev release
    echo "packages for Debian and archives for Linux and Windows are made, checked and tried"
}
prove_coverage() {
    tools/dev coverage | tee build/prove/coverage.out
    echo "branches taken of the runtime and of open: $(sed -nE 's/^TOTAL .*, ([0-9.]+ %)$/\1/p' build/prove/coverage.out | paste -sd ,)"
}
prove_lint() {
    tools/dev lint
    prove_labelled lint
}
prove_aimed_rays() { tools/dev extremes aimed_rays; }
prove_extremes() { tools/dev extremes extremes; }
prove_counts() {
    tools/dev counts | tee build/prove/counts.out
    echo "$(($(grep -c '^| ' build/prove/counts.out) - 1)) queries and kinds of meshes, no difference"
}
# Few are drawn, so that a single one that only the whole kills weighs much.
prove_mutants() {
    local hash
    hash=$(git rev-parse HEAD | cut -c 1-6)
    MUTATION_WHOLE_SECONDS=60 tools/dev mutate --sample 24 --seed "$((0x$hash))" --least 0.9
}
prove_fuzz() {
    tools/dev fuzz 45 | tee build/prove/fuzz.out
    awk '/ executions in / { targets += 1; all += $2 } END { print targets " targets, " all " executions, no findings" }' build/prove/fuzz.out
}

# Every benchmark builds, and what can be tested of one in a moment is right.
prove_bench() {
    install_missing "${build_packages[@]}" libcli11-dev libembree-dev libbullet-dev libode-dev libfcl-dev libmeshoptimizer-dev zlib1g-dev \
        nlohmann-json3-dev doctest-dev libeigen3-dev libgmp-dev python3
    check_cmake
    build build/prove/bench espalier_benches --fresh -DCMAKE_BUILD_TYPE=Release -DESPALIER_BENCH=ON -DESPALIER_TOOLS=OFF -DESPALIER_UNITY=ON
    run_tests build/prove/bench --label-regex '^bench$'
    summarise
}

# run_part PART: runs it in a process of its own, which ends at the first error, shows the end of its output, and writes its line of
# docs/proven.md
run_part() {
    local part=$1 log=build/prove/$1.log start=$SECONDS status=0 commit
    mkdir -p build/prove
    commit=$(state_of_tree)
    echo "proving $part; all output is in $log"
    # No variable of the caller makes the tests fewer or compiles them by other options.
    (
        unset $(compgen -e | grep -E '^(ESPALIER|CMAKE|CTEST|MUTATION)_|^(CC|CXX|CPATH|LIBRARY_PATH)$|(FLAGS|INCLUDE_PATH|SAN_OPTIONS)$')
        export WERROR=-Wno-error
        exec tools/dev prove --run "$part" >"$log" 2>&1 {lock}>&-  # a server that stays must not keep the lock
    ) || status=$?
    local seconds=$((SECONDS - start)) result
    result=$(tail -n 1 "$log" | tr -d '|' | cut -c 1-100)
    if [[ $status -ne 0 ]]; then
        tail -n 60 "$log" >&2
        echo "tools/dev prove: $part failed after $seconds s; all output is in $log" >&2
        return 1
    fi
    echo "$part: $seconds s: $result"
    if [[ $commit == *+ || $commit != "$(state_of_tree)" ]]; then
        echo "not written to $proven, since the tree is not what its commit is"
    elif [[ $writes == yes ]]; then
        write_line "$part" "$commit" "$seconds" "$result" || { echo "the line of $part could not be written" >&2; return 1; }
    fi
    echo "$part" >>build/prove/passed
}

# run_parts PART...: and writes the names of those that pass into build/prove/passed
run_parts() {
    local part
    mkdir -p build/prove
    : >build/prove/passed
    for part in "$@"; do
        if [[ " ${emulated_parts[*]} " == *" $part "* ]]; then
            while [[ $(jobs -pr | wc -l) -ge 2 ]]; do wait -n; done
            run_part "$part" &
        else
            wait
            run_part "$part" || true
        fi
    done
    wait
}

# state_of_tree: the commit, and + where a file is another than there
state_of_tree() {
    local commit changed
    if commit=$(git rev-parse --short=12 HEAD) && changed=$(git status --porcelain --untracked-files=all -- . ":!$proven"); then
        echo "$commit${changed:++}"
    else echo "unknown+"
    fi
}

# write_line PART COMMIT SECONDS RESULT: replaces the part's line of docs/proven.md; in a shell of its own, whose end gives up the lock
write_line() (
    local processor sets known part line page
    processor=$(sed -nE '/^model name/ { s/.*: //p; q }' /proc/cpuinfo)
    sets=$(sets_here | paste -sd , | sed 's/,/, /g')
    line="| $1 | $(date -u +%F) | $2 | $(nproc) × $processor | ${sets:-none} | $3 | $4 |"
    exec {page}>build/prove/page.lock
    flock "$page"
    known=$(cat "$proven") || return 1
    {
        cat <<'TEXT'
# What was proven when

`tools/dev prove` writes this page: of each part the last run of a committed tree that passed.
[testing.md](testing.md#two-tiers) describes what the parts are.
Processor and instruction sets are those of the machine that ran the part; other processors were QEMU's on it.

| part | date | commit | processor | instruction sets | seconds | result |
|---|---|---|---|---|---|---|
TEXT
        for part in "${parts[@]}"; do
            if [[ $part == "$1" ]]; then echo "$line"
            else grep "^| $part |" <<<"$known" || echo "| $part | not yet | | | | | |"
            fi
        done
    } >build/prove/proven.new || return 1
    # A full disk shows here, too.
    [[ $(grep -cE '^\| [a-z0-9_]+ \|' build/prove/proven.new) -gt ${#parts[@]} ]] && mv build/prove/proven.new "$proven" || return 1
)

# drawn_part: small_code, or one set of instruction_sets that this processor has, by the hash of the commit: at most five minutes
# after tools/dev test
drawn_part() {
    local hash drawn=(small_code scalar)
    hash=$(git rev-parse HEAD | cut -c 1-8)
    drawn+=($(sets_here | tr -d '.-' | tr 'A-Z' 'a-z'))
    echo "${drawn[$((0x$hash % ${#drawn[@]}))]}"
}

# sets_here: the instruction sets of this processor, a name a line
sets_here() {
    local flags set
    flags=" $(sed -nE '/^flags/ { s/.*: //p; q }' /proc/cpuinfo) "
    for set in sse4_2:SSE4.2 avx2:AVX2 avx512_vbmi2:AVX-512; do
        [[ $flags != *" ${set%:*} "* ]] || echo "${set#*:}"
    done
}

# parts_since COMMIT: those whose sources differ from the commit's, one a line; files that git does not have yet differ too
parts_since() {
    local part changed
    git rev-parse --quiet --verify "$1^{commit}" >/dev/null || fail "prove --since: git finds no commit '$1'"
    changed=$(git diff --name-only --no-renames "$1" -- . ":!$proven" && git ls-files --others --exclude-standard)
    for part in "${parts[@]}"; do
        if grep -qE "$(part_sources "$part")" <<<"$changed"; then echo "$part"; fi
    done
}

prove() {
    local chosen=() part failures=() writes=yes since
    case ${1-} in
        --all) chosen=("${parts[@]}") ;;
        --since)
            [[ $# -eq 2 || ( $# -eq 3 && $3 == --list ) ]] || fail "prove --since COMMIT [--list]: one commit is needed"
            since=$(parts_since "$2")
            [[ $# -eq 2 ]] || { echo "$since"; return; }
            [[ -n $since ]] || { echo "nothing to prove: no part has a source that differs from $2"; return; }
            mapfile -t chosen <<<"$since"
            ;;
        --drawn)
            writes=no
            part=$(drawn_part)
            chosen=("$part")
            ;;
        --list) printf '%s\n' "${parts[@]}" && return ;;
        --run)  # PART, as run_part calls it
            compile_by_ccache
            "prove_$2"
            return
            ;;
        "" | -*) fail "prove PART... | --since COMMIT | --all | --drawn | --list: the parts are ${parts[*]}" ;;
        *)
            for part in "$@"; do
                [[ " ${parts[*]} " == *" $part "* ]] || fail "prove: there is no part '$part'; the parts are ${parts[*]}"
            done
            chosen=("$@")
            ;;
    esac
    one_at_a_time
    run_parts "${chosen[@]}"
    for part in "${chosen[@]}"; do
        grep -qx "$part" build/prove/passed || failures+=("$part")
    done
    [[ ${#failures[@]} -eq 0 ]] || fail "prove: these parts failed: ${failures[*]}"
    echo "${#chosen[@]} passed, 0 failed"
}

prove "$@"
