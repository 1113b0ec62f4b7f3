// What tests of espalier.h have in common: blobs, questions, and the comparison of C's answers with C++'s.
#pragma once

#include <span>

#include <espalier/espalier.h>
#include <espalier/espalier.hpp>

#include "asking.h"
#include "support/base/random.hpp"
#include "support/blobs/test_blobs.hpp"

namespace espalier::tests {

inline espalier_vec3 c(Vec3 v) { return {v.x, v.y, v.z}; }

/// Makes a question whose points and lengths are near the blob or hostile.
question some_question(const Blob& blob, Random& random);

/// Requires the same answers to every query from C and from C++.
void compare_all(const espalier_blob& c_blob, const espalier_blob& c_other, const Blob& blob, const Blob& other,
                 const question& asked);

espalier_blob open_from_c(std::span<const std::byte> bytes);

/// Has every optional section.
OpenedBlob blob_with_everything(Profile profile);

OpenedBlob blob_with_copies();

}  // namespace espalier::tests
