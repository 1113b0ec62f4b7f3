#!/usr/bin/env bash
# Tests of `espalier embed`, and of how every verb writes its files.
# Usage: output_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

# ---- embed ----------------------------------------------------------------------------------------------------------
claim "what is embedded says its name, size, section and alignment, and is the same in any folder"
reports "wrote level.c: level, $(stat -c %s box.espl) bytes in .rodata.level, aligned to 16" embed box.espl -o level.c --header level.h
run 0 embed box.espl -o level.c --header level.h -q --json
[ ! -s err ] || fail "something was said"
json ".symbol == \"level\" and .bytes == $(stat -c %s box.espl) and .section == \".rodata.level\" and .header == \"level.h\""
mkdir embedded
cp box.espl embedded/other.espl
makes level.c embedded/level.c embed embedded/other.espl -o embedded/level.c --header embedded/level.h -q
same level.h embedded/level.h
run 0 embed box.espl -o x.S --symbol arena --section .flash_blobs --alignment 64 -q
for words in '.section .flash_blobs, "a"' '.balign 64' '.global arena' '"box.espl"'; do
    grep -qF "$words" x.S || fail "x.S lacks $words"
done

claim "a header that stays the same is not touched"
touch -d '2020-01-01' level.h
run 0 embed box.espl -o level.c --header level.h -q
[ "$(stat -c %Y level.h)" = "$(date -d '2020-01-01' +%s)" ] || fail "the header has a new time"
run 0 embed sheet.espl -o level.c --header level.h -q
[ "$(stat -c %Y level.h)" != "$(date -d '2020-01-01' +%s)" ] || fail "the header of another blob is the old one"

claim "what cannot be embedded is refused, and nothing is written"
refuses 1 ".c or .cpp for an array, .S for assembler" embed box.espl -o bad.txt
for name in 2nd new a-b _x a__b linux; do run 1 embed box.espl -o bad.c --symbol $name; done
refuses 1 "'new' cannot name a variable" embed box.espl -o new.c
for alignment in 0 3 131072 -16; do run 1 embed box.espl -o bad.c --alignment $alignment; done
run 1 embed box.espl -o bad.c --section '.rodata,"aw"'
run 1 embed box.espl -o bad.c --header bad.c
refuses 1 "--header and -o name the same file" embed box.espl -o bad.c --header "$PWD/./bad.c"
refuses 3 "'box.obj' is refused" embed box.obj -o bad.c --header bad.h
run 2 embed missing.espl -o bad.c --header bad.h
cp box.espl blob.c
run 1 embed blob.c -o blob.c
same box.espl blob.c
absent bad.c bad.h new.c

# ---- writing --------------------------------------------------------------------------------------------------------
claim "outputs that cannot be written are exit status 2, name the file, and leave nothing behind"
refuses 2 "missing_folder/x.espl" bake box.obj -o missing_folder/x.espl
mkdir occupied occupied/x.espl
run 2 bake box.obj -o occupied/x.espl
only occupied "x.espl "
if [ -c /dev/full ]; then
    run 2 bake box.obj -o /dev/full
    run 2 render box.espl -o /dev/full --size 8x8
    "$espalier" info box.espl >/dev/full 2>err
    [ $? = 2 ] || fail "a full stdout went unnoticed"
    "$espalier" dump box.espl --json >/dev/full 2>err
    [ $? = 2 ] || fail "a full stdout went unnoticed"
fi
if [ "$(id -u)" != 0 ]; then
    mkdir locked
    chmod a-w locked
    run 2 bake box.obj -o locked/x.espl
    chmod u+w locked
    only locked ""
fi
(ulimit -f 1 && trap '' XFSZ && "$espalier" bake sheet.obj -o limited.espl 2>err)
[ $? = 2 ] || fail "a disk that fills up in the middle is not exit status 2: $(cat err)"
absent limited.espl

claim "a failed bake leaves the old blob and the folder as they were"
mkdir kept
cp box.espl kept/x.espl
run 3 bake not_finite.obj -o kept/x.espl
run 5 bake junk.unknown -o kept/x.espl
(cd kept && ulimit -f 1 && trap '' XFSZ && "$espalier" bake ../sheet.obj -o x.espl 2>/dev/null)
same box.espl kept/x.espl
only kept "x.espl "
makes sheet.espl kept/x.espl bake sheet.obj -o kept/x.espl --ids --materials
only kept "x.espl "

