#include "exercise.hpp"

#include <espalier/espalier.hpp>

#include "run.hpp"
#include "support/blobs/measured_blob.hpp"

namespace espalier::tests {

std::uint64_t exercise(const Blob& blob, Random& random, unsigned rounds, bool sound) {
    using namespace exercises;
    const MeasuredBlob measured(blob);
    Exercise run{measured, random, {}, {}, sound};
    exercise_lookups(run);
    exercise_bounds(run);
    exercise_nodes(run);
    for (unsigned i = 0; i < rounds; ++i) {
        exercise_rays(run);
        exercise_volumes(run);
        exercise_approximate(run);
        exercise_distances(run);
        exercise_contacts(run);
        exercise_sweeps(run);
        exercise_pairs(run);
        exercise_steps(run);
        if (i % 4 == 0) exercise_arrays(run);
    }
    run.verdict.require(measured.is_within_bounds(), "a query took more steps than it may");
    run.verdict.speak();
    return run.hash.value();
}

}  // namespace espalier::tests
