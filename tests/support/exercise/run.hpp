// One run of exercise(): what its parts share. Each part is in the file of its queries.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>

#include <espalier/espalier.hpp>

#include "exercise.hpp"
#include "support/base/answer_hash.hpp"
#include "support/base/random.hpp"
#include "support/blobs/measured_blob.hpp"
#include "support/machine/float_mode.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::exercises {

/// The first thing that was wrong. Kept until the end: nothing may be thrown through the runtime, which has no
/// exceptions.
class Verdict {
public:
    void require(bool holds, const char* what) {
        if (!holds && first_ == nullptr) first_ = what;
    }
    void speak() const {
        if (first_ != nullptr) throw std::runtime_error(first_);
    }

private:
    const char* first_ = nullptr;
};

/// What all exercises share.
struct Exercise {
    const MeasuredBlob& blob;
    Random& random;
    AnswerHash hash;
    Verdict verdict;
    bool sound;  ///< whether the order of a walk changes no answer: boxes hold what is below them
};

inline bool is_number(float value) { return value == value; }

inline Vec3 moved(Vec3 point, Vec3 by) {
    return {plain_sum(point.x, by.x), plain_sum(point.y, by.y), plain_sum(point.z, by.z)};
}

inline Vec3 plain_difference(Vec3 to, Vec3 from) { return moved(to, {-from.x, -from.y, -from.z}); }

inline Vec3 scaled_by(Vec3 v, float factor) {
    return {plain_product(v.x, factor), plain_product(v.y, factor), plain_product(v.z, factor)};
}

inline float plain_dot(Vec3 a, Vec3 b) {
    return plain_sum(plain_sum(plain_product(a.x, b.x), plain_product(a.y, b.y)), plain_product(a.z, b.z));
}

// Each makes some calls of its kind.
void exercise_rays(Exercise& run);
void exercise_arrays(Exercise& run);
void exercise_volumes(Exercise& run);
void exercise_steps(Exercise& run);
void exercise_distances(Exercise& run);
void exercise_contacts(Exercise& run);
void exercise_approximate(Exercise& run);
void exercise_sweeps(Exercise& run);
void exercise_pairs(Exercise& run);
void exercise_lookups(Exercise& run);
void exercise_bounds(Exercise& run);
void exercise_nodes(Exercise& run);

}  // namespace espalier::tests::exercises
