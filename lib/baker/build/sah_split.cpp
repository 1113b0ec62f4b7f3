#include <baker/build/sah_split.hpp>

#include <algorithm>
#include <array>

#include <baker/build/leaves_added.hpp>

namespace espalier::baker {

namespace {

using Parts = std::pair<SplitRange, SplitRange>;

Lanes center_of(const LaneBox& box) { return box.lo + box.hi; }

void add(SplitRange& range, const Reference& reference) {
    const LaneBox box = lane_box_of(reference);
    range.box.add(box);
    range.centers.add(center_of(box));
}

/// The parts when the first `left_count` references stay left.
Parts parts_at(std::span<const Reference> references, std::uint32_t first, std::uint32_t left_count) {
    const auto count = static_cast<std::uint32_t>(references.size());
    Parts parts{{first, left_count, {}, {}}, {first + left_count, count - left_count, {}, {}}};
    for (std::uint32_t i = 0; i < left_count; ++i) add(parts.first, references[i]);
    for (std::uint32_t i = left_count; i < count; ++i) add(parts.second, references[i]);
    return parts;
}

/// Halves along the axis in which the centres spread most.
Parts split_in_halves(std::span<Reference> references, const SplitRange& range) {
    const Lanes spread = range.centers.hi - range.centers.lo;
    const unsigned axis = spread[0] >= spread[1] && spread[0] >= spread[2] ? 0 : spread[1] >= spread[2] ? 1 : 2;
    const std::uint32_t left_count = range.count / 2;
    std::nth_element(references.begin(), references.begin() + left_count, references.end(), ByCenter{axis});
    return parts_at(references, range.first, left_count);
}

/// Every split of the order along every axis.
Parts split_exactly(std::span<Reference> references, const SplitRange& range) {
    float best_cost = infinity;
    unsigned best_axis = 0;
    std::uint32_t best_left = 1;
    std::array<float, max_exact + 1> right_costs;
    for (unsigned axis = 0; axis < 3; ++axis) {
        std::sort(references.begin(), references.end(), ByCenter{axis});
        LaneBox right;
        for (std::uint32_t i = range.count - 1; i > 0; --i) {
            right.add(lane_box_of(references[i]));
            right_costs[i] = right.half_area() * static_cast<float>(range.count - i);
        }
        LaneBox left;
        for (std::uint32_t i = 1; i < range.count; ++i) {
            left.add(lane_box_of(references[i - 1]));
            const float cost = left.half_area() * static_cast<float>(i) + right_costs[i];
            if (cost < best_cost) {
                best_cost = cost;
                best_axis = axis;
                best_left = i;
            }
        }
    }
    if (best_axis != 2) std::sort(references.begin(), references.end(), ByCenter{best_axis});
    return parts_at(references, range.first, best_left);
}

struct Bins {
    std::array<std::array<LaneBox, max_bins>, 3> boxes;
    std::array<std::array<std::uint32_t, max_bins>, 3> counts;
};

struct Plane {
    float cost = infinity;
    unsigned axis = 0;
    unsigned bin = 0;  ///< the first bin on the right
};

/// A map from centres to bin numbers: always by the same two roundings, and just below `bins` at the far end.
struct Binning {
    Lanes low;
    Lanes scale;

    Binning(const LaneBox& centers, unsigned bins) : low(centers.lo) {
        const Lanes spread = centers.hi - centers.lo;
        for (int axis = 0; axis < 4; ++axis) {
            scale[axis] = spread[axis] > 0.0f && axis < 3 ? static_cast<float>(bins) * 0.9999f / spread[axis] : 0.0f;
        }
    }
    [[nodiscard]] IntegerLanes bins_of(Lanes center) const {
        return __builtin_convertvector((center - low) * scale, IntegerLanes);
    }
};

void fill(Bins& bins, unsigned bin_count, std::span<const Reference> references, const Binning& binning) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        std::fill_n(bins.boxes[axis].begin(), bin_count, LaneBox{});
        std::fill_n(bins.counts[axis].begin(), bin_count, 0u);
    }
    for (const Reference& reference : references) {
        const LaneBox box = lane_box_of(reference);
        const IntegerLanes bin = binning.bins_of(center_of(box));
        for (unsigned axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(bin[axis]);
            bins.boxes[axis][at].add(box);
            ++bins.counts[axis][at];
        }
    }
}

