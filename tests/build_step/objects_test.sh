#!/usr/bin/env bash
# What compilers and linkers make of an embedded blob: read-only, aligned, whole, there when it is used and gone when not.
# Usage: objects_test.sh PATH_TO_ESPALIER SOURCE_FOLDER CMAKE GENERATOR
# Exit status 77: nothing is broken, and a cross compiler is missing.
# shellcheck source=projects.sh
. "$(dirname "$0")/projects.sh"

write_level level
# In a folder other than that of the compilers: an assembler finds the blob by include folder.
mkdir made
"$espalier" bake level/level.obj -o made/level.espl -q || fail "the level cannot be baked"
size=$(stat -c %s made/level.espl)
any_compiler=$(command -v gcc || command -v clang) || { echo "skipped: there is neither gcc nor clang" && exit 77; }
strict=(-Wall -Wextra -Wpedantic -Wconversion "${WERROR:--Werror}")

# object_is FILE SECTION ALIGNMENT SYMBOL [OBJCOPY]: in it the blob, read-only and hidden, and nothing else that takes memory
object_is() {
    local objcopy=${5:-objcopy}
    readelf -SW "$1" | awk -v name="$2" -v alignment="$3" '
        { sub(/^ *\[ *[0-9]+\] */, "") } $1 == name && $(NF - 3) == "A" && $NF == alignment { found = 1 }
        ($1 ~ /^\.(data|bss)/) && $5 !~ /^0+$/ { writable = 1 } END { exit !found || writable }' ||
        fail "$1: not read-only in $2, aligned to $3: $(readelf -SW "$1")"
    readelf -sW "$1" | grep -qE " $size +OBJECT +GLOBAL +HIDDEN +[0-9]+ $4\$" || fail "$1: $(readelf -sW "$1")"
    rm -f bytes
    "$objcopy" -O binary --only-section="$2" --set-section-flags "$2=alloc" "$1" bytes
    same bytes made/level.espl
}

claim "as C, C++ and assembler, the blob is constant, aligned, in .rodata, hidden and whole, and compiles without a warning"
for source in c cpp S; do
    run 0 embed made/level.espl -o made/level.$source --header made/level.h -q
    for compiler in gcc clang; do
        command -v $compiler >/dev/null || continue
        for optimisation in -O0 -O2; do
            $compiler "${strict[@]}" $optimisation -fPIC -Imade -c made/level.$source -o level.o || fail "$compiler: level.$source"
            object_is level.o .rodata.level 16 level
        done
    done
done

claim "name, section and alignment are what was asked for"
for source in c S; do
    run 0 embed made/level.espl -o made/arena.$source --symbol arena --section .blobs --alignment 4096 -q
    "$any_compiler" "${strict[@]}" -Imade -c made/arena.$source -o arena.o || fail "arena.$source"
    object_is arena.o .blobs 4096 arena
done

claim "the header is C99 and C++11 and later, and from C++20 on it has a span"
echo '#include "level.h"' >use.c
"$any_compiler" -std=c99 "${strict[@]}" -Imade -c use.c -o use.o || fail "c99"
echo '_Static_assert(level_size == sizeof level, "");' >>use.c
"$any_compiler" -std=c11 "${strict[@]}" -Imade -c use.c -o use.o || fail "c11"
for language in c++11 c++17 c++20; do
    printf '#include "level.h"\n#include "level.h"\nstatic_assert(level_size == sizeof level, "");\n' >use.cpp
    [ $language != c++20 ] || echo 'std::span<const std::byte> all() { return level_bytes(); }' >>use.cpp
    for compiler in g++ clang++; do
        command -v $compiler >/dev/null || continue
        $compiler -std=$language "${strict[@]}" -Imade -c use.cpp -o use.o || fail "$compiler $language"
    done
done

claim "code of a shared library reaches the blob without a table that another library could change"
echo 'unsigned char at(int i) { return level[i]; }' >>use.c
"$any_compiler" -O2 -fPIC -Imade -c use.c -o use.o || fail "use.c"
readelf -rW use.o | grep -q ' level ' || fail "nothing refers to the blob: $(readelf -rW use.o)"
! readelf -rW use.o | grep -q GOT || fail "$(readelf -rW use.o)"

