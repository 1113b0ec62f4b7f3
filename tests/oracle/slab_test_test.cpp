// The slab test of every instruction set against exact arithmetic: no box that a ray meets is refused, no key is larger
// than where the ray enters, and boxes that are passed at more than twice the slack are refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstdint>
#include <limits>
#include <vector>

#include <runtime/rays/queries.hpp>
#define ESPALIER_FRAGMENT "oracle/slab_children.hpp"
#include <runtime/lanes/for_each_set.hpp>

#include "rational.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/chosen_instruction_set.hpp"

using namespace espalier;
using namespace espalier::tests;
using oracle::Rational;

namespace {

/// Which children an instruction set visits, and their keys; none where the ray is found to hit nothing before.
template <class Node>
struct Path {
    const char* name;
    unsigned (*children)(const detail::BlobData&, const Ray&, const Node&, float limit, float* keys);
};

template <class Node>
std::vector<Path<Node>> paths() {
    std::vector<Path<Node>> result = {{"scalar", detail::scalar::children_as_defined<Node>}};
#if ESPALIER_X86
    const detail::InstructionSet best = best_instruction_set();
    if (best >= detail::InstructionSet::sse42) result.push_back({"sse42", detail::sse42::children<Node>});
#if ESPALIER_HAS_AVX2
    if (best >= detail::InstructionSet::avx2) {
        result.push_back({"avx2", detail::avx2::children<Node>});
        result.push_back({"avx2 as defined", detail::avx2::children_as_defined<Node>});
    }
#endif
#if ESPALIER_HAS_AVX512
    if (best >= detail::InstructionSet::avx512) result.push_back({"avx512", detail::avx512::children<Node>});
#endif
#elif ESPALIER_NEON
    result.push_back({"neon", detail::neon::children<Node>});
    result.push_back({"neon as defined", detail::neon::children_as_defined<Node>});
#elif ESPALIER_SIMD128
    result.push_back({"simd128", detail::simd128::children<Node>});
    result.push_back({"simd128 as defined", detail::simd128::children_as_defined<Node>});
#endif
    return result;
}

/// A node, and its boxes in lattice steps; no child's box begins outside of the asset.
template <class Node>
struct BoxedNode {
    static constexpr unsigned most_children = Node::max_children;
    std::array<std::byte, Node::size> bytes{};
    unsigned children = 0;
    std::int64_t low[most_children][3] = {}, high[most_children][3] = {};

    void put_word(std::size_t at, std::uint32_t word) {
        bytes[at] = static_cast<std::byte>(word & 255);
        bytes[at + 1] = static_cast<std::byte>(word >> 8);
    }
};

void make_boxes(Random& random, const detail::BlobData& blob, BoxedNode<detail::PackedNode>& node) {
    namespace layout = format::packed_node;
    const unsigned unit = blob.bits > 16 ? blob.bits - 16u : 0u;
    node.children = 1 + random.below(8);
    node.bytes[layout::children_at + 3] = static_cast<std::byte>(node.children << 4);
    unsigned shifts = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const auto extent = static_cast<std::uint32_t>(blob.extent[k]);
        const std::uint32_t from = random.coin() ? 0 : random.below(extent + 1) >> unit;
        const std::uint32_t reach = extent - (from << unit);
        const std::uint32_t part = reach >> (random.coin() ? 0 : random.below(12));
        unsigned shift = 0;
        while (255u << shift < part) ++shift;
        if (random.below(8) == 0) shift += random.below(layout::max_shift + 1 - shift);  // larger than it needs
        shifts |= shift << (5 * k);
        node.put_word(layout::base_at + 2 * k, from);
        for (unsigned child = 0; child < node.children; ++child) {
            const std::uint32_t low = random.below(std::min(255u, reach >> shift) + 1);
            const std::uint32_t high = random.below(4) == 0 ? low : low + random.below(256 - low);
            node.bytes[layout::lo_at + 8 * k + child] = static_cast<std::byte>(low);
            node.bytes[layout::hi_at + 8 * k + child] = static_cast<std::byte>(high);
            node.low[child][k] = (from << unit) + (std::int64_t{low} << shift);
            node.high[child][k] = (from << unit) + (std::int64_t{high} << shift);
        }
    }
    node.put_word(layout::shifts_at, shifts);
}

void make_boxes(Random& random, const detail::BlobData& blob, BoxedNode<detail::PlainNode>& node) {
    namespace layout = format::plain_node;
    const unsigned unit = blob.bits > 16 ? blob.bits - 16u : 0u;
    node.children = 1 + random.below(16);
    node.bytes[layout::leaf_children_at] = static_cast<std::byte>(node.children);
    for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t most = static_cast<std::uint32_t>(blob.extent[k]) >> unit;
        for (unsigned child = 0; child < node.children; ++child) {
            const std::uint32_t low = random.below(most + 1);
            const std::uint32_t side = (most - low) >> (random.coin() ? 0 : random.below(12));
            const std::uint32_t high = random.below(4) == 0 ? low : low + random.below(side + 1);
            node.put_word(layout::lo_at + 32 * k + 2 * child, low);
            node.put_word(layout::hi_at + 32 * k + 2 * child, high);
            node.low[child][k] = std::int64_t{low} << unit;
            node.high[child][k] = (std::int64_t{high + 1} << unit) - 1;
        }
    }
}

