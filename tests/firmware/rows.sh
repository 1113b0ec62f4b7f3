#!/usr/bin/env bash
# What measure.sh found, its rows, in other forms:
#     rows.sh check ROWS     holds them to budgets.txt, of each mesh that was asked every line of it. Exit status: 0 within,
#                            1 something takes more, or was not measured
#     rows.sh budgets ROWS   a new budgets.txt, which allows a fiftieth more than what was found
#     rows.sh json ROWS      for bench/results a JSON object for each core and profile, and one for each mesh on it
#     rows.sh lines          prints budgets.txt, a line for each size
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rows=${2-}
compiler=$(arm-none-eabi-g++ -dumpfullversion)

# The queries that get a line of their own in budgets.txt on every mesh; all of them do on the torus and the M4F, a closed mesh
# that is always there, where no query is refused. Elsewhere the deepest stack of the others is held.
with_lines='open raycast occluded overlaps_sphere closest_point overlaps_box overlaps_box_in_steps first_hit_in_steps
    collides minimum_distance open_scene scene_raycast scene_occluded scene_overlaps_sphere scene_closest_point
    moving_step moving_step_repack refit'

# as_budgets [BUDGETS]: rows as lines of budgets.txt, the same as that file has; what was measured several times, code, is one.
as_budgets() {
    awk -v with_lines="$with_lines" -v budgets="${1-}" '
        BEGIN { split(with_lines, names, " "); for (i in names) named[names[i]] = 1 }
        function has_line() {
            if ($4 in named || ($1, $2, $3, $4) in own) return 1
            return budgets == "" && $1 == "m4f" && $2 == "fast" && $3 == "torus"
        }
        FILENAME == budgets { own[$1, $2, $3, $4] = 1; next }
        $3 == "code" || $3 == "blob" { if (!seen[$1, $2, $3, $4]++) print $1, $2, $3, $4, $5; next }
        has_line() { print $1, $2, $3, $4, $6, $7, $8, $9, $10; next }
        { key = $1 " " $2 " " $3 }
        !(key in most) { order[++count] = key }
        $10 > most[key] { most[key] = $10 }
        END { for (i = 1; i <= count; ++i) print order[i], "others", "-", "-", "-", "-", most[order[i]] }' "$@" "$rows"
}

print_budgets() {
    cat <<TEXT
# What a core may take at most, for answers to the queries of workload.hpp. A test holds every figure to its line here. They
# are counts, the same at every run, and a fiftieth more than what was found when this file was made by
#     tools/dev firmware --publish NAME FOLDER_OF_MESHES
# code: bytes in flash of open and the closest hit of a ray; of both for a scene; of open_unchecked and the first hit of a segment in whole
# lattice steps, without floats; of open and the five usual queries; of every query; of what moving_step_main.cpp and refit_mesh_main.cpp call.
# blob: its bytes. instructions are those of QEMU, no cycles; blob bytes count as often as they are read; others: the deepest
# stack of all queries without a line there. Counts belong to a compiler: with another one nothing is held to them.
# compiler $compiler
TEXT
    as_budgets | awk '
        BEGIN { row = "%-5s %-8s %-8s %-18s %12s %12s %11s %9s %6s\n"
            printf row, "#core", "profile", "mesh", "query", "instructions", "max", "blob bytes", "max", "stack" }
        # as text: large numbers lose their digits in some awks
        function more(value) { return value == "-" ? value : sprintf("%.0f", int(value * 1.02 + 0.999)) }
        NF == 5 || $4 == "others" {
            key = sprintf("%-5s %-8s %-8s", $1, $2, NF == 5 ? $3 : $4)
            if (!(key in sizes)) keys[++count] = key
            sizes[key] = sizes[key] " " (NF == 5 ? $4 : $3) "=" more($NF)
            next
        }
        { printf row, $1, $2, $3, $4, more($5), more($6), more($7), more($8), more($9) }
        END { for (i = 1; i <= count; ++i) print keys[i] sizes[keys[i]] }'
}

