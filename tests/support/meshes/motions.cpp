#include "motions.hpp"

#include <algorithm>
#include <cmath>

#include "support/base/random.hpp"

namespace espalier::tests {

namespace {

using Coordinates = std::array<double, 3>;

/// A mesh's box, and its axes by length: `along` is the longest.
struct Frame {
    Coordinates low, high;
    unsigned along, up, across;

    explicit Frame(const std::vector<Vec3>& positions) {
        const Box box = box_around({positions});
        low = {double(box.min.x), double(box.min.y), double(box.min.z)};
        high = {double(box.max.x), double(box.max.y), double(box.max.z)};
        std::array<unsigned, 3> axes = {0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](unsigned a, unsigned b) { return side(a) > side(b); });
        along = axes[0];
        across = axes[1];
        up = axes[2];
    }
    [[nodiscard]] double side(unsigned axis) const { return high[axis] - low[axis]; }
    [[nodiscard]] double middle(unsigned axis) const { return (high[axis] + low[axis]) / 2; }
    /// Returns how far along the longest axis a point is: 0 to 1.
    [[nodiscard]] double share(const Coordinates& p) const {
        return side(along) > 0 ? (p[along] - low[along]) / side(along) : 0.0;
    }
};

constexpr double right_angle = 1.5707963267948966;

Coordinates bent(const Frame& frame, Coordinates p, double amount) {
    const double angle = amount * right_angle;
    if (std::abs(angle) < 1e-9) return p;
    const double radius = frame.side(frame.along) / angle;
    const double turned = angle * frame.share(p);
    const double height = radius - (p[frame.up] - frame.middle(frame.up));
    p[frame.along] = frame.low[frame.along] + height * std::sin(turned);
    p[frame.up] = frame.middle(frame.up) + radius - height * std::cos(turned);
    return p;
}

Coordinates twisted(const Frame& frame, Coordinates p, double amount) {
    const double angle = amount * right_angle * frame.share(p);
    const double x = p[frame.across] - frame.middle(frame.across), y = p[frame.up] - frame.middle(frame.up);
    p[frame.across] = frame.middle(frame.across) + x * std::cos(angle) - y * std::sin(angle);
    p[frame.up] = frame.middle(frame.up) + x * std::sin(angle) + y * std::cos(angle);
    return p;
}

Coordinates folded(const Frame& frame, Coordinates p, double amount) {
    const double beyond = p[frame.along] - frame.middle(frame.along);
    if (beyond > 0) p[frame.along] -= 2 * amount * beyond;
    return p;
}

Coordinates moved(const Frame& frame, Coordinates p, Motion motion, double amount, Random& random) {
    switch (motion) {
        case Motion::rest:
            break;
        case Motion::bend:
            return bent(frame, p, amount);
        case Motion::twist:
            return twisted(frame, p, amount);
        case Motion::wave:
            p[frame.up] += 0.1 * amount * frame.side(frame.along) * std::sin(12.0 * frame.share(p));
            break;
        case Motion::fold:
            return folded(frame, p, amount);
        case Motion::collapse:
            p[frame.up] += amount * (frame.middle(frame.up) - p[frame.up]);
            // Beyond the middle also to a line.
            if (frame.share(p) > 0.5) p[frame.across] += amount * (frame.middle(frame.across) - p[frame.across]);
            break;
        case Motion::noise:
            for (double& c : p) c += 0.1 * amount * frame.side(frame.along) * double(random.signed_unit());
            break;
        case Motion::point:
            p = {frame.middle(0), frame.middle(1), frame.middle(2)};
            break;
    }
    return p;
}

}  // namespace

std::string name_of(Motion motion) {
    constexpr std::array names = {"rest", "bend", "twist", "wave", "fold", "collapse", "noise", "point"};
    return names[static_cast<std::size_t>(motion)];
}

std::vector<Vec3> posed(const Mesh& mesh, Motion motion, double amount, std::uint64_t seed) {
    std::vector<Vec3> positions = mesh.positions;
    const Frame frame(positions);
    Random random(seed);
    for (Vec3& p : positions) {
        const Coordinates q = moved(frame, {double(p.x), double(p.y), double(p.z)}, motion, amount, random);
        p = {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])};
    }
    return positions;
}

std::vector<std::vector<Vec3>> every_pose(const Mesh& mesh) {
    std::vector<std::vector<Vec3>> poses;
    for (const Motion motion : every_motion)
        if (motion != Motion::rest) poses.push_back(posed(mesh, motion));
    return poses;
}

Box box_around(const std::vector<std::vector<Vec3>>& poses) {
    Box box = {poses.front().front(), poses.front().front()};
    for (const std::vector<Vec3>& pose : poses)
        for (const Vec3& p : pose) {
            box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
            box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
        }
    return box;
}

}  // namespace espalier::tests
