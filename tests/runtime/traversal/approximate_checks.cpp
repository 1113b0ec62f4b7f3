#include "approximate_checks.hpp"

#include <runtime/answers/nearest_to_local.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>

#include "support/machine/instruction_paths.hpp"

namespace espalier::tests {

namespace {

constexpr double root_of_3 = 1.7320508075688774;

/// From below a step to all of the asset.
float some_accuracy(ShapeMaker& maker) {
    return std::ldexp(maker.size() * maker.random().unit(), -maker.random().between(0, 10));
}

/// Whether any triangle is within that many lattice steps of the part of the ray that counts.
bool passes_within(const Asked& asked, const detail::LatticeRay& ray, double steps) {
    // Of the ray what is within the asset's box, grown: nothing else is that near.
    double first = static_cast<double>(ray.tau_min), last = static_cast<double>(ray.tau_max);
    double origin[3];
    for (unsigned k = 0; k < 3; ++k) {
        origin[k] = std::ldexp(static_cast<double>(ray.origin[k]), -ray.fraction_bits);
        const double low = -steps - 1.0 - origin[k], high = asked.extent[k] + steps + 1.0 - origin[k];
        if (ray.direction[k] == 0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double one = low / ray.direction[k], other = high / ray.direction[k];
        first = std::max(first, std::min(one, other));
        last = std::min(last, std::max(one, other));
    }
    if (first > last) return false;
    detail::DistantSegment part;
    part.segment.fraction_bits = 6;
    for (unsigned k = 0; k < 3; ++k) {
        const auto unit_of = [&](double tau) {
            return std::llround(std::ldexp(origin[k] + tau * ray.direction[k], 6));
        };
        part.segment.from[k] = unit_of(first);
        part.segment.to[k] = unit_of(last);
        part.segment.from_steps[k] = std::ldexp(static_cast<float>(part.segment.from[k]), -6);
        part.segment.to_steps[k] = std::ldexp(static_cast<float>(part.segment.to[k]), -6);
    }
    part.segment.from_steps[3] = part.segment.to_steps[3] = 0.0f;
    prepare(part);
    part.radius = static_cast<float>(steps * (1.0 + 0x1p-20) + 0.05);  // the ends were rounded
    return asked.loop.closest_pair(part).has_value();
}

}  // namespace

void check_sphere(Asked& asked, bool awkward, Tally& tally) {
    const Sphere sphere = awkward ? asked.queries.sphere() : asked.queries.random_sphere();
    const float accuracy = some_accuracy(asked.maker);
    CAPTURE(describe(sphere));
    CAPTURE(accuracy);
    detail::RoundedPoint rounded;
    if (detail::round_point(detail::data_of(asked.blob), sphere.center, sphere.radius, rounded) != QueryStatus::ok) {
        REQUIRE(overlaps(asked.blob, sphere, Accuracy{accuracy}).no());
        return;
    }
    const bool exact = asked.loop.closest_within(rounded).has_value();
    const bool maybe = overlaps(asked.blob, sphere, Accuracy{accuracy}).yes();
    if (exact) REQUIRE(maybe);
    if (maybe && !exact) {
        const double more = asked.steps(accuracy) * root_of_3;
        rounded.radius =
            static_cast<float>(static_cast<double>(rounded.radius) * (1.0 + 0x1p-18) + more * (1.0 + 0x1p-22));
        REQUIRE(asked.loop.closest_within(rounded).has_value());
    }
    REQUIRE(overlaps(asked.blob, sphere, Accuracy{0.0f}).yes() == exact);
    tally.add(maybe, exact);
}

void check_box(Asked& asked, bool awkward, Tally& tally) {
    const Box box = asked.maker.box(awkward);
    const float accuracy = some_accuracy(asked.maker);
    CAPTURE(describe(box));
    CAPTURE(accuracy);
    detail::Rounded<Box> rounded;
    if (detail::round_volume(detail::data_of(asked.blob), box, rounded) != QueryStatus::ok) {
        REQUIRE(overlaps(asked.blob, box, Accuracy{accuracy}).no());
        return;
    }
    const bool exact = !asked.loop.every_overlap(rounded).empty();
    const bool maybe = overlaps(asked.blob, box, Accuracy{accuracy}).yes();
    if (exact) REQUIRE(maybe);
    if (maybe && !exact) {
        for (std::int64_t& half : rounded.half)
            half += static_cast<std::int64_t>(asked.steps(accuracy)) << detail::Rounded<Box>::fraction_bits;
        REQUIRE_FALSE(asked.loop.every_overlap(rounded).empty());
    }
    REQUIRE(overlaps(asked.blob, box, Accuracy{0.0f}).yes() == exact);
    tally.add(maybe, exact);
}

void check_ray(Asked& asked, bool awkward, Tally& tally) {
    Ray ray = awkward ? asked.queries.any_ray() : asked.queries.ray(RayKind::incoherent);
    if (asked.maker.random().coin()) asked.queries.restrict(ray);
    ray.culling = FaceCulling::none;
    const float accuracy = some_accuracy(asked.maker);
    CAPTURE(describe(ray));
    CAPTURE(accuracy);
    detail::LatticeRay rounded;
    if (!detail::round_ray(detail::data_of(asked.blob), ray, rounded)) {
        REQUIRE_FALSE(occluded(asked.blob, ray, Accuracy{accuracy}).yes());
        return;
    }
    const bool exact = !asked.loop.every_hit(rounded).empty();
    const bool maybe = occluded(asked.blob, ray, Accuracy{accuracy}).yes();
    if (exact) REQUIRE(maybe);
    if (maybe && !exact) REQUIRE(passes_within(asked, rounded, asked.steps(accuracy) * root_of_3));
    REQUIRE(occluded(asked.blob, ray, Accuracy{0.0f}).yes() == exact);
    tally.add(maybe, exact);
}

void check_bounds(Asked& asked, bool awkward, Tally& tally) {
    const Sphere sphere = awkward ? asked.queries.sphere() : asked.queries.random_sphere();
    const float accuracy = asked.maker.random().below(4) == 0 ? 0.0f : some_accuracy(asked.maker);
    CAPTURE(describe(sphere));
    CAPTURE(accuracy);
    const Result<DistanceBounds> result = distance_bounds(asked.blob, sphere.center, sphere.radius, Accuracy{accuracy});
    const DistanceBounds& bounds = *result;
    const bool has_bounds{result};
    detail::RoundedPoint rounded;
    const QueryStatus status = detail::round_point(detail::data_of(asked.blob), sphere.center, sphere.radius, rounded);
    const bool is_near = status == QueryStatus::ok;
    if (!is_near) REQUIRE(result.status == status);
    if (!has_bounds) {
        REQUIRE(bounds.lower == 0.0f);
        REQUIRE(bounds.upper == infinity);
    }
    const bool found = is_near && asked.loop.closest_within(rounded).has_value();
    if (found) REQUIRE(has_bounds);
    if (accuracy == 0.0f) REQUIRE(has_bounds == found);
    if (!has_bounds) return;
    REQUIRE(bounds.lower <= sphere.radius);
    REQUIRE(bounds.lower <= bounds.upper);
    const auto lower = static_cast<double>(bounds.lower), upper = static_cast<double>(bounds.upper);
    REQUIRE(upper <= lower + static_cast<double>(accuracy) * root_of_3 + upper * 0x1p-16);
    // However far it may be.
    REQUIRE(detail::round_point(detail::data_of(asked.blob), sphere.center, infinity, rounded) == QueryStatus::ok);
    const auto closest = asked.loop.closest_within(rounded);
    REQUIRE(closest.has_value());
    const float distance = detail::to_local_distance(detail::data_of(asked.blob), closest->distance.squared,
                                                     rounded.distance_offset, infinity);
    if (bounds.lower < sphere.radius) REQUIRE(bounds.lower <= distance);
    REQUIRE(distance <= bounds.upper);
    tally.add(true, bounds.upper <= bounds.lower * 1.01f);
}

void check_instruction_sets(Asked& asked, bool awkward, Tally&) {
    auto& [blob, decoded, extent, loop, maker, queries] = asked;
    const Sphere sphere = awkward ? queries.sphere() : queries.random_sphere();
    const Ray ray = awkward ? queries.any_ray() : queries.ray(RayKind::incoherent);
    const std::int32_t steps = detail::steps_in(detail::data_of(blob), some_accuracy(maker));
    detail::RoundedPoint rounded;
    if (detail::round_point(detail::data_of(blob), sphere.center, sphere.radius, rounded) != QueryStatus::ok) return;
    QueryCounters first;
    const InstructionPath& scalar = instruction_paths().front();
    const bool overlap = scalar.may_overlap(detail::data_of(blob), rounded, steps, first);
    const detail::SquaredBounds bounds = scalar.closest_bounds(detail::data_of(blob), rounded, steps, first);
    const bool hit = scalar.may_hit(detail::data_of(blob), ray, {steps, &first}).yes();
    for (const InstructionPath& path : instruction_paths()) {
        QueryCounters counters;
        REQUIRE(path.may_overlap(detail::data_of(blob), rounded, steps, counters) == overlap);
        const detail::SquaredBounds again = path.closest_bounds(detail::data_of(blob), rounded, steps, counters);
        REQUIRE(again.lower == bounds.lower);
        REQUIRE(again.upper == bounds.upper);
        REQUIRE(path.may_hit(detail::data_of(blob), ray, {steps, &counters}).yes() == hit);
    }
}

}  // namespace espalier::tests
