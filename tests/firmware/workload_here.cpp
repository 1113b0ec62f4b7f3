// workload_here every|usual|scene|moving|refit BLOB: asks on this machine what image/measure_main.cpp asks on a core,
// and prints the same line.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

#include "ask.hpp"

namespace {

using namespace espalier;

constexpr auto just_call = [](firmware::Kind, FunctionRef<void()> call) { call(); };

}  // namespace

int main(int argument_count, char** arguments) {
    using Ask = firmware::Asked (*)(std::span<const std::byte>, const decltype(just_call)&);
    constexpr struct {
        std::string_view name;
        Ask ask;
    } workloads[] = {{"every", firmware::ask_blob<true>},
                     {"usual", firmware::ask_blob<false>},
                     {"scene", firmware::ask_scene},
                     {"moving", firmware::ask_moving},
                     {"refit", firmware::ask_refit}};
    for (const auto& workload : workloads) {
        if (argument_count != 3 || arguments[1] != workload.name) continue;
        std::ifstream file(arguments[2], std::ios::binary);
        const std::vector<char> characters{std::istreambuf_iterator<char>(file), {}};
        const firmware::Asked asked = workload.ask(std::as_bytes(std::span(characters)), just_call);
        if (asked.status != OpenStatus::ok) {
            std::fprintf(stderr, "workload_here: %s: %s\n", arguments[2], describe(asked.status));
            return 2;
        }
        std::fputs(firmware::workload_line(asked.answers).c_str(), stdout);
        return 0;
    }
    std::fputs("usage: workload_here every|usual|scene|moving|refit BLOB\n", stderr);
    return 1;
}
