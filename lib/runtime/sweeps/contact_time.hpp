// Sweeps of a blob with the time of the contact, which the t of a result with a skin does not contain.
#pragma once

#include <espalier/sweep.hpp>

namespace espalier::detail {

// Each returns what sweep() returns. Where that is a contact, it writes the t that it has without a skin.
SweepHit sweep_to_contact(const Blob& blob, const Sphere& sphere, const Vec3& displacement, const SweepOptions& options,
                          float& contact_t) noexcept;
SweepHit sweep_to_contact(const Blob& blob, const Capsule& capsule, const Vec3& displacement,
                          const SweepOptions& options, float& contact_t) noexcept;
SweepHit sweep_to_contact(const Blob& blob, const OrientedBox& box, const Vec3& displacement,
                          const SweepOptions& options, float& contact_t) noexcept;
SweepHit sweep_to_contact(const Blob& blob, const ConvexHull& hull, const Vec3& displacement,
                          const SweepOptions& options, float& contact_t) noexcept;

}  // namespace espalier::detail
