#include "placement_maker.hpp"

#include <algorithm>
#include <cmath>

#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

/// The longest side, or a step.
double side_of(const DecodedBlob& blob) { return std::max(size_of(blob), std::ldexp(1.0, blob.step_exponent)); }

struct Direction {
    double x, y, z;
};

Direction unit_normal(const GridTriangle& t) {
    double u[3], v[3];
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = t.b[k] - t.a[k];
        v[k] = t.c[k] - t.a[k];
    }
    const Direction n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return {n.x / length, n.y / length, n.z / length};
}

/// Turns `from` into `to`, or into its opposite; then around it, up to half a turn either way.
Quaternion rotation_between(Direction from, const Direction& to, bool opposite, float turn) {
    if (opposite) from = {-from.x, -from.y, -from.z};
    // The half-way quaternion; where the two are opposite any half turn across them does.
    double x = from.y * to.z - from.z * to.y, y = from.z * to.x - from.x * to.z, z = from.x * to.y - from.y * to.x;
    double w = 1.0 + (from.x * to.x + from.y * to.y + from.z * to.z);
    if (w < 1e-9) {
        const bool is_along_x = std::fabs(to.x) > 0.5;
        x = is_along_x ? -to.y : 0.0;
        y = is_along_x ? to.x : -to.z;
        z = is_along_x ? 0.0 : to.y;
        w = 0.0;
    }
    const double c = 1.0 - std::fabs(static_cast<double>(turn)), s = static_cast<double>(turn);
    // The turn (s to, c) times the other.
    return {static_cast<float>(c * x + s * (to.x * w + to.y * z - to.z * y)),
            static_cast<float>(c * y + s * (to.y * w + to.z * x - to.x * z)),
            static_cast<float>(c * z + s * (to.z * w + to.x * y - to.y * x)),
            static_cast<float>(c * w - s * (to.x * x + to.y * y + to.z * z))};
}

}  // namespace

PlacementMaker::PlacementMaker(const DecodedBlob& a, const DecodedBlob& b, std::uint64_t seed)
    : a_(a), b_(b), random_(seed), size_a_(side_of(a)), ratio_(side_of(a) / side_of(b)) {}

Quaternion PlacementMaker::any_rotation() {
    Quaternion q;
    float length = 0.0f;
    do {
        q = {random_.signed_unit(), random_.signed_unit(), random_.signed_unit(), random_.signed_unit()};
        length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    } while (length > 1.0f || length < 0.01f);
    return q;
}

Quaternion PlacementMaker::axis_rotation() {
    const std::array<float, 3> few = {-1.0f, 0.0f, 1.0f};
    Quaternion q;
    // One or two components of equal size, or all four: the 24 rotations of a cube.
    const auto kind = random_.below(4);
    if (kind == 0) return {};
    else if (kind == 1) q = {0.0f, 0.0f, few[random_.below(3)], 1.0f};
    else if (kind == 2) q = {few[random_.below(3)], 1.0f, 0.0f, 0.0f};
    else q = {random_.coin() ? 1.0f : -1.0f, random_.coin() ? 1.0f : -1.0f, random_.coin() ? 1.0f : -1.0f, 1.0f};
    return q;
}

/// Or the middle of a side.
Vec3 PlacementMaker::corner_of(const DecodedBlob& blob, const GridTriangle& t) {
    const std::uint32_t corner = random_.below(4);
    const GridPoint& p = corner == 0 ? t.a : corner == 1 ? t.b : t.c;
    if (corner < 3) return place_in_world(blob, p[0], p[1], p[2]);
    return place_in_world(blob, 0.5 * (t.a[0] + t.b[0]), 0.5 * (t.a[1] + t.b[1]), 0.5 * (t.a[2] + t.b[2]));
}

Vec3 PlacementMaker::some_corner(const DecodedBlob& blob) { return corner_of(blob, some_triangle(blob, random_)); }

Vec3 PlacementMaker::place_on(const DecodedBlob& blob, const GridTriangle& t) {
    double u = static_cast<double>(random_.unit()), v = static_cast<double>(random_.unit());
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const auto at = [&](std::size_t k) { return t.a[k] + u * (t.b[k] - t.a[k]) + v * (t.c[k] - t.a[k]); };
    return place_in_world(blob, at(0), at(1), at(2));
}

Vec3 PlacementMaker::some_place(const DecodedBlob& blob) {
    const auto at = [&](std::size_t k) {
        return static_cast<double>(random_.unit()) * static_cast<double>(blob.extent[k]);
    };
    const double x = at(0), y = at(1), z = at(2);
    return place_in_world(blob, x, y, z);
}

void PlacementMaker::move(Transform& placement, Vec3 p, Vec3 q) {
    const double x = static_cast<double>(placement.rotation.x), y = static_cast<double>(placement.rotation.y),
                 z = static_cast<double>(placement.rotation.z), w = static_cast<double>(placement.rotation.w);
    const double s = 2.0 / (x * x + y * y + z * z + w * w);
    const double px = static_cast<double>(p.x), py = static_cast<double>(p.y), pz = static_cast<double>(p.z);
    const double scale = static_cast<double>(placement.scale);
    const double turned[3] = {(1.0 - s * (y * y + z * z)) * px + s * (x * y - w * z) * py + s * (x * z + w * y) * pz,
                              s * (x * y + w * z) * px + (1.0 - s * (x * x + z * z)) * py + s * (y * z - w * x) * pz,
                              s * (x * z - w * y) * px + s * (y * z + w * x) * py + (1.0 - s * (x * x + y * y)) * pz};
    placement.translation = {static_cast<float>(static_cast<double>(q.x) - scale * turned[0]),
                             static_cast<float>(static_cast<double>(q.y) - scale * turned[1]),
                             static_cast<float>(static_cast<double>(q.z) - scale * turned[2])};
}

