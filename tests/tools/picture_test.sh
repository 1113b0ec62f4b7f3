#!/usr/bin/env bash
# Tests of `espalier dump`, `render` and `trade`, and of the JSON of all verbs.
# Usage: picture_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

echo >model.json

# ---- dump, render ---------------------------------------------------------------------------------------------------
claim "dump shows every byte once and in order"
"$espalier" bake sheet.obj -o strips.espl -q --ids --materials --profile balanced || fail "no strips"
"$espalier" bake sheet.obj -o split.espl -q --ids --profile fast --builder spatial_splits || fail "no splits"
run 0 dump split.espl
out_has "low x 0" "node children" "leaf 0: data at 4 x 0 of the block" "no more leaves" "first triangle 0" "corner a, 8 bits: 0" \
    "ids of triangles from 0:"
for blob in box sheet two empty strips split; do dumps_all $blob.espl; done
run 0 dump sheet.espl
out_has 'magic "ESPL"' "lattice bits 16" "node 0: base 0" "leaf block at" "first triangle 0" "bits:" "source 0: ids from 0" \
    "materials of triangles from 0:"
run 0 dump strips.espl
out_has "profile 1" "entries, triangles from 0 + 0" "entries (* pivot): 0* " "; triangles: 0-1-2" "ids.first corners of triangles from 0:"
run 0 verify strips.espl --deep

claim "a limited dump says what it leaves out; a refused blob shows its header"
run 0 dump sheet.espl --limit 10
[ "$(wc -l <out)" = 11 ] || fail "$(wc -l <out) lines"
out_has "-- left out: "
prints '"bytes_left_out": ' dump sheet.espl --limit 10 --json
run 3 dump changed.espl
out_has 'magic "ESPL"'
run 3 dump stub.espl
out_has "cut short"

claim "render writes a PNG of the asked size, the same at any number of threads"
run 0 render sheet.espl -o a.png --size 64x48 --threads 1
prints '"width": 64' render sheet.espl -o b.png --size 64x48 --threads 3 --json
same a.png b.png
[ "$(od -A n -t x1 -N 8 a.png | tr -d ' ')" = 89504e470d0a1a0a ] || fail "no PNG signature"
[ "$(od -A n -t x1 -j 16 -N 8 a.png | tr -d ' ')" = 0000004000000030 ] || fail "not 64 x 48"
for size in 0x5 5x0 64 64x 64x48x2 x -5x5 99999x5; do run 1 render sheet.espl -o c.png --size=$size; done
absent c.png

claim "the heat map says how much work its colours stand for"
reports "steps a ray: " render sheet.espl -o heat.png --size 64x48 --heatmap steps
prints '"mean": ' render sheet.espl -o heat.png --size 64x48 --heatmap steps --json -q
run 1 render sheet.espl -o heat.png --heatmap joy
cmp -s a.png heat.png && fail "the heat map looks like the shaded picture"

# ---- trade ----------------------------------------------------------------------------------------------------------
claim "trade writes a row for each combination, with what was chosen and what came out"
quick="--rays 300 --repetitions 1"
# shellcheck disable=SC2086
run 0 trade sheet.obj --bits 10,16 --leaf-sizes 4,16,20 --byte-prices 5 --builders binned_sah,linear --profiles fast $quick
[ "$(wc -l <out)" = 9 ] || fail "$(wc -l <out) lines for 8 combinations"
for column in mesh profile builder bits leaf_size byte_price triangles bytes bytes_per_triangle max_error mean_error closest_ns \
    any_ns overlap_ns nodes_per_ray leaves_per_ray triangles_per_ray counted_cost bake_seconds pareto_closest; do
    head -n 1 out | tr ',' '\n' | grep -qx $column || fail "no column $column"
done
awk -F , 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; columns = NF; next }
    { if (NF != columns) { print "columns"; exit }
      if (!($at["bytes"] > 0 && $at["closest_ns"] > 0 && $at["any_ns"] > 0 && $at["overlap_ns"] > 0 && $at["nodes_per_ray"] >= 1))
          print "no measurement in row " NR
      if (!($at["mean_error"] > 0 && $at["mean_error"] <= $at["max_error"] * 1.001)) print "mean error in row " NR
      front += $at["pareto_closest"] }
    END { if (front < 2) print "no front" }' out >complaints
[ ! -s complaints ] || fail "$(cat complaints)"

