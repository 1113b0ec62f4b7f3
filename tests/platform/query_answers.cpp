// query_answers QUESTIONS BLOB...: opens each blob, asks it, prints one line of answers for each. Uses the runtime and C
// streams only, so that it runs wherever a C++ compiler reaches.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

#include "answers.hpp"
#include "report.hpp"

namespace {

std::vector<std::byte> read_file(const char* path) {
    std::vector<std::byte> bytes;
    std::FILE* file = std::fopen(path, "rb");
    if (file == nullptr) return bytes;
    std::byte chunk[4096];
    for (std::size_t count = 0; (count = std::fread(chunk, 1, sizeof chunk, file)) > 0;) {
        bytes.insert(bytes.end(), chunk, chunk + count);
    }
    std::fclose(file);
    return bytes;
}

bool answer(const char* path, std::uint32_t questions_of_a_kind) {
    namespace platform = espalier::platform;
    const std::vector<std::byte> bytes = read_file(path);
    espalier::Blob blob;
    if (const espalier::Status status = espalier::open(bytes, blob); status != espalier::Status::ok) {
        std::fprintf(stderr, "%s: %s\n", path, espalier::describe(status));
        return false;
    }
    std::fputs(platform::report(platform::ask_everything(blob, questions_of_a_kind)).c_str(), stdout);
    return true;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count < 3) {
        std::fputs("usage: query_answers QUESTIONS BLOB...\n", stderr);
        return 1;
    }
    const auto questions_of_a_kind = static_cast<std::uint32_t>(std::strtoul(arguments[1], nullptr, 10));
    for (int index = 2; index < argument_count; ++index) {
        if (!answer(arguments[index], questions_of_a_kind)) return 2;
    }
    return 0;
}
