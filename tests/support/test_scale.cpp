#include "test_scale.hpp"

#include <algorithm>
#include <cstdlib>

namespace espalier::tests {

std::uint64_t scaled(std::uint64_t count) {
    static const double factor = [] {
        const char* text = std::getenv("ESPALIER_TEST_SCALE");
        const double asked = text != nullptr ? std::strtod(text, nullptr) : 1.0;
#if defined(__SANITIZE_ADDRESS__)
        constexpr double slowdown = 8.0;
#else
        constexpr double slowdown = 1.0;
#endif
        return (asked > 0.0 ? asked : 1.0) / slowdown;
    }();
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(static_cast<double>(count) * factor));
}

}  // namespace espalier::tests
