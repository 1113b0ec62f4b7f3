// The gap between two instances that share an edge and are turned differently: each rounds the ray for itself.
#include "support/testing.hpp"

#include <Eigen/Geometry>

#include "maker.hpp"

namespace espalier::tests::gap_test {
namespace {

using Vector = Eigen::Vector3d;

Vec3 rounded(const Vector& a) {
    return {static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(a.z())};
}
Vector vector_of(const Vec3& a) { return {double(a.x), double(a.y), double(a.z)}; }

double fraction(Random& random) { return double(random.unit()); }

/// Returns a vector rotated in double precision.
Vector rotated(const Quaternion& q, const Vector& v) {
    return Eigen::Quaterniond(double(q.w), double(q.x), double(q.y), double(q.z)).normalized() * v;
}

/// Returns a rotation behind another one about the x axis.
Quaternion turned_about_x(const Quaternion& q, double angle) {
    const double s = std::sin(angle / 2), c = std::cos(angle / 2);
    const auto x = double(q.x), y = double(q.y), z = double(q.z), w = double(q.w);
    const Vector axis = {c * x + s * w, c * y + s * z, c * z - s * y};
    return {static_cast<float>(axis.x()), static_cast<float>(axis.y()), static_cast<float>(axis.z()),
            static_cast<float>(c * w - s * x)};
}

/// A unit square in the plane z = 0, with an edge on the x axis.
Mesh make_sheet() {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

/// Two sheets in the world that meet along an edge, and rays that cross it.
class Hinge {
public:
    explicit Hinge(Random& random) {
        place_.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()};
        place_.scale = std::ldexp(1.0f + random.unit(), random.between(-6, 6));
        // Near the origin of the world, where coordinates are finer than the gap.
        place_.translation = random.in_cube(std::ldexp(place_.scale, random.between(-4, 2)));
        Transform other = place_;
        other.rotation = turned_about_x(place_.rotation, 1.8 + 2.7 * fraction(random));
        const std::vector<OpenedBlob> blobs = opened_blobs({make_sheet()});
        const auto scale = double(place_.scale);
        step_ = std::ldexp(scale, blobs.front().blob.lattice().step_exponent);
        std::vector<Instance> instances(2);
        instances[0].transform = place_;
        instances[1].transform = other;
        for (std::uint32_t i = 0; i < 2; ++i) instances[i].mask = 1u << i;
        opened_.emplace_back(blobs, instances);

        const Vector edge = rotated(place_.rotation, {1, 0, 0});
        const Vector to_first = rotated(place_.rotation, {0, 1, 0}), to_other = rotated(other.rotation, {0, 1, 0});
        point_ = vector_of(place_.translation) + (scale * (0.1 + 0.8 * fraction(random))) * edge;
        const Vector through = edge.cross(to_first - to_other).normalized();
        ray_.direction = rounded(through + 0.3 * vector_of(random.in_cube(1.0f)));
        const Vector along = vector_of(ray_.direction);
        aside_ = edge.cross(along).normalized();
        if (aside_.dot(to_first) < 0.0) aside_ = -1.0 * aside_;
        start_ = point_ - (scale * std::ldexp(1.0, random.between(-2, 8))) * along.normalized();
        ray_.t_max = std::numeric_limits<float>::infinity();
    }

    /// Returns how far a ray is off along an axis of the world, by docs/numerics.md (Scenes).
    [[nodiscard]] double bound() const {
        const Box bounds = opened_.front().scene.bounds();
        const Vector low = vector_of(bounds.min) - start_, high = vector_of(bounds.max) - start_;
        const double reach = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
        return 0x1p-24 * 204 * reach + std::sqrt(3.0) / 128 * step_;
    }

    /// Returns the distance from the edge of the ray nearest to it that hits a sheet: of 0 or 1, on its side.
    [[nodiscard]] double nearest_hit(int sheet) const {
        const double side = sheet == 0 ? 1.0 : -1.0;
        double miss = -side * 8.0 * bound(), hit = -miss;
        CHECK_FALSE(hits(sheet, miss));
        REQUIRE(hits(sheet, hit));
        for (int i = 0; i < 60; ++i) {
            const double middle = (miss + hit) / 2;
            (hits(sheet, middle) ? hit : miss) = middle;
        }
        return (vector_of(ray_at(hit).origin) - start_).dot(aside_);
    }

private:
    [[nodiscard]] Ray ray_at(double offset) const {
        Ray ray = ray_;
        ray.origin = rounded(start_ + offset * aside_);
        return ray;
    }
    [[nodiscard]] bool hits(int sheet, double offset) const {
        return bool(raycast(opened_.front().scene, ray_at(offset), 1u << sheet));
    }

    std::vector<OpenedScene> opened_;
    Transform place_;
    double step_ = 0.0;
    Vector point_, start_, aside_;
    Ray ray_;
};

TEST_CASE("scene: the gap between turned neighbours keeps to its bound") {
    Random random(20261123);
    double widest = 0.0;
    const std::uint64_t count = scaled(2000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Hinge hinge(random);
        const double gap = hinge.nearest_hit(0) - hinge.nearest_hit(1);
        widest = std::max(widest, gap / (2.0 * hinge.bound()));
    }
    CAPTURE(widest);
    MESSAGE("widest gap in " << count << " pairs of neighbours: " << widest << " of its bound");
    CHECK(widest <= 1.0);
    CHECK(widest > 0.0);
}

}  // namespace
}  // namespace espalier::tests::gap_test
