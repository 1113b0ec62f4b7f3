#include "chosen_instruction_set.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace espalier::tests {

namespace {

using detail::InstructionSet;

constexpr const char* names[] = {"scalar", "sse42", "avx2", "avx512", "neon", "simd128"};  // by the set

/// The sets of the machine and the program, whatever the environment.
std::vector<InstructionSet> all_sets() {
#if ESPALIER_X86
    std::vector<InstructionSet> sets;
    for (unsigned i = 0; i <= static_cast<unsigned>(detail::detect_instruction_set()); ++i)
        if (const auto set = static_cast<InstructionSet>(i); detail::is_built(set)) sets.push_back(set);
    return sets;
#else
    return {detail::instruction_set()};
#endif
}

/// What the environment asks for, or null.
const char* asked() {
    const char* const name = std::getenv("ESPALIER_SET");
    return name == nullptr || *name == '\0' ? nullptr : name;
}

auto find_by_name(const std::vector<InstructionSet>& sets, const std::string& name) {
    return std::find_if(sets.begin(), sets.end(), [&](InstructionSet set) { return name == name_of(set); });
}

}  // namespace

const char* name_of(InstructionSet set) { return names[static_cast<unsigned>(set)]; }

const std::vector<InstructionSet>& instruction_sets() {
    static const std::vector<InstructionSet> sets = [] {
        std::vector<InstructionSet> up_to = all_sets();
        if (const char* const name = asked(); name != nullptr)
            if (const auto best = find_by_name(up_to, name); best != up_to.end()) up_to.erase(best + 1, up_to.end());
        return up_to;
    }();
    return sets;
}

std::string force_instruction_set() {
    const char* const name = asked();
    if (name == nullptr) return {};
    const std::vector<InstructionSet> sets = all_sets();
    const auto found = find_by_name(sets, name);
    if (found == sets.end()) {
        const bool is_known = std::find(std::begin(names), std::end(names), std::string(name)) != std::end(names);
        std::string message = std::string("ESPALIER_SET is ") + name + ", which " +
                              (is_known ? "this machine or this program does not have" : "is no instruction set") +
                              "; it can be:";
        for (const InstructionSet set : sets) message += std::string(" ") + name_of(set);
        return message;
    }
#if ESPALIER_X86
    detail::known_instruction_set = static_cast<std::uint8_t>(static_cast<unsigned>(*found) + 1u);
#endif
    return {};
}

}  // namespace espalier::tests
