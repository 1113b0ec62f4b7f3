// The filter of a leaf's triangles: it sees vertices as coarse as 16 bits, and must not reject what the kernel hits.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>

#include <espalier/blob.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/rays/queries.hpp>

#include "support/answers/differences.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/blobs/baking.hpp"
#include "support/format/encoder.hpp"

namespace espalier::detail::scalar {
namespace {
#include <runtime/rays/leaf_filter.inl>
}  // namespace
}  // namespace espalier::detail::scalar

using namespace espalier;
using namespace espalier::tests;

namespace {

/// As many vertices as a leaf can have, most often; or fewer.
unsigned vertex_count(Random& random, unsigned most) {
    return random.below(3) != 0 ? most : 3 + random.below(most - 2);
}

/// Slivers are as frequent as anything else: what is hit of them is all near a side.
PlainLeaf make_leaf(Random& random, Profile profile, const GridPoint& low, std::int32_t reach) {
    PlainLeaf leaf;
    const unsigned most = profile == Profile::fast ? 32 : profile == Profile::balanced ? 34 : 56;
    const unsigned count = vertex_count(random, most);
    for (unsigned i = 0; i < count; ++i) {
        const bool is_near = i != 0 && random.coin();
        GridPoint vertex;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t beside = is_near ? leaf.vertices[i - 1][k] - low[k] + random.between(-2, 2) : 0;
            vertex[k] = low[k] + (is_near ? std::clamp(beside, 0, reach) : random.between(0, reach));
        }
        leaf.vertices.push_back(vertex);
    }
    if (profile == Profile::fast) {
        const auto corner = [&] { return static_cast<std::uint8_t>(random.below(count)); };
        for (int i = 0; i < 16; ++i) leaf.triangles.push_back({corner(), corner(), corner()});
    } else {
        for (unsigned i = 0; i < count; ++i) leaf.entries.push_back({i, i == 0 || random.below(3) == 0, i + 2 < count});
        for (unsigned i = count - 2; i < count; ++i) leaf.entries[i].is_pivot = false;
    }
    return leaf;
}

/// One node and one leaf, whose coordinates have up to `width` bits, in a lattice of `bits`, whose steps are 1.
PlainBlob make_blob(Random& random, Profile profile, unsigned width, unsigned bits) {
    PlainBlob blob;
    blob.decoded.profile = profile;
    blob.decoded.bits = bits;
    blob.decoded.extent.fill((1u << bits) - 1);
    const unsigned unit = bits > 16 ? bits - 16 : 0;
    PlainNode node;
    PlainChild child;
    GridPoint low;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool is_at_end = random.coin();
        node.base[k] = is_at_end ? ((1u << bits) - (1u << std::max(width, unit))) >> unit : 0;
        node.shift[k] = width > 8 ? width - 8 : 0;
        child.high[k] = static_cast<std::uint16_t>((1u << std::min(width, 8u)) - 1);
        low[k] = static_cast<std::int32_t>(node.base[k] << unit);
    }
    const std::int32_t reach = child.high[0] << node.shift[0];
    for (std::size_t k = 0; k < 3 && profile == Profile::fast; ++k) {
        child.low[k] = static_cast<std::uint16_t>(low[k] >> unit);
        child.high[k] = static_cast<std::uint16_t>((low[k] + reach) >> unit);
    }
    child.leaf = make_leaf(random, profile, low, reach);
    node.children = {child};
    blob.decoded.vertex_count = static_cast<std::uint32_t>(child.leaf->vertices.size());
    blob.nodes = {node};
    return blob;
}

/// Exactly through a corner or the middle of a side of a triangle, or beside it, from near or as far away as whole
/// numbers in a float reach.
Ray make_ray(Random& random, const std::vector<GridTriangle>& triangles) {
    const GridTriangle& triangle = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
    const GridPoint& end = random.coin() ? triangle.b : triangle.a;
    const int length = 1 << random.below(12);
    const int most_steps = (1 << 23) / length;
    const int steps =
        random.coin() ? most_steps : 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(most_steps)));
    Ray ray;
    float* const origin[3] = {&ray.origin.x, &ray.origin.y, &ray.origin.z};
    float* const direction[3] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
    for (std::size_t k = 0; k < 3; ++k) {
        const int way = random.between(-length, length);
        const float target = 0.5f * (static_cast<float>(triangle.c[k]) + static_cast<float>(end[k]));
        *direction[k] = static_cast<float>(way);
        *origin[k] = target - static_cast<float>(way * steps);
    }
    return ray;
}

}  // namespace

TEST_SUITE("leaf filter") {
    TEST_CASE("ray: the filter of no leaf rejects a ray through a side or a corner") {
        std::uint64_t hits = 0, asked = 0;
        for (unsigned width = 1; width <= format::max_bits; ++width) {
            for (const auto profile : {Profile::fast, Profile::balanced, Profile::small}) {
                for (std::uint64_t i = 0; i < scaled(4); ++i) {
                    Random random(100 * i + 4 * width + static_cast<unsigned>(profile));
                    const unsigned bits = width + random.below(format::max_bits - width + 1);
                    CAPTURE(width);
                    CAPTURE(bits);
                    CAPTURE(static_cast<int>(profile));
                    const OpenedBlob opened(encode(make_blob(random, profile, width, bits)));
                    const DecodedBlob decoded = decode(opened.bytes);
                    const TriangleLoop loop(decoded);
                    for (int ray = 0; ray < 60; ++ray, ++asked) {
                        const auto difference =
                            ray_difference(opened.blob, loop, make_ray(random, decoded.triangles), hits);
                        REQUIRE_MESSAGE(!difference, *difference);
                    }
                }
            }
        }
        MESSAGE(hits, " hits of ", asked, " rays");
        CHECK(hits > asked / 2);
    }

    TEST_CASE("ray: the filter is unclear within its documented bound and hardly beyond it") {
        for (const float delta : {0x1p-12f, 0x1p-3f, 6.0f})
            for (const std::uint32_t size : {2u, 32u, 1u << 12, 1u << 24}) {
                const double largest = 2.0 * size + double(delta);
                const double bound = largest * (4.125 * double(delta) + 9 * 0x1p-24 * largest);
                detail::LatticeRay ray{};
                ray.shear_error = delta;
                detail::PlainLeaf leaf{};
                leaf.size_bits = static_cast<std::uint8_t>(std::bit_width(size) - 1);
                const auto is_allowed = [&](double unclear, float sign) {
                    // Corners (-far, 0), (-unclear, -1), (0, 1): edge functions -unclear, far and far, or the opposite.
                    const float far = 4.0f * static_cast<float>(bound);
                    detail::scalar::FloatVertices<4> vertices(leaf, ray);
                    vertices.set(0, -far * sign, 0.0f);
                    vertices.set(1, -static_cast<float>(unclear) * sign, -1.0f);
                    vertices.set(2, 0.0f, 1.0f);
                    return vertices.allow({0, 1, 2}) != 0;
                };
                for (const float sign : {1.0f, -1.0f}) {
                    CHECK(is_allowed(bound * 0.999, sign));
                    CHECK_FALSE(is_allowed(bound * 1.001, sign));
                }
            }
    }
}
