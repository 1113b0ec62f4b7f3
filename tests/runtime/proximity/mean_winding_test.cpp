// Claims about winding_number(): whole numbers where the surface is closed, and elsewhere near the solid angle of all
// triangles, which a reference sums up in double.
#include "support/testing.hpp"

#include <Eigen/Geometry>

namespace espalier::tests::mean_winding_test {
namespace {

/// Sums up the solid angles of all triangles over 4 pi (van Oosterom and Strackee 1983).
double winding_by_solid_angles(const Blob& blob, const Vec3& point) {
    double sum = 0.0;
    const Eigen::Vector3d center(static_cast<double>(point.x), static_cast<double>(point.y),
                                 static_cast<double>(point.z));
    const auto from_point = [&](const Vec3& p) -> Eigen::Vector3d {
        return Eigen::Vector3d(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)) - center;
    };
    (void)for_each_triangle(blob, [&](TriangleId, const Triangle& triangle) {
        const Eigen::Vector3d a = from_point(triangle.a), b = from_point(triangle.b), c = from_point(triangle.c);
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
    });
    return sum / (4.0 * std::acos(-1.0));
}

Mesh without(Mesh mesh, std::size_t first, std::size_t count) {
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                         mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first + count));
    return mesh;
}

/// Returns the root of the mean of squared errors over points in and around the mesh.
double error_of(const Blob& blob, unsigned directions, std::uint64_t count, double& worst) {
    Random random(directions);
    double squares = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const Vec3 point = random.in_cube(1.5f);
        const Result<float> winding = winding_number(blob, point, directions);
        REQUIRE(winding.status == QueryStatus::ok);
        const double error = static_cast<double>(*winding) - winding_by_solid_angles(blob, point);
        worst = std::max(worst, std::fabs(error));
        squares += error * error;
    }
    return std::sqrt(squares / static_cast<double>(count));
}

TEST_CASE("inside: the winding number of a closed surface is whole and that of contains") {
    Random random(41);
    std::uint64_t inside = 0;
    for_each_profile([&](Profile profile) {
        const OpenedBlob opened(make_icosphere(2, 1.0, {0.1f, 0.0f, 0.2f}), with_profile(profile));
        for (std::uint64_t i = 0; i < scaled(200); ++i) {
            const Vec3 point = random.in_cube(1.3f);
            const Result<float> winding = winding_number(opened.blob, point, 2 + random.below(20));
            REQUIRE(winding.status == QueryStatus::ok);
            REQUIRE(*winding == (contains(opened.blob, point).yes() ? 1.0f : 0.0f));
            inside += *winding == 1.0f ? 1u : 0u;
        }
    });
    CHECK(inside > 0);
}

TEST_CASE("inside: the winding number of a surface that was baked inside out is negative") {
    Mesh mesh = make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f});
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    const OpenedBlob opened(mesh);
    CHECK(*winding_number(opened.blob, {0.1f, 0.2f, 0.3f}) == -1.0f);
    CHECK(*winding_number(opened.blob, {2.0f, 0.2f, 0.3f}) == 0.0f);
}

TEST_CASE("inside: the winding number of an open surface is near its solid angle and nearer with more directions") {
    const Mesh sphere = make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f});
    const std::size_t all = sphere.triangles.size();
    for (const std::size_t missing : {all / 20, all / 4, all / 2}) {
        CAPTURE(missing);
        const OpenedBlob opened(without(sphere, all / 3, missing));
        double worst = 0.0, worst_of_many = 0.0;
        const double of_few = error_of(opened.blob, 64, scaled(400), worst);
        const double of_many = error_of(opened.blob, 1024, scaled(100), worst_of_many);
        CHECK(of_few < 0.03);
        CHECK(worst < 0.15);
        CHECK(of_many < 0.006);
        CHECK(worst_of_many < 0.04);
        MESSAGE(missing, " of ", all, " triangles missing: error ", of_few, ", at most ", worst, " by 64 directions, ",
                of_many, ", at most ", worst_of_many, " by 1024");
    }
}

TEST_CASE("inside: a winding number refuses what it cannot answer") {
    const OpenedBlob opened(make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f}));
    const Vec3 middle = {0.0f, 0.0f, 0.0f};
    CHECK(winding_number(Blob(), middle).status == QueryStatus::not_open);
    for (const unsigned directions : {0u, 1u, max_winding_directions + 1})
        CHECK(winding_number(opened.blob, middle, directions).status == QueryStatus::invalid_argument);
    CHECK(*winding_number(opened.blob, middle, 3) == 1.0f);
    CHECK(*winding_number(opened.blob, middle, max_winding_directions) == 1.0f);
    for (const float bad : {not_a_number, std::numeric_limits<float>::infinity()})
        CHECK(winding_number(opened.blob, {0.0f, bad, 0.0f}).status == QueryStatus::invalid_argument);
    CHECK(*winding_number(opened.blob, {1e6f, 0.0f, 0.0f}) == 0.0f);
}

}  // namespace
}  // namespace espalier::tests::mean_winding_test
