// The filter of a leaf's triangles: it sees vertices as coarse as 16 bits, and must not reject what the kernel hits.
#include "support/testing.hpp"

#include <cstdlib>

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/rays/leaf_filter.hpp>
#include <runtime/rays/queries.hpp>

#include "support/answers/differences.hpp"
#include "support/format/encoder.hpp"

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

/// A vertex as the filter sees it, in units of its integers.
using GridPair = std::array<int, 2>;

int magnitudes(const GridPair& at) { return std::abs(at[0]) + std::abs(at[1]); }
std::int64_t cross(const GridPair& p, const GridPair& q) {
    return std::int64_t{p[0]} * q[1] - std::int64_t{p[1]} * q[0];
}

/// The filter of leaves with many vertices, which keeps each as two small integers.
class PairsFilter {
public:
    /// Of a leaf of 2^size_bits steps, 13 for integers of one step each.
    PairsFilter(unsigned size_bits, float shear_error) {
        leaf_.size_bits = static_cast<std::uint8_t>(size_bits);
        ray_.shear_error = shear_error;
    }
    [[nodiscard]] bool allows(const GridPair& a, const GridPair& b, const GridPair& c, bool is_mirrored) const {
        detail::scalar::PairVertices<4> vertices(leaf_, ray_);
        const GridPair* const corners[3] = {&a, is_mirrored ? &c : &b, is_mirrored ? &b : &c};
        for (unsigned i = 0; i < 3; ++i)
            vertices.set(i, static_cast<float>((*corners[i])[0]), static_cast<float>((*corners[i])[1]));
        return vertices.allow({0, 1, 2}) != 0;
    }

private:
    detail::PlainLeaf leaf_{};
    detail::LatticeRay ray_{};
};

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
                        require_none(ray_difference(opened.blob, loop, make_ray(random, decoded.triangles), hits));
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
                const auto is_allowed = [&](double unclear, float sign, bool is_turned) {
                    // Corners (-far, 0), (-unclear, -1), (0, 1): edge functions -unclear, far and far, or the opposite.
                    const float far = 4.0f * static_cast<float>(bound);
                    detail::scalar::FloatVertices<4> vertices(leaf, ray);
                    const auto set = [&](unsigned number, float x, float y) {
                        vertices.set(number, is_turned ? -y : x, is_turned ? x : y);  // by a quarter
                    };
                    set(0, -far * sign, 0.0f);
                    set(1, -static_cast<float>(unclear) * sign, -1.0f);
                    set(2, 0.0f, 1.0f);
                    return vertices.allow({0, 1, 2}) != 0;
                };
                for (const float sign : {1.0f, -1.0f}) {
                    for (const bool is_turned : {false, true}) {
                        CHECK(is_allowed(bound * 0.999, sign, is_turned));
                        CHECK_FALSE(is_allowed(bound * 1.001, sign, is_turned));
                    }
                }
            }
    }

    TEST_CASE("ray: the filter of small integers is unclear within its documented bound and hardly beyond it") {
        // The filter cuts off both parts of its bound to whole numbers: with these errors by nearly one or by nearly
        // nothing. The last one is nearly the largest.
        std::uint64_t unclear = 0, clear = 0;
        for (const float shear_error : {0.0f, 0.0292f, 0.0295f, 0.187f, 1.4f, 20.0f, 511.4f}) {
            const double error = double(shear_error + 0.5f);
            const double share = 34.0 / 32.0 * error;
            const int height = static_cast<int>(4.0 * share) + 8;
            const PairsFilter filter(13, shear_error);
            for (const int length : {1, 2, 7, 30, 500, 12000, 16383}) {
                for (int times = 0; times < 3 * share + 3; times += 1 + times / 16) {
                    // Where the edge function of b and c, length * times + rest, is the bound.
                    const double part = share * (3 * length + 3 + height + times) + 2.125 * error * error + 1.0;
                    const int middle = static_cast<int>((part - times * length) / (1.0 + share));
                    for (int rest = std::max(0, middle - 40); rest < length;
                         rest += rest < middle + 40 ? 1 : length / 32 + 1) {
                        const GridPair a = {0, -height}, b = {length, 1}, c = {rest - 2 * length, -times - 2};
                        const std::int64_t products[3] = {cross(b, c), cross(c, a), cross(a, b)};
                        const std::int64_t area = std::min(-*std::min_element(products, products + 3),
                                                           *std::max_element(products, products + 3));
                        const double sum = magnitudes(a) + magnitudes(b) + magnitudes(c);
                        const double bound = share * sum + 2.125 * error * error + 1.0;
                        CAPTURE(error);
                        CAPTURE(length);
                        CAPTURE(area);
                        for (const bool is_mirrored : {false, true}) {
                            const bool is_allowed = filter.allows(a, b, c, is_mirrored);
                            if (double(area) <= bound) REQUIRE(is_allowed);
                            if (double(area) > bound + sum / 32.0 + 1.0) REQUIRE_FALSE(is_allowed);
                            ++(is_allowed ? unclear : clear);
                        }
                    }
                }
            }
        }
        MESSAGE(unclear, " unclear, ", clear, " clear");
        CHECK(unclear > 1000);
        CHECK(clear > 1000);
    }

    TEST_CASE("ray: the filter of small integers rejects nothing from an error of 512 on") {
        for (const float error : {511.0f, 511.9375f, 512.0f, 512.0625f, 70000.0f, 0x1p40f}) {
            // Edge functions of half the largest integers.
            const PairsFilter filter(13, error - 0.5f);
            for (const bool is_mirrored : {false, true})
                CHECK(filter.allows({20000, -20000}, {20000, 20000}, {1, -30000}, is_mirrored) == (error >= 512.0f));
        }
    }
}
