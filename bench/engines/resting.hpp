// Bodies that begin a little deep in a floor of many triangles, for tests of the adapters for engines: they come to
// rest. A wrong normal or depth throws them into the air, with more energy than an engine needs to push them out.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::bench {

/// A floor that rises along x, in triangles of unequal sizes: one blob, or four tiles whose borders are joined.
class RestingFloor {
public:
    RestingFloor(double degrees, bool is_tiled) : angle(static_cast<float>(degrees * 3.14159265358979 / 180.0)) {
        const std::uint32_t half = side / 2, all = side;
        if (is_tiled)
            for (const std::uint32_t tile : {0u, 1u, 2u, 3u})
                bake_cells(tile % 2 * half, tile % 2 == 0 ? half : all, tile / 2 * half, tile / 2 == 0 ? half : all);
        else bake_cells(0, all, 0, all);
        std::vector<JoinedBlob> joined;
        for (std::vector<std::byte>& bytes : bytes_) joined.push_back({bytes});
        const JoinReport report = join_borders(joined);
        REQUIRE_MESSAGE(report, report.message);
        CHECK((report.edges != 0) == is_tiled);
        for (const std::vector<std::byte>& bytes : bytes_) blobs.push_back(open(bytes));
    }

    float angle;
    std::vector<Blob> blobs;

private:
    static constexpr std::uint32_t side = 10;

    void bake_cells(std::uint32_t x, std::uint32_t x_end, std::uint32_t y, std::uint32_t y_end) {
        tests::Mesh mesh;
        for (std::uint32_t j = y; j <= y_end; ++j)
            for (std::uint32_t i = x; i <= x_end; ++i) {
                const float along = 1.1f * static_cast<float>(i) - 5.5f;
                mesh.positions.push_back({along, 0.9f * static_cast<float>(j) - 4.5f, std::tan(angle) * along});
            }
        const std::uint32_t row = x_end - x + 1;
        for (std::uint32_t j = y; j < y_end; ++j)
            for (std::uint32_t i = x; i < x_end; ++i) {
                const std::uint32_t a = (j - y) * row + i - x, b = a + 1, d = a + row, c = d + 1;
                if ((i + j) % 2 == 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
                else mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
            }
        const MeshView view = mesh.view();
        BakeResult baked = bake(std::span(&view, 1), {.resolution = Resolution::step(-14), .flat_angle = 5.0});
        REQUIRE_MESSAGE(baked, baked.message);
        bytes_.push_back(std::move(baked.bytes));
    }

    std::vector<std::vector<std::byte>> bytes_;
};

/// A body of one kilogram whose lowest side or point is 0.25 below its middle and `depth` below the floor.
struct RestingBody {
    enum class Kind { sphere, capsule, crate, hull };
    static constexpr float low = 0.25f;

    Kind kind = Kind::sphere;
    float depth = 0.0f;
    Vec3 middle;
    float turn = 0.0f;   ///< about the normal of the floor, first
    float angle = 0.0f;  ///< then about -y: the slope, and a little more

    /// The half sides of a crate. A capsule has the radius `low` and half a length of 0.3 along x.
    static constexpr std::array<float, 3> half = {0.25f, 0.3f, low};
    /// The vertices of a prism of six sides.
    static std::array<Vec3, 12> hull() {
        std::array<Vec3, 12> corners;
        for (unsigned i = 0; i < 12; ++i) {
            const float around = static_cast<float>(i % 6) * 1.0471976f;
            corners[i] = {0.3f * std::cos(around), 0.3f * std::sin(around), i < 6 ? -low : low};
        }
        return corners;
    }
};

/// Drops bodies of each kind onto floors that are level or sloped, whole or tiled. gained(floor, body) returns the most
/// kinetic and potential energy, in joules, that a body has within a second above what it begins with.
/// `bias` is the speed, for each metre of depth, with which the engine pushes bodies out of the floor.
template <class Gained>
void check_bodies_rest(const std::vector<RestingBody::Kind>& kinds, float bias, Gained gained) {
    constexpr const char* names[] = {"sphere", "capsule", "crate", "hull"};
    for (const double degrees : {0.0, 5.0, 20.0})
        for (const bool is_tiled : {false, true}) {
            const RestingFloor floor(degrees, is_tiled);
            for (const RestingBody::Kind kind : kinds) {
                tests::Random random(static_cast<std::uint64_t>(kind) + 7);
                std::uint64_t thrown = 0;
                float most = -1.0f;
                for (std::uint64_t i = 0; i < tests::scaled(60); ++i) {
                    constexpr float depths[] = {0.0002f, 0.001f, 0.005f};
                    RestingBody body;
                    body.kind = kind;
                    body.depth = depths[i % 3];
                    body.turn = i % 2 == 0 ? 0.0f : 3.0f * random.signed_unit();
                    body.angle = floor.angle + 0.002f * random.signed_unit();
                    // Every other one stands with a side a little before a seam.
                    const float x = i % 2 == 0 ? 0.25f + 0.05f * random.unit() : 2.0f * random.signed_unit();
                    const float height = RestingBody::low - body.depth;
                    body.middle = {x - height * std::sin(floor.angle), 2.0f * random.signed_unit(),
                                   std::tan(floor.angle) * x + height * std::cos(floor.angle)};
                    const float speed = bias * body.depth;
                    // Two millimetres of height are for integrators: on Bullet's own mesh a capsule gains 1.3 mm.
                    const float allowed = 9.81f * (2 * body.depth + 0.002f) + 0.5f * speed * speed;
                    const float more = gained(floor, body) - allowed;
                    most = std::max(most, more);
                    thrown += more > 0.0f ? 1u : 0u;
                }
                CAPTURE(degrees);
                CAPTURE(is_tiled);
                CAPTURE(std::string(names[static_cast<int>(kind)]));
                CHECK(thrown == 0);
                MESSAGE(degrees, " degrees, ", is_tiled ? "tiled, " : "whole, ",
                        std::string(names[static_cast<int>(kind)]), ": the most energy above that of the bias is ",
                        most, " J");
            }
        }
}

}  // namespace espalier::bench
