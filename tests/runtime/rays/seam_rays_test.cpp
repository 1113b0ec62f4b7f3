// Claims about the parts of a mesh that were baked apart on one lattice: a ray rounded once passes between no two.
#include "support/testing.hpp"

#include "support/meshes/splits.hpp"

namespace espalier::tests::seam_rays_test {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Where parts meet: vertices and sides of the whole that triangles of two parts have. Without the outer border of a
/// height field, which a ray may pass.
struct Seam {
    std::vector<std::uint32_t> vertices;
    std::vector<Edge> edges;

    explicit Seam(const Split& split) {
        std::map<std::uint32_t, std::set<std::size_t>> parts_of_vertex;
        std::map<Edge, std::set<std::size_t>> parts_of_edge;
        std::map<Edge, int> triangles_of_edge;
        std::set<std::uint32_t> on_border;
        for (std::size_t part = 0; part < split.parts.size(); ++part)
            for (const std::uint32_t triangle : split.parts[part].of_triangle)
                for (std::size_t k = 0; k < 3; ++k) {
                    const TriangleVertices& corners = split.whole.triangles[triangle];
                    const Edge edge = edge_between(corners[k], corners[(k + 1) % 3]);
                    parts_of_vertex[corners[k]].insert(part);
                    parts_of_edge[edge].insert(part);
                    ++triangles_of_edge[edge];
                }
        for (const auto& [edge, triangles] : triangles_of_edge)
            if (triangles == 1) on_border.insert({edge.first, edge.second});
        for (const auto& [vertex, parts] : parts_of_vertex)
            if (parts.size() > 1 && on_border.count(vertex) == 0) vertices.push_back(vertex);
        for (const auto& [edge, parts] : parts_of_edge)
            if (parts.size() > 1 && on_border.count(edge.first) + on_border.count(edge.second) == 0)
                edges.push_back(edge);
    }
};

/// Aims at where the seam is on the lattice.
class SeamRays {
public:
    SeamRays(const Split& split, const Seam& seam, std::uint64_t seed) : split_(split), seam_(seam), random_(seed) {
        for (const Vec3& p : split.whole.positions) {
            low_ = std::min(low_, p.z);
            high_ = std::max(high_, p.z);
        }
    }

    /// One that has to hit: through a point deep inside a closed mesh, or steeply down or up on a height field.
    Ray ray() {
        const Vec3 at = target();
        const float away = std::ldexp(1.0f + random_.unit(), random_.between(-4, 12));
        Ray ray;
        if (split_.closed) {
            const Vec3& middle = split_.inside[random_.below(static_cast<std::uint32_t>(split_.inside.size()))];
            const Vec3 out = difference(at, middle);
            if (random_.coin()) {
                ray = {middle, out};
            } else {
                ray.origin = sum(at, times(out, away));
                ray.direction = difference(middle, ray.origin);
            }
        } else {
            const float height = (high_ - low_) * (1.0f + away) * (random_.coin() ? 1.0f : -1.0f);
            const Vec3 tilt = random_.in_cube(random_.below(4) == 0 ? 0.0f : 0.03f);
            ray.origin = {at.x + tilt.x * height, at.y + tilt.y * height, at.z + height};
            ray.direction = difference(at, ray.origin);
        }
        return ray;
    }

private:
    [[nodiscard]] std::array<double, 3> snapped(std::uint32_t vertex) const {
        const Vec3& p = split_.whole.positions[vertex];
        const int exponent = static_cast<int>(split_.options.resolution.value());
        const auto snap = [&](float x) {
            return std::ldexp(std::nearbyint(std::ldexp(double(x), -exponent)), exponent);
        };
        return {snap(p.x), snap(p.y), snap(p.z)};
    }

    Vec3 target() {
        std::array<double, 3> at{};
        if (random_.coin()) {
            at = snapped(seam_.vertices[random_.below(static_cast<std::uint32_t>(seam_.vertices.size()))]);
        } else {
            const Edge& edge = seam_.edges[random_.below(static_cast<std::uint32_t>(seam_.edges.size()))];
            const double share = random_.coin() ? 0.5 : double(random_.unit());
            const auto a = snapped(edge.first), b = snapped(edge.second);
            for (std::size_t k = 0; k < 3; ++k) at[k] = a[k] + share * (b[k] - a[k]);
        }
        return {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
    }

    const Split& split_;
    const Seam& seam_;
    Random random_;
    float low_ = INFINITY, high_ = -INFINITY;
};

struct Tiles {
    std::vector<OpenedBlob> opened;
    std::vector<Blob> blobs;
    Lattice region;

    explicit Tiles(const Split& split) {
        for (const Split::Part& part : split.parts) {
            opened.emplace_back(part.mesh, split.options);
            blobs.push_back(opened.back().blob);
        }
        const Result<Lattice> found = lattice_of(blobs);
        REQUIRE(found);
        region = *found;
    }
};

TEST_CASE("seams: no rounded ray that is aimed at it passes between the parts of a mesh") {
    constexpr std::uint32_t splits = 100;
    // Times a scale of 100 these are a million rays.
    const std::uint64_t rays = scaled(splits * 100) / splits + 1;
    std::uint64_t leaks = 0, leaks_of_plain_rays = 0, asked = 0;
    for (std::uint32_t number = 0; number < splits; ++number) {
        const Split split = make_split(number);
        CAPTURE(split.name);
        const Tiles tiles(split);
        const OpenedBlob whole(split.whole, split.options);
        const Seam seam(split);
        REQUIRE(!seam.vertices.empty());
        REQUIRE(!seam.edges.empty());
        SeamRays maker(split, seam, number);
        for (std::uint64_t i = 0; i < rays; ++i) {
            const Ray ray = maker.ray();
            CAPTURE(describe(ray));
            const RoundedRay rounded = round_ray(tiles.region, ray);
            REQUIRE(rounded.status() == QueryStatus::ok);
            float nearest = INFINITY;
            bool any = false, any_plain = false;
            for (const Blob& blob : tiles.blobs) {
                const RayHit hit = raycast(blob, rounded);
                REQUIRE(!is_refused(hit.status));
                REQUIRE(bool(hit) == (hit.t < INFINITY));
                nearest = std::min(nearest, hit.t);
                REQUIRE(occluded(blob, rounded).status() == hit.status);
                any = any || hit;
                any_plain = any_plain || occluded(blob, ray).yes();
            }
            ++asked;
            leaks += any ? 0u : 1u;
            leaks_of_plain_rays += any_plain ? 0u : 1u;
            // The whole, baked as one blob, is the same surface.
            const RayHit of_whole = raycast(whole.blob, rounded);
            REQUIRE(!is_refused(of_whole.status));
            REQUIRE(same_bits(nearest, of_whole.t));
        }
    }
    MESSAGE(asked << " rays: " << leaks << " leaks; " << leaks_of_plain_rays << " rounded for each blob");
    CHECK(leaks == 0);
    if (scaled(100) >= 10'000) CHECK(leaks_of_plain_rays > 0);  // so there is something to lose
}

}  // namespace
}  // namespace espalier::tests::seam_rays_test
