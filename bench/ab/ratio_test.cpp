#include <doctest/doctest.h>

#include "ratio.hpp"

namespace {

using namespace espalier::bench;

void check(const char* what, double got, double expected) {
    INFO(what);
    CHECK(got == doctest::Approx(expected).epsilon(1e-9));
}

/// Loads, placements, parts and visits of a base that takes 1 + part and an other that takes `factor` of it.
std::vector<TimesOfLoad> times_of(double factor) {
    std::vector<TimesOfLoad> times(3);
    for (TimesOfLoad& load : times)
        for (auto& placement : load)
            for (std::size_t part = 0; part < 4; ++part) {
                const double base = 1.0 + static_cast<double>(part);
                placement.emplace_back(5, PairOfTimes{base, factor * base});
            }
    return times;
}

}  // namespace

TEST_CASE("bench: a minority of disturbed measurements does not move a ratio") {
    check("median of an odd number", median({3.0, 1.0, 2.0}), 2.0);
    check("median of an even number", median({4.0, 1.0, 2.0, 3.0}), 2.5);

    const Ratio slower = ratio_of(times_of(1.25));
    check("a constant ratio", slower.median, 1.25);
    check("the range of a constant ratio", slower.high - slower.low, 0.0);
    check("the time of the base", slower.base_seconds, 1.0 + 2.0 + 3.0 + 4.0);

    auto disturbed = times_of(1.25);
    for (TimesOfLoad& load : disturbed)
        for (auto& placement : load)
            for (auto& part : placement) part[0].base *= 7.0, part[3].other *= 9.0;
    check("two disturbed measurements of five", ratio_of(disturbed).median, 1.25);

    auto placed = times_of(1.25);
    for (TimesOfLoad& load : placed) {
        for (auto& part : load[0])
            for (PairOfTimes& pair : part) pair.base *= 1.5;
        for (auto& part : load[1])
            for (PairOfTimes& pair : part) pair.other *= 1.5;
    }
    check("a place of the bytes that is slower", ratio_of(placed).median, 1.25);

    auto one_load = times_of(1.25);
    for (auto& placement : one_load[1])
        for (auto& part : placement)
            for (PairOfTimes& pair : part) pair.other *= 2.0;
    const Ratio with_one = ratio_of(one_load);
    check("one load that is slower", with_one.median, 1.25);
    check("one load that is slower as the largest", with_one.high, 2.5);

    auto scattered = times_of(1.0);
    for (std::size_t i = 0; i < scattered.size(); ++i)
        for (auto& placement : scattered[i])
            for (auto& part : placement) part = {{1.0, 1.5}, {1.5, 1.0}};
    check("noise alone", ratio_of(scattered).median, 1.0);
}
