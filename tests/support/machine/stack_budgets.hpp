// How many bytes of stack each query may take.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>

#include "chosen_instruction_set.hpp"
#include "stack_use.hpp"

namespace espalier::tests {

/// For the instruction sets scalar, sse42, avx2 and avx512, with libraries compiled with -O1 and, in a Release build,
/// with -O3. A budget is a measured count of GCC 12 on x86-64 plus 4 %, up to a multiple of 64.
struct StackBudget {
    const char* query;
    std::size_t slow[4], fast[4];
};
inline constexpr StackBudget stack_budgets[] = {
    {"open", {1536, 1536, 1536, 1536}, {832, 832, 832, 832}},
    {"raycast", {1536, 2304, 2368, 2496}, {1664, 2176, 2176, 2048}},
    {"raycast, the inner query", {2048, 2240, 2368, 2496}, {1920, 2176, 2176, 2048}},
    {"closest_point, the inner query", {2240, 2752, 3584, 4992}, {2304, 3072, 3904, 3712}},
    {"raycast, a rounded ray", {1792, 2496, 2688, 2880}, {1920, 2688, 2432, 2368}},
    {"occluded", {1472, 2176, 2240, 2432}, {1600, 2304, 2048, 1920}},
    {"raycast, a batch", {1600, 11456, 12352, 12480}, {1792, 11712, 12032, 11904}},
    {"occluded, a batch", {1600, 11456, 12352, 12480}, {1728, 11712, 11968, 11776}},
    {"raycast, arrays", {6656, 16576, 17472, 17664}, {6848, 16768, 17088, 16960}},
    {"for_each_hit", {1664, 2432, 2496, 2688}, {1728, 2240, 2304, 2176}},
    {"for_each_crossing", {1792, 2432, 2496, 2688}, {1792, 2240, 2304, 2176}},
    {"closest_hits", {1664, 2304, 2560, 2816}, {1792, 2624, 2368, 2240}},
    {"find_contacts, a capsule", {6976, 6720, 7424, 8896}, {6592, 7104, 6912, 6528}},
    {"collect_planes", {9856, 9920, 10048, 11520}, {9856, 9920, 10048, 11520}},
    {"find_contacts, a box", {6784, 6592, 7296, 8768}, {6464, 7040, 6912, 6464}},
    {"find_contacts, a hull", {8896, 9408, 10112, 11584}, {9280, 9856, 9728, 9344}},
    {"overlaps, two blobs", {5504, 6656, 8640, 13120}, {4928, 6272, 6848, 6592}},
    {"collect_contacts, resumed", {5760, 6912, 8896, 13376}, {5184, 6464, 7104, 6848}},
    {"collect_touches", {5888, 7040, 9024, 13504}, {5312, 6592, 7232, 6976}},
    {"pair_touch", {2112, 2112, 2112, 2112}, {2432, 2432, 2432, 2432}},
    {"distance, two blobs", {5824, 6976, 8960, 13440}, {5184, 6464, 7104, 6848}},
    {"pairs of triangles, the inner query", {5184, 6272, 8256, 12736}, {4608, 6016, 6464, 6272}},
    {"sweep, a sphere", {3456, 4288, 5824, 8320}, {3712, 5120, 5760, 6976}},
    {"sweep, a capsule", {3520, 4480, 6336, 9152}, {3712, 5376, 6272, 8000}},
    {"sweep, a box", {3072, 3776, 4736, 6208}, {3264, 4480, 4864, 5440}},
    {"sweep, an oriented box", {5376, 5952, 7168, 8512}, {5504, 6976, 7232, 7808}},
    {"sweep, a hull", {5184, 5952, 7168, 8576}, {5504, 6976, 7232, 7872}},
    {"overlaps", {1856, 1984, 2944, 2624}, {1920, 2240, 2624, 1536}},
    {"for_each_overlap", {1920, 2048, 2944, 2688}, {1984, 2304, 2688, 1600}},
    {"may_overlap and distance_bounds", {2496, 2944, 3840, 5248}, {2368, 3264, 4096, 3904}},
    {"occluded with an accuracy", {1600, 2368, 2432, 2688}, {1728, 2112, 2240, 2112}},
    {"overlaps and pages, a capsule", {2944, 3072, 3776, 3712}, {3072, 2944, 3072, 3008}},
    {"overlaps and pages, a box", {1728, 1984, 2560, 2304}, {1920, 2112, 2496, 1856}},
    {"overlaps and pages, an oriented box", {2496, 3072, 3648, 3328}, {2816, 2688, 2880, 2752}},
    {"overlaps and pages, a cone", {2688, 2688, 2816, 2688}, {2816, 2688, 2816, 2752}},
    {"overlaps and pages, a triangle", {2688, 2624, 2688, 2688}, {2304, 2176, 2624, 2240}},
    {"overlaps and pages, planes", {2752, 2688, 3328, 3008}, {2944, 2816, 3200, 2880}},
    {"closest_point", {2560, 3008, 3904, 5248}, {2496, 3392, 4224, 4096}},
    {"closest_triangles", {2496, 3008, 3840, 5248}, {2496, 3392, 4160, 4032}},
    {"closest_point, a segment", {3072, 3456, 4224, 5760}, {3584, 3776, 4800, 5056}},
    {"closest_point, a box", {3264, 3584, 4544, 6080}, {3584, 3904, 4864, 5312}},
    {"contains", {1920, 1920, 1920, 1920}, {1472, 1472, 1472, 1472}},
    {"winding_number", {1984, 2688, 2688, 2880}, {2048, 2496, 2496, 2432}},
    {"signed_distance", {2688, 3136, 3840, 5120}, {2752, 3648, 3584, 4096}},
    {"for_each_node", {1280, 1280, 1280, 1280}, {1280, 1280, 1280, 1280}},
    {"fix_internal_edge_normal", {832, 832, 832, 832}, {576, 576, 576, 576}},
    {"triangle_at", {640, 640, 640, 640}, {576, 576, 576, 576}},
    {"oriented_bounds", {320, 320, 320, 320}, {256, 256, 256, 256}},
    {"open, predicted", {2496, 2496, 2496, 2496}, {2624, 2624, 2624, 2624}},
    {"raycast, predicted", {2240, 2880, 5184, 5568}, {2176, 2816, 3648, 3136}},
    {"raycast, the inner query, predicted", {2816, 2880, 5184, 5504}, {2752, 2816, 3648, 3136}},
    {"closest_point, the inner query, predicted", {3008, 3456, 4224, 5504}, {2944, 3840, 3840, 4352}},
    {"raycast, a rounded ray, predicted", {2496, 3136, 5440, 5760}, {2432, 3072, 3840, 3392}},
    {"occluded, predicted", {2240, 2816, 5120, 5440}, {2112, 2688, 3520, 3008}},
    {"raycast, a batch, predicted", {2368, 10752, 12480, 12672}, {2304, 11392, 11328, 11648}},
    {"occluded, a batch, predicted", {2304, 10752, 12480, 12672}, {2240, 11328, 11264, 11584}},
    {"raycast, arrays, predicted", {7424, 15872, 17600, 17792}, {7360, 16448, 16384, 16704}},
    {"for_each_hit, predicted", {2432, 3072, 5312, 5632}, {2240, 2944, 3712, 3264}},
    {"for_each_crossing, predicted", {2496, 3072, 5312, 5632}, {2304, 2944, 3712, 3264}},
    {"closest_hits, predicted", {2432, 3008, 5312, 5696}, {2304, 3008, 3840, 3328}},
    {"find_contacts, a capsule, predicted", {8448, 8192, 8960, 10368}, {8064, 8576, 8512, 8064}},
    {"collect_planes, predicted", {11264, 11328, 11392, 12800}, {11264, 11328, 11392, 12800}},
    {"find_contacts, a box, predicted", {7552, 8064, 8832, 10240}, {7936, 8512, 8448, 8000}},
    {"find_contacts, a hull, predicted", {10368, 10880, 11648, 13056}, {10752, 11392, 11264, 10752}},
    {"overlaps, two blobs, predicted", {6784, 7872, 9856, 14336}, {6144, 7488, 8064, 7872}},
    {"collect_contacts, resumed, predicted", {6976, 8064, 10112, 14592}, {6400, 7680, 8256, 8064}},
    {"collect_touches, predicted", {7104, 8192, 10240, 14720}, {6528, 7808, 8448, 8192}},
    {"pair_touch, predicted", {3584, 3584, 3584, 3584}, {3520, 3520, 3520, 3520}},
    {"distance, two blobs, predicted", {7104, 8192, 10176, 14656}, {6400, 7680, 8256, 8064}},
    {"pairs of triangles, the inner query, predicted", {5184, 6272, 8256, 12736}, {4608, 6016, 6464, 6272}},
    {"sweep, a sphere, predicted", {4224, 4992, 6464, 8832}, {4416, 5824, 6912, 8064}},
    {"sweep, a capsule, predicted", {4224, 5248, 6976, 9728}, {4480, 6144, 7424, 9024}},
    {"sweep, a box, predicted", {3776, 4480, 5376, 6720}, {3968, 5248, 6016, 6528}},
    {"sweep, an oriented box, predicted", {6080, 6656, 7808, 9088}, {6208, 7680, 8320, 8768}},
    {"sweep, a hull, predicted", {5888, 6656, 7808, 9152}, {6208, 7744, 8384, 8832}},
    {"overlaps, predicted", {2624, 2752, 3456, 3008}, {2688, 3008, 2816, 2752}},
    {"for_each_overlap, predicted", {2688, 2752, 3520, 3072}, {2752, 3072, 2880, 2816}},
    {"may_overlap and distance_bounds, predicted", {3200, 3648, 4480, 5824}, {3136, 4032, 4032, 4480}},
    {"occluded with an accuracy, predicted", {2368, 3008, 5312, 5632}, {2240, 2880, 3712, 3200}},
    {"overlaps and pages, a capsule, predicted", {3712, 3904, 4480, 4416}, {3840, 3648, 3776, 3712}},
    {"overlaps and pages, a box, predicted", {2752, 2688, 3136, 2880}, {2752, 2816, 3072, 2752}},
    {"overlaps and pages, an oriented box, predicted", {3264, 3776, 4352, 4096}, {3584, 3392, 3520, 3456}},
    {"overlaps and pages, a cone, predicted", {3456, 3392, 3456, 3456}, {3584, 3456, 3584, 3520}},
    {"overlaps and pages, a triangle, predicted", {3456, 3328, 3456, 3392}, {3072, 2944, 3264, 3008}},
    {"overlaps and pages, planes, predicted", {3520, 3456, 3904, 3584}, {3712, 3584, 3904, 3648}},
    {"closest_point, predicted", {3264, 3712, 4544, 5824}, {3200, 4160, 4160, 4608}},
    {"closest_triangles, predicted", {3264, 3712, 4480, 5824}, {3200, 4096, 4096, 4608}},
    {"closest_point, a segment, predicted", {3840, 4160, 4928, 6528}, {4160, 4544, 5568, 5696}},
    {"closest_point, a box, predicted", {3968, 4288, 5312, 6784}, {4352, 4672, 5632, 6080}},
    {"contains, predicted", {2880, 2816, 3008, 3008}, {3072, 3072, 3072, 3072}},
    {"winding_number, predicted", {2688, 3264, 5504, 5824}, {2496, 3200, 3968, 3456}},
    {"signed_distance, predicted", {3392, 3840, 4672, 5888}, {3456, 4352, 4416, 4864}},
    {"for_each_node, predicted", {3072, 3072, 3072, 3072}, {2944, 2944, 2944, 2944}},
    {"fix_internal_edge_normal, predicted", {2624, 2624, 2624, 2624}, {2304, 2304, 2304, 2304}},
    {"triangle_at, predicted", {2432, 2432, 2432, 2432}, {2240, 2240, 2240, 2240}},
    {"oriented_bounds, predicted", {320, 320, 320, 320}, {256, 256, 256, 256}},
    {"scene, open_scene", {3456, 3456, 3456, 3456}, {3584, 3584, 3584, 3584}},
    {"scene of tiles, open_scene", {3456, 3456, 3456, 3456}, {3584, 3584, 3584, 3584}},
    {"scene, raycast", {3392, 4032, 4800, 5120}, {3328, 4096, 4736, 4224}},
    {"scene of tiles, raycast", {4480, 5120, 5952, 6272}, {4544, 5632, 5824, 5312}},
    {"scene, occluded", {3328, 3968, 4672, 4992}, {3520, 4224, 4800, 4160}},
    {"scene of tiles, occluded", {4352, 5056, 5760, 6144}, {4736, 5696, 5440, 4864}},
    {"scene, for_each_hit", {3648, 4352, 5120, 5312}, {3776, 4288, 5120, 4608}},
    {"scene of tiles, for_each_hit", {5056, 5568, 6272, 6592}, {5248, 6016, 5952, 5376}},
    {"scene, closest_point", {4288, 4672, 5824, 6848}, {4352, 5120, 4992, 5504}},
    {"scene of tiles, closest_point", {5312, 5696, 7232, 7872}, {5184, 6080, 5952, 6400}},
    {"scene, overlaps, a sphere", {3840, 3968, 4480, 4288}, {4160, 4608, 4096, 3904}},
    {"scene of tiles, overlaps, a sphere", {5120, 5248, 5504, 5248}, {5504, 6016, 5184, 4992}},
    {"scene, overlaps, a capsule", {4864, 5056, 5760, 5952}, {5248, 5184, 4992, 4928}},
    {"scene of tiles, overlaps, a capsule", {6016, 6336, 6912, 6976}, {6144, 6272, 5760, 5696}},
    {"scene, overlaps, a box", {4736, 5120, 5696, 5760}, {5056, 4992, 4864, 4736}},
    {"scene of tiles, overlaps, a box", {5824, 6336, 6912, 7104}, {6336, 6464, 5952, 5888}},
    {"scene, overlaps, an oriented box", {4608, 5056, 5632, 5504}, {4992, 4992, 4800, 4736}},
    {"scene of tiles, overlaps, an oriented box", {5824, 6272, 6848, 7104}, {6336, 6400, 5952, 5888}},
    {"scene, overlaps, a triangle", {4800, 4800, 4608, 4800}, {4480, 4480, 4416, 4224}},
    {"scene of tiles, overlaps, a triangle", {5952, 5952, 5696, 6016}, {5824, 5952, 5568, 5376}},
    {"scene, overlaps, a cone", {4608, 4800, 4608, 4800}, {4992, 4928, 4800, 4736}},
    {"scene of tiles, overlaps, a cone", {5952, 5952, 5696, 6016}, {6272, 6400, 5888, 5824}},
    {"scene, sweep, a sphere", {5312, 6080, 7488, 9984}, {5696, 7296, 7936, 9152}},
    {"scene of tiles, sweep, a sphere", {6464, 7232, 8640, 11136}, {6976, 8704, 9024, 10304}},
    {"scene, sweep, a capsule", {5312, 6336, 8000, 10816}, {5568, 7552, 8512, 10240}},
    {"scene of tiles, sweep, a capsule", {6464, 7488, 9152, 12032}, {6976, 9024, 9664, 11392}},
    {"scene, sweep, a box", {7232, 7808, 8832, 10240}, {7296, 9152, 9408, 9984}},
    {"scene of tiles, sweep, a box", {8384, 8960, 10048, 11456}, {8576, 10624, 10560, 11136}},
    {"scene, sweep, an oriented box", {7232, 7808, 8832, 10240}, {7296, 9152, 9408, 9984}},
    {"scene of tiles, sweep, an oriented box", {8384, 8960, 10048, 11456}, {8576, 10624, 10560, 11136}},
    {"scene, sweep, a hull", {7872, 8640, 9664, 11072}, {8064, 9920, 10176, 10752}},
    {"scene of tiles, sweep, a hull", {9856, 10624, 11712, 13056}, {10112, 12160, 12096, 12736}},
    {"scene, for_each_candidate", {1216, 1280, 1280, 1280}, {1088, 1216, 960, 960}},
    {"scene of tiles, for_each_candidate", {1920, 1856, 1856, 1984}, {2112, 2368, 1856, 1856}},
    {"refit", {1024, 1024, 1024, 1024}, {1300, 1300, 1300, 1300}},
    {"seal and create_deformable", {384, 384, 384, 384}, {512, 512, 512, 512}},
};

/// Compares the stack that a query was measured to take on the chosen instruction set with its budget. Other sets than
/// those of x86 have the largest of the four.
inline void check_stack(const std::string& query, std::size_t most) {
    const auto budget = std::find_if(std::begin(stack_budgets), std::end(stack_budgets),
                                     [&](const StackBudget& each) { return query == each.query; });
    const detail::InstructionSet set = detail::instruction_set();
    const std::string on_set = name_of(set) + (": " + query);
    REQUIRE_MESSAGE(budget != std::end(stack_budgets), on_set);
#ifdef NDEBUG
    const auto& of_sets = budget->fast;
#else
    const auto& of_sets = budget->slow;
#endif
    const std::size_t at_most = set <= detail::InstructionSet::avx512 ? of_sets[static_cast<unsigned>(set)]
                                                                      : *std::max_element(of_sets, of_sets + 4);
    MESSAGE(on_set, ": ", most, " bytes of stack, budget ", at_most);
    CHECK_MESSAGE(most <= at_most, on_set);
}

/// The most stack that each query took on the chosen instruction set.
class StackMeter {
public:
    void measure(const std::string& query, FunctionRef<void()> call) {
        std::size_t& most = most_[query];
        most = std::max(most, stack_use(call));
    }
    void check() const {
        for (const auto& [query, most] : most_) check_stack(query, most);
    }

private:
    std::map<std::string, std::size_t> most_;
};

}  // namespace espalier::tests