void try_planes(const Bins& bins, unsigned bin_count, unsigned axis, const LeavesAdded& leaves, Plane& best) {
    const auto& boxes = bins.boxes[axis];
    const auto& counts = bins.counts[axis];
    std::array<float, max_bins> right_costs;
    LaneBox right;
    std::uint32_t right_count = 0;
    for (unsigned bin = bin_count - 1; bin > 0; --bin) {
        right.add(boxes[bin]);
        right_count += counts[bin];
        right_costs[bin] = right_count == 0 ? infinity : right.half_area() * static_cast<float>(right_count);
    }
    LaneBox left;
    std::uint32_t left_count = 0;
    for (unsigned bin = 1; bin < bin_count; ++bin) {
        left.add(boxes[bin - 1]);
        left_count += counts[bin - 1];
        if (left_count == 0) continue;
        const float areas = left.half_area() * static_cast<float>(left_count) + right_costs[bin];
        const float cost = areas + leaves.cost(left_count);
        if (cost < best.cost) best = {cost, axis, bin};
    }
}

/// Moves what lies left of the plane to the front, without a branch for each reference, and gathers both parts'
/// centres.
Parts partition(std::span<Reference> references, const SplitRange& range, const Binning& binning, const Plane& plane,
                const Bins& bins, unsigned bin_count) {
    LaneBox left_centers;
    LaneBox right_centers;
    std::size_t left_count = 0;
    for (std::size_t i = 0; i < references.size(); ++i) {
        const Reference reference = references[i];
        const Lanes center = center_of(lane_box_of(reference));
        const bool is_left = static_cast<unsigned>(binning.bins_of(center)[plane.axis]) < plane.bin;
        references[i] = references[left_count];
        references[left_count] = reference;
        left_count += is_left ? 1 : 0;
        const IntegerLanes mask = IntegerLanes{} - (is_left ? 1 : 0);
        const Lanes never_low = {infinity, infinity, infinity, infinity};
        left_centers.add(mask ? center : never_low, mask ? center : -never_low);
        right_centers.add(mask ? never_low : center, mask ? -never_low : center);
    }
    LaneBox left_box;
    LaneBox right_box;
    for (unsigned bin = 0; bin < bin_count; ++bin) {
        (bin < plane.bin ? left_box : right_box).add(bins.boxes[plane.axis][bin]);
    }
    const auto left = static_cast<std::uint32_t>(left_count);
    return {{range.first, left, left_box, left_centers},
            {range.first + left, range.count - left, right_box, right_centers}};
}

}  // namespace

LaneBox put_reference(const LatticeMesh& mesh, std::uint32_t triangle, Reference& reference) {
    LaneBox box;
    for (const std::uint32_t corner : mesh.triangles[triangle].corners) {
        const LatticePoint& point = mesh.vertices[corner];
        box.add(Lanes{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z), 0.0f});
    }
    std::memcpy(&reference, &box, sizeof reference);
    reference.triangle = triangle;
    reference.unused = 0;
    return box;
}

Parts split(std::span<Reference> references, const SplitRange& range, const SplitRule& rule) {
    if (range.count == 2) return parts_at(references, range.first, 1);
    if (rule.bins == 0) return split_in_halves(references, range);
    if (range.count <= rule.exact_below) return split_exactly(references, range);
    const unsigned bin_count = std::min(rule.bins, 4 + range.count / 2);
    const Binning binning(range.centers, bin_count);
    Bins bins;
    fill(bins, bin_count, references, binning);
    const LeavesAdded leaves(range.count, range.box.half_area(), rule.full_leaf);
    Plane best;
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (binning.scale[axis] > 0.0f) try_planes(bins, bin_count, axis, leaves, best);
    }
    if (best.cost == infinity) return split_in_halves(references, range);
    return partition(references, range, binning, best, bins, bin_count);
}

}  // namespace espalier::baker
