#!/usr/bin/env bash
# Claims about command lines that cannot be carried out, and names that are no files.
# Usage: usage_test.sh PATH_TO_ESPALIER
# shellcheck source=claims.sh
. "$(dirname "$0")/claims.sh"

# is_explained WORDS ARGUMENTS...: usage, with these words in one line
is_explained() {
    local words=$1
    shift
    refuses 1 "$words" "$@"
    [ "$(wc -l <err)" = 1 ] || fail "'espalier $*' is explained in several lines: $(cat err)"
    ! grep -qiE 'subcommand|could not convert|required but received|is required|not expected' err || fail "the parser's words: $(cat err)"
}

write_box_obj 0 >box.obj
"$espalier" bake box.obj -o box.espl -q || fail "the box cannot be baked"

claim "a mistyped verb or kind or option is named with the one that was meant"
is_explained "there is no verb 'bak'; did you mean 'bake'?" bak box.obj -o x.espl
is_explained "there is no verb 'verfiy'; did you mean 'verify'?" verfiy box.espl
is_explained "there is no verb 'BAKE'; did you mean 'bake'?" BAKE box.obj -o x.espl
is_explained "there is no verb 'Bak'; did you mean 'bake'?" Bak box.obj
is_explained "there is no option '--JSON' here; did you mean '--json'?" info box.espl --JSON
is_explained "there is no option '--jsn' here; did you mean '--json'?" info box.espl --jsn
is_explained "there is no kind of query 'RAY'; did you mean 'ray'?" query box.espl RAY 0 0 0 0 0 1
is_explained "there is no verb 'xyzzy'. Run 'espalier --help'." xyzzy
is_explained "there is no option '--tolerence' here; did you mean '--tolerance'?" bake box.obj -o x.espl --tolerence 1mm
is_explained "there is no option '--outptu' here; did you mean '--output'?" bake box.obj --outptu x.espl
is_explained "there is no option '--jsno' here; did you mean '--json'?" info box.espl --jsno
is_explained "there is no option '--xyzzy' here. Run 'espalier bake --help'." bake box.obj -o x.espl --xyzzy
is_explained "there is no kind of query 'closest_point'; did you mean 'closest-point'?" query box.espl closest_point 0 0 0
is_explained "there is no kind of query 'spere'; did you mean 'sphere'?" query box.espl spere 0 0 0 1

claim "a kind of query that was renamed is refused with its new name"
while read -r old new; do
    is_explained "there is no kind of query '$old'; did you mean '$new'?" query box.espl "$old" 0 0 0
done <<'NAMES'
nearest closest-point
nearest-segment closest-point-segment
nearest-box closest-point-box
inside contains
planes convex-volume
within within-distance
steps to-lattice
contact fix-internal-edge-normal
NAMES

claim "what is missing or too much is named as the help names it"
is_explained "the verb is missing. Run 'espalier --help'."
is_explained "MESH is missing. Run 'espalier bake --help'." bake
is_explained "BLOB is missing" bake box.obj
is_explained "BLOB is missing" info
is_explained "the kind of query is missing" query box.espl
is_explained "origin x y z, direction x y z" query box.espl ray 0 0 0
is_explained "this query takes 6 words: origin x y z, direction x y z; here are 3" query box.espl ray 0 0 0
is_explained "this query takes 6 words: origin x y z, direction x y z; here are 7" query box.espl ray 1 2 3 4 5 6 7
is_explained "this query takes 1 word: OTHER; here are 2" query box.espl contacts box.espl box.espl
is_explained "BLOB is missing before 'ray'. Run 'espalier query --help'." query ray 0 0
is_explained "BLOB is missing before 'ray'" query ray
is_explained "Run 'espalier query BLOB ray --help'." query box.espl ray 0 0 0
is_explained "'more' is one word too many" info box.espl more
is_explained "'-1' is no value for --threads COUNT" bake box.obj -o x.espl --threads -1
is_explained "'many' is no value for --threads COUNT" bake box.obj -o x.espl --threads many
is_explained "exclude each other" bake box.obj -o x.espl --bits 12 --tolerance 1mm
is_explained "--duplicate-budget needs --builder spatial_splits" bake box.obj -o x.espl --duplicate-budget 0.1
run 0 bake box.obj -o x.espl -q --duplicate-budget 0.1 --builder spatial_splits --profile fast

claim "a value that is none or one too many or missing is explained with the option and its range"
is_explained "--bits is given 2 times; give it once" bake box.obj -o x.espl --bits 12 --bits 14
is_explained "--output is given 2 times; give it once" bake box.obj -o x.espl -o y.espl
is_explained "--bits 1..24: a value is missing" bake box.obj -o x.espl --bits
is_explained "--bits: 'abc' is no whole number from 1 to 24" bake box.obj -o x.espl --bits abc
is_explained "--effort: '5' is none of fast|normal|best" bake box.obj -o x.espl --effort 5
is_explained "--max-dropped: '5percent' is no number from 0 to 100" bake box.obj -o x.espl --max-dropped 5percent
is_explained "--bounds: 'box' is none of obb|sphere|kdop" bake box.obj -o x.espl --bounds box
is_explained "--bounds: 'box' is none of obb|sphere|kdop" bake box.obj -o x.espl --bounds obb,box
for bounds in "--bounds obb,sphere" "--bounds obb --bounds sphere"; do
    # shellcheck disable=SC2086  # words
    run 0 bake $bounds box.obj -o x.espl -q # what follows is the mesh
    [ -e two.espl ] || cp x.espl two.espl
    same x.espl two.espl
