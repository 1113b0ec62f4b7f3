#!/usr/bin/env bash
# plain_words.sh PROJECT: public text has none of the words below: documents, public headers, messages, help, test names,
# and comments of the library, the command, the examples, the scripts and CMake files.
# Each has a plainer word: what code does (returns, stores, tests, contains), or the noun of the field.
set -euo pipefail

words=(
    'ask(s|ed|ing)?' tells told says said sees 'kn(ows|ew)' 'believe[sd]' # code does none of these
    'dear(er|est|ly)?'                                                   # expensive, large, slow
    whoever besides likewise 'nobody needs?'                             # name it; also; in the same way; not required
    'of its own accord' 'as it is now'
    'what (is beside|stands|says)' 'who (asks|says)'                     # the noun
)
pattern=$(IFS='|'; echo "${words[*]}")
grep -qwiE "$pattern" <<<"code is dearer than time" || { echo "failed: the pattern finds nothing"; exit 1; }

cd "$1"
# The lines that people read, each as FILE:LINE:TEXT.
public_text() {
    grep -rHn '' README.md SECURITY.md tests/README.md docs tools lib bench/results/*.md --include=*.md --include=*.h --include=*.ld \
        --include=*.hpp --include=*.sh --include=*.c --include=*.cpp --include=*.inl --include=*.py --include=*.1
    grep -rHn '#' CMakeLists.txt docs lib tools tests bench fuzz --include=CMakeLists.txt --include=*.cmake --include=*.cmake.in
    grep -rHnE 'TEST_CASE[A-Z_]*\(' tests --include=*.cpp --include=*.hpp --include=*.c
    grep -rHnE 'add_test\(NAME' tests bench fuzz --include=CMakeLists.txt --include=*.cmake
}

checked=$(public_text | wc -l)
[[ $checked -gt 5000 ]] || { echo "failed: only $checked lines were found"; exit 1; }
if public_text | grep -wiE "$pattern"; then
    echo "failed: these lines have words that docs/contributing.md, Rules, advises against"
    exit 1
fi
