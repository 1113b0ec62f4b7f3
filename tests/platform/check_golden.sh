#!/usr/bin/env bash
# check_golden.sh QUESTIONS FOLDER QUERY_ANSWERS...: asks the blobs in FOLDER by a program (a command line that ends with
# query_answers) and compares what it says about everything with golden.txt. Prints the line; exit status 0 if equal.
set -euo pipefail

questions=$1 folder=$2
shift 2
golden=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/golden.txt
cd "$folder"
export LC_ALL=C  # the order of the blobs
mkdir -p ../answers
result=../answers/$(basename "$folder").$questions.$$.txt
trap 'rm -f "$result"' EXIT
status=0
"$@" "$questions" *.espl >"$result" || status=$?
[[ $status -ne 77 ]] || { echo "skipped: this machine has no ${*: -1}"; exit 77; }
if [[ $status -ne 0 ]]; then
    echo "failed: status $status of $*"
    exit "$status"
fi
line=$(tail -n 1 "$result")
echo "$line"
if ! grep -qxF "$line" "$golden"; then
    echo "failed: golden.txt has other bits: $(grep "^questions $questions:" "$golden" || echo "no line for $questions questions")"
    exit 1
fi
