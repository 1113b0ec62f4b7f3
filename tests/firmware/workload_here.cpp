// workload_here every|usual BLOB: asks on this machine what image/measure_main.cpp asks on a core, and prints the same
// line.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include <espalier/espalier.hpp>

#include "../platform/report.hpp"
#include "workload.hpp"

int main(int argument_count, char** arguments) {
    using namespace espalier;
    const bool every = argument_count == 3 && std::strcmp(arguments[1], "every") == 0;
    if (argument_count != 3 || (!every && std::strcmp(arguments[1], "usual") != 0)) {
        std::fputs("usage: workload_here every|usual BLOB\n", stderr);
        return 1;
    }
    std::ifstream file(arguments[2], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    const Blob blob = open(std::as_bytes(std::span(bytes)));
    if (!blob) {
        std::fprintf(stderr, "workload_here: %s: %s\n", arguments[2], describe(blob.status()));
        return 2;
    }
    const auto just_call = [](unsigned, FunctionRef<void()> call) { call(); };
    firmware::Workload workload(std::as_bytes(std::span(bytes)), blob, just_call);
    workload.ask_usual({});
    if (every) workload.ask_others({});
    std::fputs(firmware::workload_line(workload.answers()).c_str(), stdout);
    return 0;
}
