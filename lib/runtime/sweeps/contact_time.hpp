// Sweeps of a blob with the time of the contact, which the t of a result with a skin does not contain.
#pragma once

#include <espalier/sweep.hpp>

namespace espalier::detail {

/// Returns what sweep() returns. Where that is a contact, writes the t that it has without a skin.
template <SweptShape Shape>
SweepHit sweep_to_contact(const Blob& blob, const Shape& shape, const Vec3& displacement, const SweepOptions& options,
                          float& contact_t) noexcept;

}  // namespace espalier::detail
