#!/usr/bin/env bash
# check_golden.sh GOLDEN QUESTIONS FOLDER QUERY_ANSWERS...: asks the blobs in FOLDER by a program (a command line that ends
# with query_answers or with its options) and compares its lines about all files of a kind with those of the file GOLDEN.
# Names of scenes begin so. Exit status: 0 the same bits, 77 the program cannot run on this machine, other: other bits or a failure.
set -euo pipefail

golden=$(realpath "$1") questions=$2 folder=$3
shift 3
cd "$folder"
export LC_ALL=C  # the order of the blobs
# answer NAME FILE...: a process of its own about some files, since an emulator takes minutes
answer() {
    [[ $# -gt 1 ]] || return 0
    "${program[@]}" "$questions" "${@:2}" >"$answers/$1"
}
program=("$@")
answers=$(mktemp -d)
trap 'rm -r "$answers"' EXIT
shopt -s nullglob extglob
status=0
answer scenes scene*.espl &
answer blobs !(scene*).espl || status=$?
wait $! || status=$?
case $status in
    0) ;;
    77) echo "skipped: this machine has no ${program[*]: -1}"; exit 77 ;;
    *) echo "failed: status $status of ${program[*]}"; exit "$status" ;;
esac
lines=$(cat "$answers"/* | tr -d '\r' | grep '^questions ')  # Windows ends lines with both
echo "$lines"
expected=$(grep "^questions $questions:" "$golden") || { echo "failed: $golden has no line for $questions questions"; exit 1; }
if [[ $(sort <<<"$lines") != "$(sort <<<"$expected")" ]]; then
    echo "failed: $golden has other bits, or more lines:"
    echo "$expected"
    exit 1
fi
