// How often an open surface winds around a point: the mean of what rays in many directions count.
#include <espalier/distance.hpp>
#include <espalier/ray.hpp>
#include <runtime/base/bits.hpp>

namespace espalier {

using namespace detail;

namespace {

/// The points of a Fibonacci lattice on the upper half of the unit sphere, one after the other.
class HalfSphere {
public:
    explicit HalfSphere(unsigned count) : step_(1.0f / static_cast<float>(count)) {}

    /// Returns the next direction, of about unit length.
    Vec3 next() {
        const float z = (static_cast<float>(number_) + 0.5f) * step_;
        const float radius = square_root((1.0f - z) * (1.0f + z));
        const Vec3 direction = {radius * cosine_, radius * sine_, z};
        // Turns by the golden angle, pi * (3 - sqrt(5)).
        constexpr float cosine = -0.737368878f, sine = 0.675490294f;
        const float turned = cosine_ * cosine - sine_ * sine;
        sine_ = cosine_ * sine + sine_ * cosine;
        cosine_ = turned;
        ++number_;
        return direction;
    }

private:
    float step_;
    unsigned number_ = 0;
    float cosine_ = 1.0f;
    float sine_ = 0.0f;
};

/// Adds what a ray counts: 1 where it leaves the surface's inside, -1 where it enters.
QueryStatus add_crossings(const Blob& blob, const Ray& ray, std::int64_t& sum) {
    return for_each_crossing(blob, ray, [&sum](const RayHit& hit) { sum += hit.side == Side::back ? 1 : -1; });
}

}  // namespace

Result<float> winding_number(const Blob& blob, Vec3 point, unsigned directions) noexcept {
    Result<float> winding;
    winding.status = blob ? QueryStatus::invalid_argument : QueryStatus::not_open;
    if (!blob || directions < 2 || directions > max_winding_directions) return winding;
    const unsigned pairs = (directions + 1) / 2;
    HalfSphere lattice(pairs);
    std::int64_t sum = 0;
    for (unsigned i = 0; i < pairs; ++i) {
        const Vec3 up = lattice.next();
        for (const Vec3& way : {up, Vec3{-up.x, -up.y, -up.z}}) {
            winding.status = add_crossings(blob, {.origin = point, .direction = way}, sum);
            if (winding.status != QueryStatus::ok) return winding;
        }
    }
    winding.value = static_cast<float>(sum) / static_cast<float>(2 * pairs);
    return winding;
}

}  // namespace espalier
