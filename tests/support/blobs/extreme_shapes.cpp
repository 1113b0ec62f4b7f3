#include "extreme_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "support/base/profiles.hpp"
#include "support/meshes/makers.hpp"

namespace espalier::tests {

namespace {

Mesh stretched(Mesh mesh, Vec3 factors) {
    for (Vec3& p : mesh.positions) p = {p.x * factors.x, p.y * factors.y, p.z * factors.z};
    return mesh;
}

Mesh named(Mesh mesh, const char* name) {
    mesh.name = name;
    return mesh;
}

/// Closed: a tetrahedron whose four corners nearly lie in one plane, so that each face is seen nearly from its side.
Mesh make_sliver_solid() {
    return {.positions = {{-1.0f, -1.0f, 0.0f}, {1.0f, 1.0f, 0.0f}, {1.0f, -1.0f, 1e-4f}, {-1.0f, 1.0f, 1e-4f}},
            .triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// What is inside of the world's box only.
std::vector<GridTriangle> within(const DecodedBlob& decoded, const Box& box) {
    const auto is_within = [&](const GridPoint& p) {
        const float low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
        for (unsigned k = 0; k < 3; ++k) {
            const double x = static_cast<double>(decoded.origin[k]) + std::ldexp(p[k], decoded.step_exponent);
            if (x < static_cast<double>(low[k]) || x > static_cast<double>(high[k])) return false;
        }
        return true;
    };
    std::vector<GridTriangle> found;
    for (const GridTriangle& t : decoded.triangles)
        if (is_within(t.a) && is_within(t.b) && is_within(t.c)) found.push_back(t);
    return found;
}

constexpr float largest = std::numeric_limits<float>::max();
constexpr Box everywhere = {{-largest, -largest, -largest}, {largest, largest, largest}};

std::vector<ExtremeShape> in_every_profile(const Mesh& mesh, unsigned bits) {
    std::vector<ExtremeShape> shapes;
    for (const Profile profile : every_profile) {
        OpenedBlob opened(mesh, {.resolution = Resolution::bits(bits), .profile = profile});
        DecodedBlob decoded = decode(opened.bytes);
        if (decoded.triangles.empty()) throw std::runtime_error(mesh.name + ": nothing was left of it");
        shapes.push_back({mesh.name + ", " + std::to_string(bits) + " bits, profile " + name_of(profile),
                          std::move(opened), std::move(decoded)});
    }
    return shapes;
}

void add(std::vector<ExtremeSolid>& solids, const Mesh& mesh, unsigned bits, const Box& part = everywhere) {
    for (ExtremeShape& shape : in_every_profile(mesh, bits)) {
        if (!shape.opened.blob.is_closed()) throw std::runtime_error(shape.name + ": not closed");
        std::vector<GridTriangle> surface = within(shape.decoded, part);
        std::array<double, 3> middle{};
        for (const GridTriangle& t : surface)
            for (unsigned k = 0; k < 3; ++k)
                middle[k] += (t.a[k] + t.b[k] + t.c[k]) / (3.0 * static_cast<double>(surface.size()));
        solids.push_back({std::move(shape), std::move(surface), middle});
    }
}

void add(std::vector<ExtremeShape>& shapes, const Mesh& mesh, unsigned bits) {
    for (ExtremeShape& shape : in_every_profile(mesh, bits)) shapes.push_back(std::move(shape));
}

}  // namespace

std::vector<ExtremeSolid> make_extreme_solids() {
    std::vector<ExtremeSolid> solids;
    const Vec3 nowhere{};
    const Mesh ball = make_icosphere(1, 1.0, nowhere), cube = make_cube(-1.0f, 1.0f);
    // Sizes. Steps go from 2^-100 to 2^100: the smallest and the largest have room for few bits, or for 24 and no more.
    add(solids, named(scaled_by(cube, 1e-30f), "cube of 2e-30"), 2);
    add(solids, named(scaled_by(ball, 1e-27f), "ball of 2e-27"), 11);
    add(solids, named(scaled_by(ball, 1e-20f), "ball of 2e-20"), 16);
    add(solids, named(scaled_by(ball, 1e-10f), "ball of 2e-10"), 24);
    add(solids, named(ball, "ball"), 16);
    add(solids, named(make_icosphere(2, 1.0, nowhere), "finer ball"), 20);
    add(solids, named(scaled_by(ball, 1e10f), "ball of 2e10"), 24);
    add(solids, named(scaled_by(ball, 1e20f), "ball of 2e20"), 7);
    add(solids, named(scaled_by(ball, 1e30f), "ball of 2e30"), 16);
    add(solids, named(scaled_by(cube, 0x1.fp122f), "cube of nearly 2^124"), 24);
    // Places. Beyond 2^24 sizes nothing is left of a mesh, since its floats are no finer.
    add(solids, named(make_icosphere(1, 1.0, {1e3f, -2e3f, 5e2f}), "ball 1e3 sizes away"), 16);
    add(solids, named(make_icosphere(0, 1.0, {1e5f, 0.0f, -3e5f}), "ball 1e5 sizes away"), 16);
    add(solids, named(moved_by(cube, {0x1p23f, -0x1p23f, 0x1p22f}), "cube 4e6 sizes away"), 8);
    add(solids, named(moved_by(scaled_by(cube, 1e-20f), {1e-15f, 1e-15f, 1e-15f}), "small cube 1e5 sizes away"), 16);
    // Forms.
    add(solids, named(stretched(cube, {1.0f, 1e-6f, 1e-6f}), "needle"), 24);
    add(solids, named(stretched(ball, {1e-4f, 1.0f, 1e-4f}), "needle ball"), 24);
    add(solids, named(stretched(ball, {1.0f, 1e-5f, 1.0f}), "flat ball"), 24);
    add(solids, named(stretched(cube, {1e-6f, 1.0f, 1.0f}), "flat cube"), 24);
    add(solids, named(make_sliver_solid(), "sliver"), 24);
    add(solids, named(make_uv_sphere(6, 40, 1.0, {0.1f, 0.2f, 0.3f}), "poles of 40 slivers"), 18);
    // A teapot in a stadium: 1 in 10,000.
    const Mesh teapot = make_icosphere(1, 1.0, {777.0f, -3333.0f, 21.0f});
    add(solids, named(joined(make_icosphere(2, 1e4, nowhere), teapot), "small ball in a large one"), 24,
        {{775.0f, -3335.0f, 19.0f}, {779.0f, -3331.0f, 23.0f}});
    return solids;
}

std::vector<ExtremeShape> make_extreme_surfaces() {
    std::vector<ExtremeShape> shapes;
    add(shapes, named(scaled_by(make_soup(60, 1), 1e-25f), "soup of 1e-25"), 16);
    add(shapes, named(scaled_by(make_soup(60, 2), 1e30f), "soup of 1e30"), 24);
    add(shapes, named(scaled_by(make_soup(2, 3), 2e-30f), "soup of 2e-30"), 2);
    add(shapes, named(scaled_by(make_plane_grid(5), 1e10f), "plane of 5e10"), 24);
    add(shapes, named(stretched(make_plane_grid(5), {1e-20f, 1e-20f, 0.0f}), "plane of 5e-20 at 0"), 12);
    add(shapes, named(make_needle_fan(50), "needles"), 24);
    add(shapes, named(stretched(make_needle_fan(50), {1.0f, 1e-5f, 1e-3f}), "flat needles"), 24);
    add(shapes, named(make_slivers(50, 4), "slivers"), 24);
    add(shapes, named(moved_by(make_slivers(50, 5), {1e4f, 1e4f, 1e4f}), "slivers 1e4 sizes away"), 16);
    add(shapes, named(make_coplanar_stacks(50, 6), "coplanar stacks"), 20);
    add(shapes, named(joined(scaled_by(make_soup(20, 7), 1e5f), make_soup(40, 8)), "soup in a larger one"), 24);
    Mesh limit = make_cube(-0x1p122f, 0x1p122f);
    limit.positions[7] = {0x1.fp122f, 0x1.fp122f, 0x1p122f};
    add(shapes, named(moved_by(limit, {largest - 0x1.fp122f, 0.0f, 0x1.fp122f - largest}), "cube at the limit"), 24);
    Mesh subnormal = make_soup(30, 9);
    for (Vec3& p : subnormal.positions) p.z *= 0x1p-140f;  // flat on the lattice: z is 0 on all of it
    add(shapes, named(subnormal, "subnormal heights"), 16);
    Mesh tiny = scaled_by(make_soup(30, 10), 1e-28f);
    for (Vec3& p : tiny.positions) p.x = std::fabs(p.x) < 2e-29f ? 0x1p-149f : p.x;
    add(shapes, named(tiny, "some subnormal coordinates"), 7);
    return shapes;
}

}  // namespace espalier::tests
