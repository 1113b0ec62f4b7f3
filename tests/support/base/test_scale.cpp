#include "test_scale.hpp"

#include <algorithm>
#include <cstdlib>

#include "sanitized.hpp"

namespace espalier::tests {

std::uint64_t scaled(std::uint64_t count) {
    static const double factor = [] {
        const char* text = std::getenv("ESPALIER_TEST_SCALE");
        const double asked = text != nullptr ? std::strtod(text, nullptr) : 1.0;
        constexpr double slowdown = sanitized ? 8.0 : 1.0;
        return (asked > 0.0 ? asked : 1.0) / slowdown;
    }();
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(static_cast<double>(count) * factor));
}

}  // namespace espalier::tests
