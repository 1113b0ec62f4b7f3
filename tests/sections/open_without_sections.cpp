// open_without_sections ok|unsupported_feature BLOB...: opens blobs by a runtime that reads no optional section
// (ESPALIER_SECTIONS). Exit status: 0 each gave that status, 1 another one did.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include <espalier/blob.hpp>

int main(int argument_count, char** arguments) {
    using espalier::OpenStatus;
    if (argument_count < 3) return 1;
    const OpenStatus expected = std::strcmp(arguments[1], "ok") == 0 ? OpenStatus::ok : OpenStatus::unsupported_feature;
    bool all = true;
    for (int i = 2; i < argument_count; ++i) {
        std::ifstream file(arguments[i], std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        const OpenStatus status = espalier::open(std::as_bytes(std::span(bytes))).status();
        if (status == expected) continue;
        std::printf("%s: status %d, expected %d\n", arguments[i], static_cast<int>(status), static_cast<int>(expected));
        all = false;
    }
    return all ? 0 : 1;
}
