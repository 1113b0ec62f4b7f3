// workload_here BLOB: asks on this machine what image/measure_main.cpp asks on a core, and prints the same line.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include <espalier/espalier.hpp>

#include "../platform/report.hpp"
#include "workload.hpp"

int main(int argument_count, char** arguments) {
    using namespace espalier;
    if (argument_count != 2) {
        std::fputs("usage: workload_here BLOB\n", stderr);
        return 1;
    }
    std::ifstream file(arguments[1], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    Blob blob;
    if (const Status status = open(std::as_bytes(std::span(bytes)), blob); status != Status::ok) {
        std::fprintf(stderr, "workload_here: %s: %s\n", arguments[1], describe(status));
        return 2;
    }
    const auto just_call = [](unsigned, FunctionRef<void()> call) { call(); };
    firmware::Workload workload(std::as_bytes(std::span(bytes)), blob, just_call);
    std::fputs(firmware::workload_line(workload.run({})).c_str(), stdout);
    return 0;
}
