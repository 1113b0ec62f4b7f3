// What a child process covered, told to its parent, which is the one that the fuzzer looks at.
#pragma once

#include <cstddef>

namespace espalier::fuzz {

/// Made by the parent, before it forks. Does nothing where nothing is instrumented, nor for AFL++, which shares its
/// own.
class SharedCoverage {
public:
    SharedCoverage();
    /// By the child, before it ends.
    void hand_over() const;
    /// By the parent, after that.
    void take() const;

private:
    std::size_t size_;
    char* memory_ = nullptr;
};

}  // namespace espalier::fuzz
