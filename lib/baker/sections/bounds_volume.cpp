// How much space the bounds take.
#include <cmath>
#include <vector>

#include <baker/sections/fit_bounds.hpp>
#include <baker/sections/half_spaces.hpp>

namespace espalier::baker {

namespace {

using format::bounds::units_per_step;

}  // namespace

double volume_of(const FittedBox& box) {
    double volume = 1.0;
    for (std::size_t k = 0; k < 3; ++k) volume *= double(box.hi[k] - box.lo[k]) / units_per_step;
    return volume;
}

double volume_of(const FittedSphere& sphere) {
    const double radius = double(sphere.radius) / units_per_step;
    return 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
}

double volume_of(const FittedKDop& k_dop, const LatticePoint& extent) {
    std::vector<HalfSpace> all;
    const auto add = [&](const Point& normal, double lo, double hi) {
        all.push_back({normal, hi});
        all.push_back({-1.0 * normal, -lo});
    };
    add({1.0, 0.0, 0.0}, 0.0, extent.x);
    add({0.0, 1.0, 0.0}, 0.0, extent.y);
    add({0.0, 0.0, 1.0}, 0.0, extent.z);
    for (std::size_t k = 0; k < format::bounds::k_dop_directions; ++k) {
        const auto& d = format::bounds::k_dop_direction[k];
        add({double(d[0]), double(d[1]), double(d[2])}, k_dop.lo[k], k_dop.hi[k]);
    }
    double volume = 0.0;  // of the pyramids from the origin to each face
    const auto faces = faces_of(all, double(extent.x) + extent.y + extent.z);
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::size_t k = 2; k < faces[i].size(); ++k)
            volume += std::abs(dot(faces[i][0], cross(faces[i][k - 1], faces[i][k]))) / 6.0 *
                      (all[i].offset < 0.0 ? -1.0 : 1.0);
    return volume;
}

}  // namespace espalier::baker