claim "a bake that is killed at any moment leaves the old blob or the new one, never a part"
write_sheet 150 '3 * sin(i / 5) * cos(j / 7)' >large.obj
run 0 bake large.obj -o large.espl -q --effort fast
mkdir killed
start_baking() { # a shell has what it starts in the background ignore interrupts
    cp box.espl killed/x.espl
    env --default-signal=INT "$espalier" bake large.obj -o killed/x.espl -q --effort fast &
    baking=$!
}
# As soon as there is a file beside the output; false when the bake was faster.
kill_in_the_middle() { # SIGNAL
    while kill -0 $baking 2>/dev/null && [ -z "$(find killed -name '.*' -type f)" ]; do :; done
    kill "-$1" $baking 2>/dev/null
    wait $baking 2>/dev/null
    [ $? -gt 128 ]
}
in_the_middle=0
for try in $(seq 24); do
    start_baking
    if [ $((try % 2)) = 0 ]; then
        kill_in_the_middle KILL && in_the_middle=$((in_the_middle + 1))
    else
        sleep "0.$((RANDOM % 3))$((RANDOM % 10))"
        kill -KILL $baking 2>/dev/null
        wait $baking 2>/dev/null
    fi
    cmp -s killed/x.espl box.espl || cmp -s killed/x.espl large.espl || fail "killed: neither the old blob nor the new one"
    rm -f killed/.x.espl.*
done
[ $in_the_middle -gt 0 ] || fail "no bake was killed in the middle of writing"
for signal in INT TERM HUP; do
    for try in $(seq 20) never; do
        start_baking
        kill_in_the_middle $signal && break
    done
    [ $try != never ] || fail "no bake was stopped by $signal in the middle of writing"
    only killed "x.espl "
    rm -f killed/.x.espl.*
done

claim "an input that cannot be read is exit status 2 or 3, names the file, and leaves the old blob"
if [ -e /proc/self/mem ]; then
    ln -s /proc/self/mem unreadable.obj # opens, and every read fails
    ln -s /proc/self/mem unreadable.espl
    cp box.espl killed/x.espl
    "$espalier" bake unreadable.obj -o killed/x.espl >out 2>err
    code=$?
    [ $code = 2 ] || [ $code = 3 ] || fail "an input whose reads fail ended with $code: $(head -c 400 err)"
    err_has "unreadable.obj"
    same killed/x.espl box.espl
    refuses 2 "unreadable.espl" info unreadable.espl
fi
mkdir folder.obj
"$espalier" bake folder.obj -o killed/x.espl >out 2>err
code=$?
[ $code = 2 ] || [ $code = 3 ] || fail "a folder as input ended with $code"
err_has "folder.obj"
only killed "x.espl "

claim "an input is never replaced by its own output"
refuses 1 "itself" bake box.obj -o box.obj
run 1 bake sheet.obj box.obj -o ./box.obj
run 1 render box.espl -o box.espl
makes x.espl box.espl bake box.obj -o x.espl

claim "a link is written through, and a device stays a device"
ln -s target.espl link.espl
cp box.espl target.espl
run 0 bake sheet.obj -o link.espl --ids --materials
[ -L link.espl ] || fail "the link was replaced"
same target.espl sheet.espl
mkdir linked
ln -s target.espl linked/second.espl
ln -s linked/second.espl chain.espl # to a link whose file does not exist
run 0 bake box.obj -o chain.espl
[ -L chain.espl ] || fail "the first link was replaced"
[ -L linked/second.espl ] || fail "the second link was replaced"
same linked/target.espl box.espl
refuses 1 "name the same file" bake box.obj -o chain.espl --depfile linked/target.espl
rm linked/target.espl
run 1 bake box.obj -o chain.espl --depfile linked/target.espl
absent linked/target.espl
ln -s missing_folder/x.espl lost.espl
refuses 2 "cannot write 'lost.espl': No such file or directory" bake box.obj -o lost.espl
ln -s loop.espl loop.espl
refuses 2 "cannot write 'loop.espl': Too many levels of symbolic links" bake box.obj -o loop.espl
[ -L loop.espl ] || fail "the loop was replaced"
run 0 bake box.obj -o /dev/null
[ -c /dev/null ] || fail "/dev/null was replaced"
makes out box.espl bake box.obj -o /dev/stdout -q

finish
