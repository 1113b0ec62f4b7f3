# What the claims about the command share: sourced with the path of espalier as $1. Leaves the script in a new folder.
# shellcheck shell=bash
set -u
tests_folder=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
espalier=$(realpath "${1:?the path of espalier}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
claims=0
broken=0
claim=

# run EXIT_CODE ARGUMENTS...: runs the command; its output is left in ./out and ./err. With --json, the output is one
# document, which the schema of the verb describes, and which contains an error exactly if the verb fails; finish() tests that.
run() {
    local expected=$1
    shift
    "$espalier" "$@" >out 2>err
    local code=$?
    [ $code = "$expected" ] || fail "'espalier $*' ended with $code, not $expected: $(head -c 400 err)"
    case " $* " in *" --json "*) keep_document "$code" "$@" ;; esac
}
# Starting Python takes longer than all else that a run does, so one process judges all documents of a script.
keep_document() { # EXIT_CODE ARGUMENTS...
    local document
    IFS= read -r -d '' document <out
    printf '%s\0' "$1" "$2" "$claim: espalier ${*:2}" "$document" >>documents
}
judge_documents() {
    local wrong
    [ -e documents ] || return 0
    while IFS= read -r wrong; do
        broken=$((broken + 1))
        echo "BROKEN: $wrong"
    done < <(python3 "$tests_folder/schema.py" documents || echo "schema.py failed")
}
# Tests whether the command is that of Windows, which has none of the optional parts (windows/run.sh).
on_windows() { [ "${ESPALIER_SYSTEM-}" = windows ]; }
fail() {
    broken=$((broken + 1))
    echo "BROKEN: $claim: $1"
}
claim() {
    claim=$1
    claims=$((claims + 1))
}
# Of each of some words: the stream has them, or lacks them.
err_has() { local words; for words in "$@"; do grep -qF -- "$words" err || fail "stderr lacks '$words': $(head -c 400 err)"; done; }
err_lacks() { local words; for words in "$@"; do ! grep -qF -- "$words" err || fail "stderr has '$words': $(head -c 400 err)"; done; }
out_has() { local words; for words in "$@"; do grep -qF -- "$words" out || fail "stdout lacks '$words': $(head -c 600 out)"; done; }
absent() { local file; for file in "$@"; do [ ! -e "$file" ] || fail "$file is there"; done; }
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
# json FILTER: the JSON in ./out makes jq's FILTER true; nothing is looked at without jq.
json() {
    command -v jq >/dev/null || return 0
    jq -e "$1" out >/dev/null || fail "not $1: $(head -c 600 out)"
}
# Runs of which one thing is asked.
prints() { run 0 "${@:2}"; out_has "$1"; } # WORDS ARGUMENTS...: on the standard output
reports() { run 0 "${@:2}"; err_has "$1"; } # WORDS ARGUMENTS...: on stderr
refuses() { run "$1" "${@:3}"; err_has "$2"; } # EXIT_CODE WORDS ARGUMENTS...: the reason on stderr
finds() { run 0 "${@:2}" --json; json "$1"; } # FILTER ARGUMENTS...
fails() { run "$1" "${@:3}" --json; json "$2"; } # EXIT_CODE FILTER ARGUMENTS...
makes() { run 0 "${@:3}"; same "$1" "$2"; } # FILE SAME_FILE ARGUMENTS...
# run_each EXIT_CODE HEAD TAIL...: runs the command with the words of the head and of each tail.
run_each() {
    local tail
    # shellcheck disable=SC2086  # words
    for tail in "${@:3}"; do run "$1" $2 $tail; done
}
# The script's last command.
finish() {
    judge_documents
    ls -A . | grep -q '\.espl\.......$' && fail "a temporary was left behind"
    echo "$claims claims, $broken broken"
    [ $broken = 0 ]
}

# A square sheet of 2 * SIDE^2 triangles; its heights are an expression of awk in i and j.
write_sheet() { # SIDE HEIGHT
    awk -v n="$1" 'BEGIN {
        for (i = 0; i <= n; ++i) for (j = 0; j <= n; ++j) printf "v %g %g %g\n", i, '"$2"', j
        for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) { a = i * (n + 1) + j + 1
            printf "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1 } }'
}

# A closed box of 12 triangles from 0 0 0 to 1 2 3.
corners=("0 0 0" "1 0 0" "0 2 0" "1 2 0" "0 0 3" "1 0 3" "0 2 3" "1 2 3")
faces=("0 2 3" "0 3 1" "4 5 7" "4 7 6" "0 1 5" "0 5 4" "2 6 7" "2 7 3" "0 4 6" "0 6 2" "1 3 7" "1 7 5")
write_box_obj() { # FIRST_CORNER_OFFSET
    for corner in "${corners[@]}"; do
        echo "$corner" | awk -v by="$1" '{ printf "v %g %g %g\n", $1 + by, $2, $3 }'
    done
    for face in "${faces[@]}"; do
        echo "$face" | awk '{ printf "f %d %d %d\n", $1 + 1, $2 + 1, $3 + 1 }'
    done
}
