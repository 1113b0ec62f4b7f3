#!/usr/bin/env bash
# check_meter.sh BLOB BUILD_FOLDER CMAKE GENERATOR: whether the plugin counts what an image of known cost takes.
# Exit status: 0 it does, 77 a tool is missing, other: it does not.
set -euo pipefail

blob=$1 build=$2
export CMAKE=$3 GENERATOR=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/meter.sh"

TARGETS=calibrate bash "$here/build_images.sh" m4f fast "$blob" "$build"
build_meter "$build"
run_metered mps2-an386 "$build/calibrate.elf" "$build/query_meter.so" >"$build/said.txt"
cat "$build/said.txt"
awk '
    function expect(what, is, should) {
        if (is == should) return
        print "failed: " what " is " is " and should be " should
        bad = 1
    }
    # measured KIND calls C instructions MEAN MAX blob MEAN MAX stack MAX elsewhere WRITES
    $1 == "measured" {
        calls[$2] = $4; mean[$2] = $6; most[$2] = $7; bytes[$2] = $10; stack[$2] = $12; writes[$2] = $14
    }
    END {
        expect("the number of calls", calls[1], 2)
        expect("what 1000 turns more take", most[1] - most[0], 4000)
        expect("the mean of one turn and 1001", mean[1], mean[0] + 2000)
        expect("writes elsewhere", writes[2], 1)
        expect("writes elsewhere of what writes to the stack", writes[3], 0)
        expect("the stack of 100 words", stack[3], 400)
        expect("bytes read of the blob", bytes[4], 3)
        expect("bytes read of the blob by a word and a half", bytes[5], 6)
        expect("the stack of five registers pushed", stack[6], 20)
        expect("the stack of 100 words of which one is read", stack[7], 400)
        expect("bytes read of what reads none", bytes[0], 0)
        exit bad
    }' "$build/said.txt"
