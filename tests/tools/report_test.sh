#!/usr/bin/env bash
# Claims about what the command reports to scripts: warnings and errors in JSON.
# Usage: report_test.sh PATH_TO_ESPALIER
# shellcheck source=claims.sh
. "$(dirname "$0")/claims.sh"

# warns_of KINDS...: the JSON has exactly these warnings, and stderr has a line for each.
warns_of() {
    json "[.warnings[].kind] == [$([ $# = 0 ] || printf '"%s",' "$@" | sed 's/,$//')]"
    [ "$(grep -c '^warning: ' err)" = $# ] || fail "not $# warnings on stderr: $(head -c 400 err)"
    are_on_stderr '.warnings[].message' "warning: "
}
# are_on_stderr FILTER BEFORE: each line that jq finds in the JSON is on stderr, after these words.
are_on_stderr() {
    jq -r "$1" out 2>/dev/null | while IFS= read -r line; do
        grep -qF -- "$2$line" err || echo "$line"
    done >unprinted
    [ ! -s unprinted ] || fail "not on stderr: $(cat unprinted)"
}
# fails_with KIND FILE MESH TRIANGLE EXIT_CODE ARGUMENTS..., the second to the fourth as JSON
fails_with() {
    run "${@:5}" --json
    json ".error.kind == \"$1\" and .error.file == $2 and .error.mesh == $3 and .error.triangle == $4"
    are_on_stderr '.error.message' ""
}

write_box_obj 0 >box.obj
write_box_obj 1000 >far_box.obj
head -n 19 box.obj >open.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >line.obj
"$espalier" bake box.obj -o box.espl -q || fail "the box cannot be baked"

claim "every warning of a bake is on stderr and in the JSON with its kind and quiet silences none"
run 0 bake box.obj -o x.espl --json -q
warns_of
run 0 bake far_box.obj -o x.espl --json -q --bits 24 --origin none
warns_of step_below_float_spacing rays_rounded_coarsely
run 0 bake box.obj -o x.espl --json -q --unit km
warns_of unexpected_size
run 0 bake box.obj -o x.espl --json -q --unit km --bits 23
warns_of rays_rounded_coarsely unexpected_size
"$espalier" bake line.obj -o none.espl -q --allow-empty --max-dropped 100
run 0 render none.espl -o x.png --size 8x8 --json -q
warns_of empty

claim "an error lists the warnings that came before it whichever step fails"
{ write_box_obj 0; echo faces 7; } >unknown.obj
printf 'o a\nv 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\n' >corner.obj
{ echo '<COLLADA version="1.4.1"><library_visual_scenes><visual_scene>' && yes '<node>' | head -n 200000 && yes '</node>' | head -n 200000 &&
    echo '</visual_scene></library_visual_scenes></COLLADA>'; } >deep.dae # uses up the stack of assimp
fails_after_warning() { # EXIT_CODE KIND ARGUMENTS...
    local code=$1 kind=$2
    shift 2
    run "$code" "$@" --json
    json ".error.kind == \"$kind\""
    warns_of unknown_statement
}
fails_after_warning 2 file_access bake unknown.obj missing.obj -o x.espl
fails_after_warning 3 invalid_input bake unknown.obj corner.obj -o x.espl
fails_after_warning 3 importer_crash bake unknown.obj deep.dae -o x.espl
err_has "a mistake of the importer"
fails_after_warning 5 unsupported bake unknown.obj -o x.espl --max-bytes 100
fails_after_warning 5 unsupported bake unknown.obj -o x.espl --step 2^-60
fails_after_warning 2 file_access bake unknown.obj -o /dev/full
fails_after_warning 2 file_access trade unknown.obj missing.obj
fails_after_warning 2 file_access verify box.espl --source unknown.obj missing.obj
fails_after_warning 3 invalid_input verify box.espl --source unknown.obj --unit km
run 2 render none.espl -o /dev/full --size 8x8 --json
warns_of empty

claim "each verb that fails prints one document with the kind and the message and the place of the error"
fails_with usage null null null 1
run 1 fold --json
run 1 bake --json
run 1 bake box.obj -o x.espl --bits 25 --json
fails_with file_access '"missing.obj"' null null 2 bake missing.obj -o x.espl
echo nonsense >nonsense.obj.txt
fails_with unsupported '"nonsense.obj.txt"' null null 5 bake nonsense.obj.txt -o x.espl
printf 'o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\no b\nf 1 2 3\nf 1 3 2\nf 1 2 4\n' >nan.obj
fails_with invalid_input '"nan.obj"' 1 2 3 bake box.obj nan.obj -o x.espl
fails_with unsupported '"box.obj"' null null 5 bake box.obj -o x.espl --step 2^-60
fails_with file_access '"missing/x.espl"' null null 2 bake box.obj -o missing/x.espl
for verb in info verify dump; do
    fails_with invalid_input '"box.obj"' null null 3 $verb box.obj
done
fails_with invalid_input '"box.obj"' null null 3 query box.obj bounds
run 3 render box.obj -o x.png --json
run 3 embed box.obj -o x.c --json
fails_with invalid_input '"box.espl"' null null 3 verify box.espl --source far_box.obj
fails_with empty '"line.obj"' null null 3 trade line.obj
"$espalier" bake open.obj -o open.espl -q
fails_with no_answer null null null 6 query open.espl contains 0 0 0
json '.query == "contains" and .status == "not_closed"'

claim "a resolution that a mesh is too large or too small for names the file and the option that mends it"
for scale in 1e+38 1e-37; do
    printf 'v 0 0 0\nv %s 0 0\nv 0 %s 0\nf 1 2 3\n' $scale $scale >extreme.obj
    refuses 5 "'extreme.obj': the meshes are $scale units large" bake extreme.obj -o x.espl
    err_has "scale the input with --scale"
done
write_sheet 3 'i / 7' >slope.obj
refuses 5 "'slope.obj': a tolerance of 1e-12 is too fine" bake slope.obj -o x.espl --tolerance 1e-12
refuses 5 "'box.obj', 'open.obj': a step of 2^-60 is too fine" bake box.obj open.obj -o x.espl --step 2^-60

claim "a message gives its advice once"
advises_once() { # ADVICE EXIT_CODE ARGUMENTS...
    run "${@:2}"
    [ "$(grep '^espalier: ' err | grep -oiE -- "$1" | wc -l)" = 1 ] || fail "'$1' is not once in: $(cat err)"
}
advises_once 'drop.bad.triangles' 3 bake nan.obj -o x.espl
err_has "--drop-bad-triangles"
{ head -c 4 box.espl; printf '\011\000'; tail -c +7 box.espl; } >newer.espl
advises_once 'bake (it )?again' 5 info newer.espl
advises_once '--unit' 3 bake box.obj -o x.espl --unit mm --expect-size 2m..4m
printf 'v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nend\n' >curve.obj
advises_once 'Check the file|Export it' 3 bake curve.obj -o x.espl -q

claim "a verb that fails without a result lists its warnings, also when there are none"
for arguments in "bake missing.obj -o x.espl" "bake --xyzzy" "info missing.espl" "render missing.espl -o x.png" \
    "verify missing.espl"; do
    # shellcheck disable=SC2086  # words
    "$espalier" $arguments --json >out 2>err && fail "$arguments is no failure"
    json '.warnings == []'
done

claim "a coordinate that is not finite is named by its axis and value"
for values in "0 1 nan:z = NaN" "0 inf 1:y = infinity" "0 1e400 0:y = infinity" "-inf 0 0:x = -infinity"; do
    printf 'v 0 0 0\nv 1 0 0\nv %s\nf 1 2 3\n' "${values%%:*}" >wrong.obj
    for options in "" "--unit mm" "--up y"; do
        # shellcheck disable=SC2086  # words
        refuses 3 "has ${values#*:}" bake wrong.obj -o x.espl $options
    done
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n' >wrong.obj
refuses 3 "line 3: vertex 3, counted from 1, has z = NaN" bake wrong.obj -o x.espl --up z
printf 'v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n' >wrong.obj
refuses 3 "has the coordinate 1e+39, beyond float32" bake wrong.obj -o x.espl

finish
