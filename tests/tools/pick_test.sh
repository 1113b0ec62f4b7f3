#!/usr/bin/env bash
# Tests of the picking options of `espalier bake`, and of the price of bytes.
# Usage: pick_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

# ---- picks ----------------------------------------------------------------------------------------------------------
claim "a pick keeps to its bytes, and says what it took and what it gave up"
for bytes in 1K 4K 10K 0.02M 65536; do
    reports "picked: profile " bake sheet.obj -o picked.espl --max-bytes $bytes --max-dropped 100%
    err_has "  error: " "  bytes: " "  counted work: "
    allowed=$(echo $bytes | awk '/K/ { print $0 * 1024; next } /M/ { print int($0 * 1048576); next } { print $0 }')
    [ "$(stat -c %s picked.espl)" -le "$allowed" ] || fail "$(stat -c %s picked.espl) bytes in $bytes"
    "$espalier" verify picked.espl --deep --source sheet.obj >/dev/null || fail "the pick is not sound"
done
reports "16 bits" bake sheet.obj -o picked.espl --max-bytes 1M
err_has "nothing given up"
reports "given up: " bake sheet.obj -o picked.espl --max-bytes 7K
err_has "at 16 bits"

claim "the same is picked twice and at any number of threads"
for pick in "--max-bytes 10K" "--fastest-under 30K" "--max-error 5mm" "--max-error 5mm --max-bytes 22K"; do
    # shellcheck disable=SC2086
    run 0 bake sheet.obj -o a.espl $pick --threads 1
    cp err first_err
    # shellcheck disable=SC2086
    makes a.espl b.espl bake sheet.obj -o b.espl $pick --threads 2
    grep -v wrote first_err >first
    grep -v wrote err >second
    same first second
done

claim "the fastest under a limit works no harder than any other blobs under it, on the lattice that was asked for"
run 0 bake sheet.obj -o fast.espl --fastest-under 1M --json -q
if command -v jq >/dev/null; then
    jq -e '.bits == 16 and (.picked.tried | length) > 8 and
        (.picked.chosen.counted_cost == ([.picked.tried[].counted_cost] | min))' out >/dev/null || fail "$(jq -c .picked.chosen out)"
    size=$(jq '[.picked.tried[].bytes] | add / length | floor' out)
    run 0 bake sheet.obj -o fast.espl --fastest-under "$size" --json -q
    jq -e "(.bytes <= $size) and
        (.picked.chosen.counted_cost == ([.picked.tried[] | select(.bytes <= $size) | .counted_cost] | min))" out \
        >/dev/null || fail "$(jq -c .picked.chosen out)"
fi

claim "the lattice is kept when anything on it fits, be it the very last byte"
if command -v jq >/dev/null; then
    # Triangles apart from each other: builders fill leaves differently.
    awk 'BEGIN { n = 600; s = 1
        for (i = 0; i < 3 * n; ++i) {
            for (k = 0; k < 3; ++k) { s = s * 16807 % 2147483647; p[k] = s / 2147483647; if (i % 3 == 0) at[k] = 10 * p[k] }
            printf "v %g %g %g\n", at[0] + p[0], at[1] + p[1], at[2] + p[2] }
        for (i = 0; i < n; ++i) printf "f %d %d %d\n", 3 * i + 1, 3 * i + 2, 3 * i + 3 }' >soup.obj
    for bits in 10 11 12 13 14 15 16; do # until the first bake is not the smallest
        run 0 bake soup.obj -o x.espl --fastest-under 1G --bits $bits --profile fast --json -q
        size=$(jq '[.picked.tried[].bytes] | min' out)
        ! jq -e "$size < .picked.tried[0].bytes" out >/dev/null || break
    done
    jq -e "$size < .picked.tried[0].bytes" out >/dev/null || fail "the first bake is the smallest: nothing is tested"
    run 0 bake soup.obj -o x.espl --max-bytes "$size" --bits $bits --profile fast --json -q
    jq -e ".bits == $bits and .bytes == $size" out >/dev/null || fail "$(jq -c .picked.chosen out) in $size bytes"
fi

claim "an error that is allowed is kept, on the coarsest lattice that keeps it"
run 0 bake sheet.obj -o x.espl --tolerance 5mm --json -q
bits=$(grep '"bits"' out | head -n 1)
run 0 bake sheet.obj -o x.espl --max-error 5mm --json -q
[ "$bits" = "$(grep '"bits"' out | head -n 1)" ] || fail "$bits by tolerance, $(grep '"bits"' out | head -n 1) by max error"
awk '/"max_error"/ { exit !($2 + 0 <= 0.005) }' out || fail "$(grep max_error out)"

claim "what cannot be had is unsupported, names the smallest that was reached, and leaves no file"
for pick in "--max-bytes 100" "--fastest-under 5K" "--max-error 5mm --max-bytes 5K"; do
    # shellcheck disable=SC2086
    refuses 5 "nothing fits" bake sheet.obj -o small.espl $pick
    err_has "The smallest of "
    absent small.espl
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >corner.obj
refuses 5 "There is no coarser lattice" bake corner.obj -o small.espl --max-bytes 100 # one bit is enough for it
printf 'v 0 0 0\nv 9 0 0\nv 9 1 0\nf 1 2 3\n' >sliver.obj
refuses 5 "A coarser lattice leaves no triangle" bake sliver.obj -o small.espl --max-bytes 100
for amount in 0 -5 64X K nan 1e99 ""; do run 1 bake sheet.obj -o small.espl --fastest-under "$amount"; done
refuses 1 "is no amount of bytes" bake sheet.obj -o small.espl --max-bytes 64Q
run_each 1 "bake sheet.obj -o small.espl" "--max-bytes 64K --fastest-under 64K" "--max-error 1mm --tolerance 1mm" \
    "--max-error 1mm --bits 12" "--max-error 0"
absent small.espl

claim "a pick leaves alone what the user chose, and an empty mesh is no trouble"
reports "leaves of up to 5 triangles" bake sheet.obj -o x.espl --fastest-under 1M --leaf-size 5 --profile fast
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >line.obj
run 0 bake line.obj -o x.espl --max-bytes 1K --allow-empty
run 0 verify x.espl --deep

claim "leaves are as large as --leaf-size allows"
prints '"leaves": 3200' bake sheet.obj -o x.espl --leaf-size 1 --json -q
run 1 bake sheet.obj -o x.espl --leaf-size 0
run 1 bake sheet.obj -o x.espl --leaf-size 63

# ---- price of bytes -------------------------------------------------------------------------------------------------
claim "a price of bytes shapes the tree; the default written out changes nothing"
makes x.espl sheet.espl bake sheet.obj -o x.espl --byte-price 5 --ids --materials
run 0 bake sheet.obj -o x.espl --byte-price 0 --ids --materials
[ "$(stat -c %s x.espl)" -gt "$(stat -c %s sheet.espl)" ] || fail "free bytes make no larger blob"

claim "a price of bytes out of its range is refused"
for price in -1 1e9 nan much; do
    refuses 1 "--byte-price" bake sheet.obj -o model.espl --byte-price $price
    absent model.espl
done

finish