/// With a step of 1 and its lowest corner at 0; often much smaller than its lattice, where the roundings that depend on
/// the lattice alone are the largest.
detail::BlobData make_asset(Random& random, unsigned bits) {
    detail::BlobData blob;
    blob.triangle_count = 1;  // an empty one is not walked
    blob.bits = static_cast<std::uint8_t>(bits);
    const std::uint32_t most = (1u << (random.coin() ? bits : 1 + random.below(bits))) - 1;
    for (int k = 0; k < 3; ++k)
        blob.extent[k] = static_cast<std::int32_t>(random.coin() ? most : random.below(most + 1));
    blob.derive();
    return blob;
}

/// Its direction in [2^23, 2^24), so that t counts what tau counts: most often exactly through a corner of the box or a
/// point of it, and with components that are zero.
Ray make_ray(Random& random, const detail::BlobData& blob, const std::int64_t* low, const std::int64_t* high) {
    const int length = 1 + static_cast<int>(random.below(random.coin() ? 8 : 4096));
    int way[3];
    int longest = 0;
    while (longest == 0) {
        for (int& component : way) {
            component = random.below(4) == 0 ? 0 : random.between(-length, length);
            longest = std::max(longest, std::abs(component));
        }
    }
    int scale = 1;
    while (longest * scale < 1 << 23) scale *= 2;
    const double room = std::ldexp(1.0, static_cast<int>(random.below(random.below(8) == 0 ? 40 : 24)));
    const double times = std::max(1.0, std::floor(room * static_cast<double>(random.unit()) / longest));
    const double part = random.coin() ? 1.0 : 0.5;
    Ray ray;
    float* const origin[3] = {&ray.origin.x, &ray.origin.y, &ray.origin.z};
    float* const direction[3] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
    for (int k = 0; k < 3; ++k) {
        const std::int64_t end = std::min<std::int64_t>(high[k], blob.extent[k]);
        const std::int64_t inside = low[k] + random.below(static_cast<std::uint32_t>(end - low[k]) + 1);
        const std::int64_t target = random.below(4) == 0 ? inside : random.coin() ? low[k] : end;
        *origin[k] = static_cast<float>(static_cast<double>(target) - times * part * way[k]);
        *direction[k] = static_cast<float>(way[k]) * static_cast<float>(scale);
    }
    return ray;
}

struct Interval {
    Rational first = 0, last = 0;
    bool is_empty = false;
};

/// Where the ray is in the box, widened by `more` steps; from 0 on.
Interval interval(const detail::LatticeRay& ray, const std::int64_t* low, const std::int64_t* high,
                  const Rational& more) {
    Interval result;
    bool has_end = false;
    for (int k = 0; k < 3; ++k) {
        const Rational origin = Rational::of(std::int64_t{ray.origin[k]}, -ray.fraction_bits);
        const Rational from = Rational(low[k]) - more - origin, to = Rational(high[k]) + more - origin;
        if (ray.direction[k] == 0) {
            result.is_empty = result.is_empty || from.sign() > 0 || to.sign() < 0;
            continue;
        }
        const Rational way(std::int64_t{ray.direction[k]});
        const Rational a = from / way, b = to / way;
        result.first = std::max(result.first, std::min(a, b));
        result.last = has_end ? std::min(result.last, std::max(a, b)) : std::max(a, b);
        has_end = true;
    }
    result.is_empty = result.is_empty || result.last < result.first;
    return result;
}

/// The largest float that is not above a number that is not negative.
float float_at_most(const Rational& number) {
    if (number.sign() == 0) return 0.0f;
    float result = std::ldexp(1.0f, number.exponent());
    for (float step = result * 0.5f; step > result * 0x1p-25f; step *= 0.5f)
        if (Rational::of(result + step) <= number) result += step;
    return result;
}

/// How far the asset is from the ray's origin at most, along any axis.
double reach(const detail::BlobData& blob, const detail::LatticeRay& ray) {
    double result = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const double origin = static_cast<double>(detail::origin_steps(ray, k));
        result = std::max({result, std::abs(origin), std::abs(blob.extent[k] - origin)});
    }
    return result;
}

struct Counts {
    std::uint64_t met = 0, passed = 0;
};

