#include <baker/scenes/common_lattice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <espalier/format.hpp>
#include <runtime/lattice/region.hpp>

#include <baker/base/float_rounding.hpp>

namespace espalier::baker {

namespace {

using LatticeOfPart = std::optional<espalier::Lattice>;

bool lies_in(const espalier::Lattice& region, const Instance& instance, const LatticeOfPart& lattice) {
    espalier::Lattice local = region;
    std::int32_t steps[3] = {};
    return lattice && detail::move_region(instance.transform, local) == QueryStatus::ok &&
           detail::find_in_region(*lattice, local, steps) == QueryStatus::ok;
}

/// Returns whether the transform moves by whole steps of the lattice and does nothing else.
bool moves_by_whole_steps(const Instance& instance, const LatticeOfPart& lattice) {
    if (!lattice) return false;
    espalier::Lattice at_zero;
    at_zero.step_exponent = lattice->step_exponent;
    return detail::move_region(instance.transform, at_zero) == QueryStatus::ok;
}

/// Returns the step exponent that most of the instances have which move by whole steps, of equally many the lowest.
/// None if there are no such instances.
std::optional<int> most_frequent_step(std::span<const Instance> instances, std::span<const LatticeOfPart> lattices) {
    std::map<int, std::size_t> counts;
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (moves_by_whole_steps(instances[i], lattices[i])) ++counts[lattices[i]->step_exponent];
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == counts.end()) return std::nullopt;
    return most->first;
}

}  // namespace

std::optional<CommonLattice> find_common_lattice(std::span<const Instance> instances,
                                                 std::span<const LatticeOfPart> lattices) {
    const std::optional<int> exponent = most_frequent_step(instances, lattices);
    if (!exponent) return std::nullopt;
    const double step = std::ldexp(1.0, *exponent);
    std::array<double, 3> low{}, high{};
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!moves_by_whole_steps(instances[i], lattices[i]) || lattices[i]->step_exponent != *exponent) continue;
        const espalier::Lattice& lattice = *lattices[i];
        const Vec3 &origin = lattice.origin, &by = instances[i].transform.translation;
        const std::array<double, 3> at = {double(origin.x) + double(by.x), double(origin.y) + double(by.y),
                                          double(origin.z) + double(by.z)};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(at[k], low[k]);
            high[k] = std::max(at[k] + lattice.extent[k] * step, high[k]);
        }
    }
    CommonLattice common;
    common.region.step_exponent = *exponent;
    float* const origin[3] = {&common.region.origin.x, &common.region.origin.y, &common.region.origin.z};
    for (std::size_t k = 0; k < 3; ++k) {
        // A float that is rounded to more than a step is a multiple of the step as well.
        *origin[k] = round_down_to_float(low[k]) + 0.0f;
        const double extent = (high[k] - double(*origin[k])) / step;
        if (!(extent <= detail::most_steps)) return std::nullopt;
        common.region.extent[k] = static_cast<std::int32_t>(extent);
    }
    for (std::size_t i = 0; i < instances.size(); ++i)
        common.instances += lies_in(common.region, instances[i], lattices[i]);
    if (common.instances == 0) return std::nullopt;
    return common;
}

}  // namespace espalier::baker