done
rm x.espl two.espl

claim "an empty value, as of a variable that is not set, is refused with its option"
for option in --tolerance --unit --threads --depfile --remap --reorder --lattice-of --step --max-error; do
    is_explained "$option: the value is empty" bake box.obj -o x.espl $option ""
done
is_explained "--output: the value is empty" bake box.obj -o ""
for option in --symbol --section --header; do
    is_explained "$option: the value is empty" embed box.espl -o x.c $option ""
done
is_explained "--accuracy: the value is empty" query box.espl ray 0 0 0 0 0 1 --accuracy ""
is_explained "--csv: the value is empty" trade box.obj --csv ""
[ ! -e x.espl ] && [ ! -e x.c ] || fail "a file is there"

claim "help is a verb too"
for words in "" bake query trade; do
    # shellcheck disable=SC2086  # words
    "$espalier" help $words >shown.txt
    # shellcheck disable=SC2086  # words
    makes shown.txt out $words --help
done
"$espalier" help query ray >shown.txt
makes shown.txt out query BLOB ray --help

claim "a blob is read from standard input by the name - and no output or mesh has that name"
for verb in info verify dump "query - bounds"; do
    case $verb in query*) arguments=$verb ;; *) arguments="$verb -" ;; esac
    # shellcheck disable=SC2086
    "$espalier" $arguments <box.espl >out 2>err || fail "$arguments: $(cat err)"
done
"$espalier" query - bounds <box.espl >from_input
"$espalier" query box.espl bounds >from_file
same from_input from_file
"$espalier" bake box.obj -o x.espl -q --lattice-of box.espl --depfile x.d
"$espalier" bake box.obj -o y.espl -q --lattice-of - --depfile y.d <box.espl || fail "no lattice from the input"
same x.espl y.espl
! grep -q ' -$' y.d || fail "the depfile lists -"
rm x.espl y.espl x.d y.d
is_explained "-o -: an output needs the name of a file" bake box.obj -o -
is_explained "--remap -: an output" bake box.obj -o x.espl --remap -
is_explained "-o -: " render box.espl -o -
is_explained "-o -: " embed box.espl -o -
is_explained "-: a mesh needs the name of a file" bake - -o x.espl
[ ! -e ./- ] || fail "there is a file -"

claim "a picture is refused under the ending of another format before it is drawn"
is_explained "-o x.jpg: the picture is a PNG; give it a name that ends in .png" render box.espl -o x.jpg
is_explained "-o x.png: the picture is an SVG; give it a name that ends in .svg" trade box.obj -o x.png
[ ! -e x.jpg ] && [ ! -e x.png ] || fail "a picture is there"

claim "a folder that is not there or no folder is noticed before the bake"
for option in "-o no/x.espl" "-o x.espl --remap no/x" "-o x.espl --reorder no/x.ply" "-o x.espl --depfile no/x.d" \
    "-o box.obj/x.espl" "-o /proc/x.espl"; do
    # shellcheck disable=SC2086
    refuses 2 "cannot write '" bake box.obj $option
    err_lacks "triangles in"
    [ ! -e x.espl ] || fail "x.espl is there"
done
run 2 render box.espl -o no/x.png
run 2 embed box.espl -o x.c --header no/x.h
[ ! -e x.c ] || fail "x.c is there"

claim "the outputs of a bake are all new or all old"
mkdir kept
for file in x.espl x.remap x.ply x.d; do echo old >kept/$file; done
write_sheet 21 '3 * sin(i / 5) * cos(j / 7)' >sheet.obj
if ! on_windows; then # which has no such limit
    # The blob has less than 8 KiB and the reordered mesh more: the disk "fills up" after the depfile is written.
    (ulimit -f 8 && trap '' XFSZ &&
        "$espalier" bake sheet.obj -o kept/x.espl --remap kept/x.remap --reorder kept/x.ply --depfile kept/x.d 2>err)
    [ $? = 2 ] || fail "a full disk is not exit status 2: $(cat err)"
    for file in x.espl x.remap x.ply x.d; do [ "$(cat kept/$file)" = old ] || fail "$file is new"; done
    [ "$(ls -A kept | wc -l)" = 4 ] || fail "kept holds $(ls -A kept | tr '\n' ' ')"
fi

claim "a value out of its range is shown as it was typed, with the option"
refuses 1 "--byte-price: '-1' is no number from 0 to" bake box.obj -o x.espl --byte-price -1
refuses 1 "--flat-angle, the largest angle of a flat edge, is 95 degrees; choose 0 or more, below 90." bake box.obj -o x.espl --flat-angle 95

finish
