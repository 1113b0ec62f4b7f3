#include "instruction_paths.hpp"

#include <runtime/simd/select.hpp>

/// By the name of the one that single rays take, and of the one for everything else.
#define ESPALIER_PATH_OF(rays, set)                                                                                 \
    InstructionPath {                                                                                               \
#rays, detail::rays::closest_hit, detail::rays::first_hits, detail::rays::any_hit, detail::rays::every_hit, \
            detail::set::closest_hits, detail::set::any_hits, detail::set::any_overlap, detail::set::every_overlap, \
            detail::set::closest_triangle, detail::set::closest_triangles, detail::set::may_overlap,                \
            detail::set::closest_bounds, detail::rays::may_hit, detail::rays::closest_hit_on_lattice,               \
            detail::rays::any_hit_on_lattice, detail::set::touching_pairs, detail::set::nearest_pair                \
    }
#define ESPALIER_PATH(set) ESPALIER_PATH_OF(set, set)

namespace espalier::tests {

const std::vector<InstructionPath>& instruction_paths() {
    static const std::vector<InstructionPath> paths = [] {
        std::vector<InstructionPath> found = {ESPALIER_PATH(scalar), ESPALIER_PATH_OF(small, scalar)};
#if ESPALIER_X86
        const detail::InstructionSet best = detail::detect_instruction_set();
        using detail::InstructionSet;  // each has all of those before it
        if (best >= InstructionSet::sse42) found.push_back(ESPALIER_PATH(sse42));
        if (best >= InstructionSet::avx2) found.push_back(ESPALIER_PATH(avx2));
#if defined(__x86_64__)
        if (best >= InstructionSet::avx512) found.push_back(ESPALIER_PATH(avx512));
#endif
#elif ESPALIER_NEON
        found.push_back(ESPALIER_PATH(neon));
#elif ESPALIER_SIMD128
        found.push_back(ESPALIER_PATH(simd128));
#endif
        return found;
    }();
    return paths;
}

}  // namespace espalier::tests