check() {
    if ! grep -qx "# compiler $compiler" "$here/budgets.txt"; then
        echo "not held: the budgets are of $(sed -n 's/^# \(compiler .*\)/\1/p' "$here/budgets.txt"), this is $compiler"
        return
    fi
    as_budgets "$here/budgets.txt" | awk '
        BEGIN {
            split("instructions on average,instructions at most,blob bytes on average,blob bytes at most,bytes of stack",
                what, ",")
        }
        # what a line is asked along with: the code of a core, or a mesh on it
        function whole() { return $1 " " $2 " " ($3 == "blob" ? $4 : $3) }
        FNR == NR {
            if ($1 ~ /^#/) next
            for (i = 5; i <= NF; ++i) budget[$1, $2, $3, $4, i] = $i
            line[++lines] = $1 " " $2 " " $3 " " $4
            whole_of[lines] = whole()
            next
        }
        {
            asked[whole()] = found[$1 " " $2 " " $3 " " $4] = 1
            for (i = 5; i <= NF; ++i) {
                if ($i == "-") continue
                if (!(($1, $2, $3, $4, i) in budget)) {
                    print "failed: no budget for " $1 " " $2 " " $3 " " $4
                    bad = 1
                    break
                }
                ++held
                if ($i > budget[$1, $2, $3, $4, i] + 0) {
                    print "failed: " $1 " " $2 " " $3 " " $4 " takes " $i " " (NF == 5 ? "bytes" : what[i - 4]) \
                        ", its budget is " budget[$1, $2, $3, $4, i]
                    bad = 1
                }
            }
        }
        END {
            for (i = 1; i <= lines; ++i) {
                if (!(whole_of[i] in asked) || line[i] in found) continue
                print "failed: " line[i] " was not measured"
                bad = 1
            }
            if (held == 0) bad = 1
            print held + 0 " figures held to budgets"
            exit bad
        }' <(budgets_as_rows) -
}

# The lines of budgets.txt, with each size of code and of blobs, and each stack of the others, in one of its own.
budgets_as_rows() {
    awk '$3 != "code" && $3 != "blob" && $3 != "others" { print; next }
        { for (i = 4; i <= NF; ++i) {
            split($i, size, "=")
            if ($3 == "others") print $1, $2, size[1], $3, "-", "-", "-", "-", size[2]
            else print $1, $2, $3, size[1], size[2]
        } }' "$here/budgets.txt"
}

print_json() {
    local qemu
    qemu=$(qemu-system-arm --version | sed -nE '1s/.*version ([0-9.]+).*/\1/p')
    awk -v tools="\"compiler\":\"$compiler\",\"qemu\":\"$qemu\"" '
        function add(row, field, value) {
            if (!(row in names)) rows[++count] = row
            if (!((row, field) in fields)) names[row] = names[row] " " field
            fields[row, field] = fields[row, field] (fields[row, field] == "" ? "" : ",") value
        }
        { of_core = "\"core\":\"" $1 "\",\"profile\":\"" $2 "\"" }
        $3 == "code" && seen[$1, $2, $4]++ { next }
        $3 == "code" { add(of_core, "code_bytes", "\"" $4 "\":" $5); next }
        $3 == "blob" { add(of_core, "blob_size", "\"" $4 "\":" $5); next }
        {
            add(of_core ",\"mesh\":\"" $3 "\"", "queries", sprintf( \
                "\"%s\":{\"calls\":%d,\"instructions\":%.0f,\"instructions_max\":%.0f,\"blob_bytes\":%.0f,\"blob_bytes_max\":%.0f," \
                "\"stack\":%d,\"writes_elsewhere\":%d}", $4, $5, $6, $7, $8, $9, $10, $11))
        }
        END {
            for (i = 1; i <= count; ++i) {
                printf "{%s", rows[i]
                of_row = split(names[rows[i]], name, " ")
                for (k = 1; k <= of_row; ++k) printf ",\"%s\":{%s}", name[k], fields[rows[i], name[k]]
                print "," tools "}"
            }
        }' "$rows"
}

case $1 in
    check) check ;;
    budgets) print_budgets ;;
    json) print_json ;;
    lines) budgets_as_rows ;;
    *) echo "rows.sh check|budgets|json ROWS, or rows.sh lines" >&2; exit 1 ;;
esac
