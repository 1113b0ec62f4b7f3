# clang-format 14 over every C and C++ file. Another major version formats some lines in another way.

# Prints the name of clang-format 14; fails where it is not installed.
find_clang_format() {
    local program
    for program in clang-format-14 clang-format; do
        if command -v "$program" >/dev/null && "$program" --version | grep -q 'version 14\.'; then
            echo "$program"
            return
        fi
    done
    return 1
}

format() {
    local program mode=(-i)
    [[ $# -le 1 ]] || fail "format [--check]: '$2' is no option"
    case ${1-} in
        --check) mode=(--dry-run --Werror) ;;
        ?*) fail "format [--check]: '$1' is no option" ;;
    esac
    if ! find_clang_format >/dev/null; then
        if [[ ${1-} == --check ]]; then
            echo "skipped: clang-format 14 is not installed (tools/dev format installs it)"
            return 77
        fi
        install_missing clang-format-14
    fi
    program=$(find_clang_format) || fail "clang-format 14 is not among the packages"
    source_files | xargs -0 -P "$(nproc)" -n 50 "$program" "${mode[@]}" ||
        fail "these files are not formatted; 'tools/dev format' formats them"
}

# Prints the C and C++ files of the project, each followed by a zero byte.
source_files() {
    find bench docs fuzz lib tests tools -type f \
        \( -name '*.c' -o -name '*.cpp' -o -name '*.h' -o -name '*.hpp' -o -name '*.inl' \) -print0
}

format "$@"
