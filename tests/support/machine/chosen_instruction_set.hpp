// The instruction set that queries run on, chosen by a test, and the sets that tests may choose from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <runtime/lanes/select.hpp>

namespace espalier::tests {

/// Queries run on a given instruction set while this object lives. Where a program has only one set, it changes
/// nothing.
class ChosenInstructionSet {
public:
#if ESPALIER_X86
    explicit ChosenInstructionSet(detail::InstructionSet set) {
        detail::known_instruction_set = static_cast<std::uint8_t>(static_cast<unsigned>(set) + 1u);
    }
    ~ChosenInstructionSet() { detail::known_instruction_set = before_; }
#else
    explicit ChosenInstructionSet(detail::InstructionSet) {}
    ~ChosenInstructionSet() = default;
#endif
    ChosenInstructionSet(const ChosenInstructionSet&) = delete;
    ChosenInstructionSet& operator=(const ChosenInstructionSet&) = delete;

private:
#if ESPALIER_X86
    std::uint8_t before_ = detail::known_instruction_set;
#endif
};

const char* name_of(detail::InstructionSet set);

/// The instruction sets that this machine and this program have, the best one last. None is better than
/// ESPALIER_SET, where the environment has it.
const std::vector<detail::InstructionSet>& instruction_sets();
inline detail::InstructionSet best_instruction_set() { return instruction_sets().back(); }

/// Makes all queries run on ESPALIER_SET, where the environment has it, unless a test chooses a lesser set.
/// Returns what is wrong with it; else an empty text.
std::string force_instruction_set();

/// Calls the function once on each of instruction_sets().
template <class Function>
void on_each_instruction_set(Function function) {
    for (const detail::InstructionSet set : instruction_sets()) {
        const ChosenInstructionSet chosen(set);
        function();
    }
}

}  // namespace espalier::tests
