#include "placement_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace espalier::tests {

namespace {

double size_of(const DecodedBlob& blob) {
    return std::ldexp(static_cast<double>(std::max({blob.extent[0], blob.extent[1], blob.extent[2], 1u})),
                      blob.step_exponent);
}

Vec3 to_world(const DecodedBlob& blob, double x, double y, double z) {
    const auto axis = [&](std::size_t k, double steps) {
        return static_cast<float>(static_cast<double>(blob.origin[k]) + std::ldexp(steps, blob.step_exponent));
    };
    return {axis(0, x), axis(1, y), axis(2, z)};
}

}  // namespace

PlacementMaker::PlacementMaker(const DecodedBlob& a, const DecodedBlob& b, std::uint64_t seed)
    : a_(a), b_(b), random_(seed), size_a_(size_of(a)), ratio_(size_of(a) / size_of(b)) {}

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
    switch (random_.below(4)) {
        case 0:
            return {};
        case 1:
            q = {0.0f, 0.0f, few[random_.below(3)], 1.0f};
            break;
        case 2:
            q = {few[random_.below(3)], 1.0f, 0.0f, 0.0f};
            break;
        default:
            q = {random_.coin() ? 1.0f : -1.0f, random_.coin() ? 1.0f : -1.0f, random_.coin() ? 1.0f : -1.0f, 1.0f};
    }
    return q;
}

Vec3 PlacementMaker::some_corner(const DecodedBlob& blob) {
    const GridTriangle& t = blob.triangles[random_.below(static_cast<std::uint32_t>(blob.triangles.size()))];
    const std::uint32_t corner = random_.below(4);
    const GridPoint& p = corner == 0 ? t.a : corner == 1 ? t.b : t.c;
    if (corner < 3) return to_world(blob, p[0], p[1], p[2]);
    return to_world(blob, 0.5 * (t.a[0] + t.b[0]), 0.5 * (t.a[1] + t.b[1]), 0.5 * (t.a[2] + t.b[2]));
}

Vec3 PlacementMaker::some_place(const DecodedBlob& blob) {
    const auto at = [&](std::size_t k) {
        return static_cast<double>(random_.unit()) * static_cast<double>(blob.extent[k]);
    };
    const double x = at(0), y = at(1), z = at(2);
    return to_world(blob, x, y, z);
}

void PlacementMaker::move(Placement& placement, Vec3 p, Vec3 q) {
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

Placement PlacementMaker::random() {
    Placement placement;
    placement.rotation = any_rotation();
    placement.scale = static_cast<float>(ratio_ * (0.25 + 1.75 * static_cast<double>(random_.unit())));
    move(placement, some_place(b_), some_place(a_));
    return placement;
}

Placement PlacementMaker::apart() {
    Placement placement = random();
    const Vec3 off =
        random_.in_cube(static_cast<float>(std::max(1.0, static_cast<double>(placement.scale) / ratio_) * size_a_));
    Vec3& place = placement.translation;
    place = {place.x + off.x, place.y + off.y, place.z + off.z};
    return placement;
}

Placement PlacementMaker::adversarial() {
    Placement placement;
    // A power of two keeps lattice points on lattice points.
    placement.scale = static_cast<float>(std::exp2(std::round(std::log2(ratio_))));
    placement.rotation = axis_rotation();
    switch (random_.below(8)) {
        case 0:  // corner on corner, in the same axes
            move(placement, some_corner(b_), some_corner(a_));
            break;
        case 1:  // the same place
            move(placement, to_world(b_, 0, 0, 0), to_world(a_, 0, 0, 0));
            break;
        case 2: {  // boxes that touch
            const std::size_t axis = random_.below(3);
            std::array<double, 3> from = {0, 0, 0}, to = {0, 0, 0};
            to[axis] = static_cast<double>(a_.extent[axis]);
            placement.rotation = {};
            move(placement, to_world(b_, from[0], from[1], from[2]), to_world(a_, to[0], to[1], to[2]));
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

std::string describe(const Placement& placement) {
    char text[256];
    const auto d = [](float x) { return static_cast<double>(x); };
    std::snprintf(text, sizeof text, "rotation %a %a %a %a translation %a %a %a scale %a", d(placement.rotation.x),
                  d(placement.rotation.y), d(placement.rotation.z), d(placement.rotation.w), d(placement.translation.x),
                  d(placement.translation.y), d(placement.translation.z), d(placement.scale));
    return text;
}

}  // namespace espalier::tests