claim "two shared libraries of one program have each their own blob of one name, also where nothing is inlined"
if command -v g++ >/dev/null; then
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >other.obj
    mkdir other
    run 0 bake other.obj -o other/level.espl -q
    run 0 embed other/level.espl -o other/level.S --header other/level.h -q
    for library in made other; do
        printf '#include "level.h"\nunsigned long size_of_%s() { return level_bytes().size(); }\n' $library >$library.cpp
        g++ -std=c++20 -O0 -fPIC -shared -I$library $library.cpp $library/level.S -o lib$library.so || fail "lib$library.so"
    done
    cat >sizes.cpp <<'CPP'
#include <cstdio>
unsigned long size_of_made(), size_of_other();
int main() { std::printf("%lu %lu\n", size_of_made(), size_of_other()); }
CPP
    g++ sizes.cpp -L. -lmade -lother -Wl,-rpath,. -o sizes || fail "sizes.cpp"
    [ "$(./sizes)" = "$size $(stat -c %s other/level.espl)" ] || fail "the libraries say $(./sizes)"
else
    echo "skipped: there is no g++"
fi

claim "assembler takes neither the program's protected stack nor its control-flow protection away"
"$any_compiler" -Imade -c made/level.S -o level.o
write_main made
"$any_compiler" -Wl,--fatal-warnings -Imade made/main.c level.o -o game || fail "the linker warns"
readelf -lW game | grep GNU_STACK | grep -q ' RW ' || fail "$(readelf -lW game | grep GNU_STACK)"
if [ "$(uname -m)" = x86_64 ]; then
    "$any_compiler" -fcf-protection -Imade -c made/level.S -o level.o
    readelf -nW level.o | grep -q 'IBT, SHSTK' || fail "no note of control-flow protection: $(readelf -nW level.o)"
fi

# ---- a cross build --------------------------------------------------------------------------------------------------
if ! command -v arm-none-eabi-g++ >/dev/null; then
    echo "skipped: arm-none-eabi-g++ is not installed (tools/dev prove firmware installs it)"
    finish
    status=$?
    exit $((status == 0 ? 77 : status))
fi
write_head level "CXX ASM"
cat >>level/CMakeLists.txt <<'CMAKE'
foreach(format IN ITEMS c assembler)
  espalier_add_blob(${format} MESH level.obj SYMBOL blob_as_${format} FORMAT ${format})
  espalier_add_blob(unused_${format} MESH level.obj FORMAT ${format})
  target_link_libraries(unused_${format} INTERFACE ${format})
endforeach()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/main.cpp "#include \"c.h\"
#include \"assembler.h\"
extern \"C\" const void* start(int i) { return i < 3 ? blob_as_c_bytes().data() : blob_as_assembler_bytes().data(); }")
add_executable(image.elf ${CMAKE_CURRENT_BINARY_DIR}/main.cpp)
set_target_properties(image.elf PROPERTIES CXX_STANDARD 20)
target_link_libraries(image.elf PRIVATE unused_c unused_assembler)
target_link_options(image.elf PRIVATE -nostdlib -Wl,--gc-sections -Wl,--entry=start)
CMAKE

claim "a cross build bakes with a command of this machine, and its objects hold the blob in .rodata"
must configure level cross -DESPALIER_EXECUTABLE="$counting" \
    -DCMAKE_TOOLCHAIN_FILE="$espalier_sources/lib/cmake/toolchains/cortex-m4f.cmake"
must build cross --target image.elf
sort "$verbs" | uniq -c | awk '$1 != 4 { bad = 1 } END { exit bad || NR != 2 }' || fail "verbs: $(sort "$verbs" | uniq -c)"
for format in c assembler; do
    object=$(find cross -path "*/$format.dir/*" -name '*.o' -o -path "*/$format.dir/*" -name '*.obj')
    readelf -hW "$object" | grep -q 'Machine: *ARM' || fail "$object is for another machine"
    object_is "$object" .rodata.blob_as_$format 16 blob_as_$format arm-none-eabi-objcopy
done

claim "a linker that throws away what is not used keeps the blobs that are, in read-only memory, and no others"
arm-none-eabi-nm cross/image.elf >symbols
grep -q ' [rRtT] blob_as_c$' symbols || fail "$(cat symbols)"
grep -q ' [rRtT] blob_as_assembler$' symbols || fail "$(cat symbols)"
! grep -q 'unused' symbols || fail "$(cat symbols)"
readelf -SW cross/image.elf | awk '/ \.data/ { bad = 1 } END { exit bad }' || fail "$(readelf -SW cross/image.elf)"

finish
