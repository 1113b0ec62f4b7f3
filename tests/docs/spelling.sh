#!/usr/bin/env bash
# spelling.sh PROJECT: public text has no word twice in a row and none that is commonly misspelt: documents, headers, messages, help,
# test names and comments.
set -euo pipefail

small='a|an|the|of|to|in|is|are|and|or|for|with|by|it|that|which|as|at|on|from|be|not|has|have|this|its'
misspelt='accomodate|acheive|adress|alot|appearence|arbitary|begining|calender|comparision|definately|devide|existance|explicitely'
misspelt+='|guarentee|immediatly|independant|intial|lenght|neccessary|occured|occurence|paramter|posible|precission|priviledge|recieve'
misspelt+='|seperate|sucessful|succesful|supress|threshhold|untill|wich'
pattern="(?<![\w.])($small) \1(?![\w(.])|\b($misspelt)\w{0,3}\b"
for wrong in 'points at the the root' 'recieves a ray'; do
    grep -qP "$pattern" <<<"$wrong" || { echo "failed: the pattern does not find '$wrong'"; exit 1; }
done

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
if public_text | grep -P "$pattern"; then
    echo "failed: these lines have a word twice in a row, or one that is misspelt"
    exit 1
fi
