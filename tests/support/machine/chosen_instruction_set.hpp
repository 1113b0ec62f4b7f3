// The instruction set that queries run on, chosen by a test.
#pragma once

#include <cstdint>

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

/// Calls the function once on each instruction set that this machine and this program have.
template <class Function>
void on_each_instruction_set(Function function) {
#if ESPALIER_X86
    const auto best = static_cast<std::uint8_t>(detail::detect_instruction_set());
    for (std::uint8_t set = 0; set <= best; ++set) {
        const ChosenInstructionSet chosen{static_cast<detail::InstructionSet>(set)};
        function();
    }
#else
    function();
#endif
}

}  // namespace espalier::tests
