# To be sourced: runs an image under QEMU with plugin/query_meter.cpp looking on.

# build_meter FOLDER: the plugin in that folder, for this QEMU: until version 8 it takes interface 1, since then 2.
build_meter() {
    local source major
    source=$(dirname "${BASH_SOURCE[0]}")/plugin/query_meter.cpp
    [[ ! $1/query_meter.so -nt $source ]] || return 0
    major=$(qemu-system-arm --version | sed -nE '1s/.*version ([0-9]+).*/\1/p')
    "${CXX:-c++}" -std=c++20 -O2 -shared -fPIC -DQUERY_METER_PLUGIN_VERSION=$((major < 9 ? 1 : 2)) \
        -o "$1/query_meter.so" "$source"
}

# run_metered BOARD IMAGE PLUGIN: prints what the image prints, then what the plugin found. Its exit status is the image's.
run_metered() {
    local symbols ranges
    symbols=$(arm-none-eabi-nm "$2")
    address_of() { awk -v name="$1" '$3 == name { print "0x" $1 }' <<<"$symbols"; }
    size_of() { echo $(($(address_of "$2") - $(address_of "$1"))); }
    ranges=marks=$(address_of firmware_marks)
    ranges+=,blob=$(address_of firmware_blob),blob_size=$(size_of firmware_blob firmware_blob_end)
    ranges+=,stack=$(address_of image_bss_end),stack_size=$(size_of image_bss_end image_stack_top)
    timeout 600 qemu-system-arm -M "$1" -nographic -monitor none -serial null \
        -semihosting-config enable=on,target=native -kernel "$2" -d plugin -plugin "$3,$ranges" </dev/null 2>&1
}
