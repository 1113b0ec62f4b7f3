#include "test_scale.hpp"

#include <algorithm>
#include <cstdlib>

#include "random.hpp"
#include "sanitized.hpp"

namespace espalier::tests {

namespace {

double asked_scale() {
    static const double scale = [] {
        const char* text = std::getenv("ESPALIER_TEST_SCALE");
        const double asked = text != nullptr ? std::strtod(text, nullptr) : 1.0;
        return asked > 0.0 ? asked : 1.0;
    }();
    return scale;
}

}  // namespace

std::uint64_t scaled(std::uint64_t count) {
    const double factor = sanitized ? asked_scale() / 8.0 : asked_scale();
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(static_cast<double>(count) * factor));
}

bool takes_every_case() { return asked_scale() >= 1.0; }

std::vector<std::size_t> sampled(std::size_t count, std::size_t group, std::uint64_t seed) {
    if (takes_every_case()) group = 1;
    Random random(seed);
    std::vector<std::size_t> taken;
    for (std::size_t first = 0; first < count; first += group)
        taken.push_back(first + random.below(static_cast<std::uint32_t>(std::min(group, count - first))));
    return taken;
}

}  // namespace espalier::tests
