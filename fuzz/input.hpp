// What a fuzz target takes its values from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace espalier::fuzz {

/// Takes values off the front of the input; zeros when it is used up.
class Input {
public:
    explicit Input(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
    [[nodiscard]] bool empty() const { return rest_.empty(); }
    template <class Value>
    Value take() {
        Value value = {};
        const std::size_t size = rest_.size() < sizeof value ? rest_.size() : sizeof value;
        if (size != 0) std::memcpy(&value, rest_.data(), size);
        rest_ = rest_.subspan(size);
        return value;
    }
    std::uint8_t byte() { return take<std::uint8_t>(); }
    std::size_t below(std::size_t limit) { return byte() % limit; }

private:
    std::span<const std::uint8_t> rest_;
};

}  // namespace espalier::fuzz