Transform PlacementMaker::random() {
    Transform placement = {
        any_rotation(), {}, static_cast<float>(ratio_ * (0.25 + 1.75 * static_cast<double>(random_.unit())))};
    move(placement, some_place(b_), some_place(a_));
    return placement;
}

Transform PlacementMaker::apart() {
    Transform placement = random();
    const Vec3 off =
        random_.in_cube(static_cast<float>(std::max(1.0, static_cast<double>(placement.scale) / ratio_) * size_a_));
    placement.translation = sum(placement.translation, off);
    return placement;
}

Transform PlacementMaker::beside(double proportion) {
    Transform placement = {any_rotation(), {}, static_cast<float>(ratio_ * proportion)};
    const Vec3 from = place_on(b_, some_triangle(b_, random_));
    const Vec3 to = place_on(a_, some_triangle(a_, random_));
    const double away = std::exp2(static_cast<double>(random_.between(-4, 4)));
    const Vec3 off = random_.in_cube(static_cast<float>(away * size_a_ * std::min(1.0, proportion)));
    move(placement, from, sum(to, off));
    return placement;
}

Transform PlacementMaker::face_on_face(double proportion) {
    Transform placement = {{}, {}, static_cast<float>(std::exp2(std::round(std::log2(ratio_))) * proportion)};
    const GridTriangle &face_a = some_triangle(a_, random_), &face_b = some_triangle(b_, random_);
    const bool opposite = random_.coin();
    const float turn = random_.signed_unit();
    placement.rotation = rotation_between(unit_normal(face_b), unit_normal(face_a), opposite, turn);
    const bool corner_of_b = random_.coin();
    const Vec3 from = corner_of_b ? corner_of(b_, face_b) : place_on(b_, face_b);
    const Vec3 to = corner_of_b && random_.coin() ? place_on(a_, face_a) : corner_of(a_, face_a);
    const double lift = random_.coin() ? 0.0 : std::exp2(static_cast<double>(random_.between(-24, -2)));
    const Direction away = unit_normal(face_a);
    const double height = lift * size_a_ * std::min(1.0, proportion);
    move(placement, from,
         {static_cast<float>(static_cast<double>(to.x) + height * away.x),
          static_cast<float>(static_cast<double>(to.y) + height * away.y),
          static_cast<float>(static_cast<double>(to.z) + height * away.z)});
    return placement;
}

Transform PlacementMaker::adversarial() {
    Transform placement;
    // A power of two keeps lattice points on lattice points.
    placement.scale = static_cast<float>(std::exp2(std::round(std::log2(ratio_))));
    placement.rotation = axis_rotation();
    switch (random_.below(8)) {
        case 0:  // corner on corner, in the same axes
            move(placement, some_corner(b_), some_corner(a_));
            break;
        case 1:  // the same place
            move(placement, place_in_world(b_, 0, 0, 0), place_in_world(a_, 0, 0, 0));
            break;
        case 2: {  // boxes that touch
            const std::size_t axis = random_.below(3);
            std::array<double, 3> from = {0, 0, 0}, to = {0, 0, 0};
            to[axis] = static_cast<double>(a_.extent[axis]);
            placement.rotation = {};
            move(placement, place_in_world(b_, from[0], from[1], from[2]), place_in_world(a_, to[0], to[1], to[2]));
            break;
        }
        case 3:  // corner on corner, turned
            placement.rotation = any_rotation();
            move(placement, some_corner(b_), some_corner(a_));
            break;
        case 4: {  // turned by next to nothing
            const float angle = std::ldexp(1.0f, random_.between(-28, -4));
            placement.rotation = {angle * random_.signed_unit(), angle * random_.signed_unit(), angle, 1.0f};
            move(placement, some_corner(b_), some_corner(a_));
            break;
        }
        case 5: {  // one much larger than the other
            placement.rotation = any_rotation();
            placement.scale = static_cast<float>(ratio_ * std::exp2(static_cast<double>(random_.between(-12, 12))));
            move(placement, some_corner(b_), some_corner(a_));
            break;
        }
        case 6: {  // far away
            placement.rotation = any_rotation();
            Vec3 place = some_place(a_);
            const double away = size_a_ * std::exp2(static_cast<double>(random_.between(0, 24)));
            (random_.coin() ? place.x : place.y) += static_cast<float>(away);
            move(placement, some_corner(b_), place);
            break;
        }
        default: {  // a quaternion of any length
            placement.rotation = any_rotation();
            const float length = std::ldexp(1.0f, random_.between(-120, 100));
            Quaternion& q = placement.rotation;
            q = {q.x * length, q.y * length, q.z * length, q.w * length};
            move(placement, some_corner(b_), some_place(a_));
        }
    }
    return placement;
}

}  // namespace espalier::tests