template <class Node>
void check(Random& random, unsigned bits, Counts& counts) {
    constexpr unsigned most_children = Node::max_children;
    const detail::BlobData blob = make_asset(random, bits);
    BoxedNode<Node> boxed;
    make_boxes(random, blob, boxed);
    const Node node = {boxed.bytes.data()};
    const unsigned aim = random.below(boxed.children);
    Ray world = make_ray(random, blob, boxed.low[aim], boxed.high[aim]);

    detail::LatticeRay ray;
    if (!detail::round_ray(blob, world, ray)) return;
    std::int64_t met_high[most_children][3];
    std::vector<Interval> exact;
    for (unsigned child = 0; child < boxed.children; ++child) {
        for (int k = 0; k < 3; ++k) met_high[child][k] = std::min<std::int64_t>(boxed.high[child][k], blob.extent[k]);
        exact.push_back(interval(ray, boxed.low[child], met_high[child], 0));
    }
    // The window ends where the ray enters the box, or begins where it leaves it.
    float limit = std::numeric_limits<float>::infinity();
    if (!exact[aim].is_empty && random.coin()) {
        if (random.coin()) limit = std::nextafter(float_at_most(exact[aim].first), limit);
        else world.t_min = float_at_most(exact[aim].last);
        if (!detail::round_ray(blob, world, ray)) return;
    }
    const Rational tau_min = Rational::of(ray.tau_min);
    const auto meets = [&](const Interval& in) {
        return !in.is_empty && tau_min <= in.last && (std::isinf(limit) || in.first <= Rational::of(limit)) &&
               (std::isinf(limit) || tau_min <= Rational::of(limit));
    };
    const Rational slack = Rational::of(static_cast<std::int64_t>(std::ceil((reach(blob, ray) + 1) * 64)), -26) +
                           Rational::of(3, static_cast<int>(bits) - 22) +
                           (most_children == 16 && bits > 16 ? Rational((1 << (bits - 16)) - 1) : Rational(0));
    for (const Path<Node>& path : paths<Node>()) {
        CAPTURE(path.name);
        CAPTURE(bits);
        float keys[most_children];
        const unsigned mask = path.children(blob, world, node, limit, keys);
        REQUIRE((mask >> boxed.children) == 0);
        for (unsigned child = 0; child < boxed.children; ++child) {
            CAPTURE(child);
            const bool is_met = meets(exact[child]);
            if (is_met) {
                REQUIRE((mask >> child & 1) != 0);
                REQUIRE(Rational::of(keys[child]) <= std::max(exact[child].first, tau_min));
            }
            if ((mask >> child & 1) != 0) {
                REQUIRE(!std::signbit(keys[child]));
                REQUIRE(keys[child] <= limit);
            }
            counts.met += is_met ? 1 : 0;
            // What is outside of the lattice may be moved outward by more.
            const bool is_inside = std::equal(boxed.high[child], boxed.high[child] + 3, met_high[child]);
            if (is_met || !is_inside) continue;
            if (!meets(interval(ray, boxed.low[child], met_high[child], 2 * slack))) {
                ++counts.passed;
                REQUIRE((mask >> child & 1) == 0);
            }
        }
    }
}

}  // namespace

TEST_SUITE("slab test") {
    TEST_CASE("ray: no box that a ray meets is refused and none that it clearly passes is visited") {
        const auto check_kind = []<class Node>() {
            for (unsigned bits = 1; bits <= format::max_bits; ++bits) {
                Counts counts;
                const std::uint64_t rounds = std::max<std::uint64_t>(40, scaled(200));
                for (std::uint64_t i = 0; i < rounds; ++i) {
                    Random random(1000 * bits + i);
                    check<Node>(random, bits, counts);
                }
                CAPTURE(bits);
                CHECK(counts.met > rounds / 2);  // with one instruction set alone, too
                if (bits > 6) CHECK(counts.passed > rounds / 20);
            }
        };
        check_kind.template operator()<detail::PackedNode>();
        check_kind.template operator()<detail::PlainNode>();
    }

    // Lanes compare floats as integers, where -0 is below every other number.
    TEST_CASE("ray: a window that begins or ends at -0 begins or ends at 0 in lanes") {
        Random random(1);
        const detail::BlobData blob = make_asset(random, 16);
        detail::LatticeRay ray;
        detail::RaySlope slope;
        REQUIRE(detail::round_ray(blob, Ray{{0, 0, 0}, {1, 1, 1}}, ray, slope));
        ray.tau_min = -0.0f;
        ray.tau_max = -0.0f;
        CHECK(!std::signbit(detail::window_limit(ray)));
        detail::RayLanes lanes;
        detail::spread_ray(blob, ray, slope, lanes);
        CHECK(!std::signbit(lanes.tau_min));
#if ESPALIER_HAS_AVX2
        detail::avx2::PlacedRayLanes placed_lanes;
        detail::spread_ray(blob, ray, slope, placed_lanes);
        CHECK(!std::signbit(placed_lanes.tau_min));
#endif
    }
}