claim "trade counts the same twice, whatever the clock says"
counts() { awk -F , 'NR == 1 { for (i = 1; i <= NF; ++i) keep[i] = $i !~ /_ns|seconds|pareto/ }
    { line = ""; for (i = 1; i <= NF; ++i) if (keep[i]) line = line "," $i; print line }' "$1"; }
# shellcheck disable=SC2086
run 0 trade sheet.obj --bits 12 $quick --csv a.csv
[ ! -s out ] || fail "the numbers went to a file and to stdout"
# shellcheck disable=SC2086
run 0 trade sheet.obj --bits 12 $quick --csv b.csv --threads 2
counts a.csv >a.counts
counts b.csv >b.counts
same a.counts b.counts

claim "trade draws a picture that is well-formed, names what it shows, and survives odd file names"
cp sheet.obj "$(printf 'a<b>&"\377c.obj')"
# shellcheck disable=SC2086
run 0 trade "$(printf 'a<b>&"\377c.obj')" -o trade.svg --csv trade.csv $quick
grep -q "a&lt;b&gt;&amp;&quot;?c.obj" trade.svg || fail "the name is not escaped"
for word in "closest hit" "any hit" "sphere overlap" "bytes a triangle" "lattice of 16 bits: error at most" "profile fast" "profile small" "<polygon\|<circle" \
    "The front of closest hits"; do
    grep -q "$word" trade.svg || fail "the picture lacks '$word'"
done
if command -v xmllint >/dev/null; then
    xmllint --noout trade.svg 2>err || fail "no XML: $(head -c 300 err)"
else
    # every tag is closed, in itself or by the line's end, but the outermost
    grep -v '^<?xml\|^<svg\|^</svg>$' trade.svg | grep -qv '^<[a-z]*\( [a-zA-Z0-9-]*="[^"<]*"\)*\(/>\|>[^<]*</text>\)$' && fail "a line is no element"
    [ "$(tail -n 1 trade.svg)" = "</svg>" ] || fail "the picture is cut short"
fi

claim "trade leaves out what does not go together, and refuses when nothing is left"
run 0 trade box.obj --bits 8 --builders binned_sah,spatial_splits --profiles small $quick --csv some.csv
[ "$(grep -c binned_sah some.csv)" -gt 0 ] || fail "nothing is measured"
grep -q spatial_splits some.csv && fail "what cannot be baked is measured"
refuses 1 "spatial splits need the profile fast" trade box.obj --bits 8 --builders spatial_splits --profiles balanced,small $quick -o refused.svg
absent refused.svg

claim "trade refuses lists that make no sense, and what cannot be measured"
for list in "--bits 0" "--bits 12,25" "--bits 12.5" "--bits many" "--bits 12,," "--leaf-sizes 63" "--byte-prices -1" "--profiles huge" \
    "--builders quick" "--rays 5" "--repetitions 0"; do
    # shellcheck disable=SC2086
    run 1 trade box.obj $list -o refused.svg
done
run 1 trade box.obj -o box.obj
run 2 trade missing.obj
run 3 trade points.obj
absent refused.svg

# ---- JSON -----------------------------------------------------------------------------------------------------------
claim "every --json is one JSON object with a schema"
if command -v jq >/dev/null; then
    cp box.obj "$(printf 'l\303\251vel \377.obj')"
    for arguments in "bake box.obj $(printf 'l\303\251vel') -o x.espl" "bake box.obj -o x.espl" "bake box.obj -o x.espl --max-bytes 1K" "info sheet.espl" \
        "verify sheet.espl --deep --source sheet.obj" "query box.espl ray 0 0 0 nan 0 0" "query box.espl ray 0 1 9 0 0 -1 --all" \
        "query box.espl sphere 0 0 0 inf" "query box.espl closest-point 0 0 9" "render box.espl -o x.png --size 8x8" \
        "trade box.obj --rays 100 --bits 9,16" "dump sheet.espl" "dump changed.espl"; do
        # shellcheck disable=SC2086
        "$espalier" $arguments --json 2>/dev/null >out
        [ ! -s out ] || jq -e '.schema == 1' out >/dev/null || fail "$arguments"
    done
    run 0 bake "$(printf 'l\303\251vel \377.obj')" -o x.espl --json
    jq -e '.inputs[0].triangles == 12' out >/dev/null || fail "a name that is no UTF-8"
else
    echo "note: without jq only the keys of the JSON were looked at"
fi

finish
