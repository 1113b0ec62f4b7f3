#include <baker/build/spatial.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include <baker/build/clip_triangle.hpp>
#include <baker/build/sah_split.hpp>

namespace espalier::baker {

namespace {

constexpr unsigned spatial_bins = 32;
// Where children overlap by less, of the root's area, no spatial split is tried (Stich et al. 2009, section 4.5).
constexpr float least_overlap = 1e-5f;
// Fewer references fit into one leaf, where a copy brings nothing.
constexpr std::uint32_t least_spatial = 16;

using References = std::vector<Reference>;

/// References to part, and how many copies the parting may make.
struct Work {
    References references;
    LaneBox box;
    LaneBox centers;
    std::uint32_t spare = 0;

    void add(const LaneBox& part, std::uint32_t triangle) {
        Reference reference;
        std::memcpy(&reference, &part, sizeof reference);
        reference.triangle = triangle;
        reference.unused = 0;
        references.push_back(reference);
        include(part);
    }
    void include(const LaneBox& part) {
        box.add(part);
        centers.add(part.lo + part.hi);
    }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(references.size()); }
    [[nodiscard]] float cost() const { return box.half_area() * static_cast<float>(count()); }
};

struct SpatialPlane {
    float cost = infinity;
    unsigned axis = 0;
    float at = 0.0f;
    std::uint32_t copies = 0;
    LaneBox left;
    LaneBox right;
    std::uint32_t left_count = 0;
    std::uint32_t right_count = 0;
};

/// Bins of equal width along one axis, between lattice planes. A reference counts as left of a plane when it has a
/// point below it or lies in it, and as right of it when it has a point above it.
class SpatialBins {
public:
    SpatialBins(const LaneBox& box, unsigned axis) : axis_(axis) {
        const auto low = static_cast<std::int64_t>(box.lo[axis]);
        const auto side = static_cast<std::int64_t>(box.hi[axis]) - low;
        count_ = static_cast<unsigned>(std::min<std::int64_t>(spatial_bins, side));
        for (unsigned i = 1; i < count_; ++i) {
            const std::int64_t plane = low + side * i / count_;
            planes_[i] = static_cast<float>(plane);
        }
    }

    void add(const LatticeMesh& mesh, const Reference& reference) {
        const unsigned last = planes_below(reference.hi[axis_], false);
        const unsigned first = std::min(planes_below(reference.lo[axis_], true), last);
        ++entries_[first];
        ++exits_[last];
        Reference rest = reference;
        for (unsigned bin = first; bin < last; ++bin) {
            const ClippedParts parts = clip(mesh, rest, axis_, planes_[bin + 1]);
            if (!is_empty(parts.left)) boxes_[bin].add(parts.left);
            if (is_empty(parts.right)) return;
            std::memcpy(&rest, &parts.right, sizeof rest);
            rest.triangle = reference.triangle;
        }
        boxes_[last].add(lane_box_of(rest));
    }

    void try_planes(std::uint32_t reference_count, std::uint32_t spare, SpatialPlane& best) const {
        if (count_ < 2) return;
        std::array<LaneBox, spatial_bins> rights;
        std::array<std::uint32_t, spatial_bins> right_counts{};
        LaneBox right;
        std::uint32_t right_count = 0;
        for (unsigned bin = count_ - 1; bin > 0; --bin) {
            right.add(boxes_[bin]);
            right_count += exits_[bin];
            rights[bin] = right;
            right_counts[bin] = right_count;
        }
        LaneBox left;
        std::uint32_t left_count = 0;
        for (unsigned bin = 1; bin < count_; ++bin) {
            left.add(boxes_[bin - 1]);
            left_count += entries_[bin - 1];
            if (is_empty(left) || is_empty(rights[bin]) || left_count == 0 || right_counts[bin] == 0) continue;
            const std::uint32_t copies = left_count + right_counts[bin] - reference_count;
            if (copies > spare) continue;
            const float cost = left.half_area() * static_cast<float>(left_count) +
                               rights[bin].half_area() * static_cast<float>(right_counts[bin]);
            if (cost < best.cost) {
                best = {cost, axis_, planes_[bin], copies, left, rights[bin], left_count, right_counts[bin]};
            }
        }
    }

private:
    /// How many planes between bins lie below the coordinate, or at it.
    [[nodiscard]] unsigned planes_below(float coordinate, bool or_at) const {
        unsigned number = 0;
        for (unsigned i = 1; i < count_; ++i)
            number += planes_[i] < coordinate || (or_at && planes_[i] == coordinate) ? 1u : 0u;
        return number;
    }

    unsigned axis_;
    unsigned count_ = 0;
    std::array<float, spatial_bins> planes_{};  // plane i lies between bins i - 1 and i
    std::array<LaneBox, spatial_bins> boxes_;
    std::array<std::uint32_t, spatial_bins> entries_{};
    std::array<std::uint32_t, spatial_bins> exits_{};
};

class SpatialBuilder {
public:
    SpatialBuilder(const LatticeMesh& mesh, const BuildSettings& settings) : mesh_(mesh), settings_(settings) {}

    /// Appends nodes in the order of BinaryTree. Recursion goes no deeper than the height allowed.
    void build(Work work, unsigned depth) {
        const std::size_t node = nodes.size();
        const auto first = static_cast<std::uint32_t>(triangles.size());
        nodes.emplace_back();
        const LaneBox box = work.box;
        if (work.count() == 1) {
            triangles.push_back(work.references.front().triangle);
        } else {
            if (depth == 0) root_area_ = box.half_area();
            auto [left, right] = part(work, depth);
            work.references = {};  // before going down
            build(std::move(left), depth + 1);
            build(std::move(right), depth + 1);
        }
        std::memcpy(&nodes[node], &box, sizeof(BinaryNode));
        nodes[node].first = first;
        nodes[node].count = static_cast<std::uint32_t>(triangles.size()) - first;
    }

    std::vector<BinaryNode> nodes;
    std::vector<std::uint32_t> triangles;

private:
    using Parts = std::pair<Work, Work>;

    Parts part(Work& work, unsigned depth) {
        const bool must_balance = !leaves_room(depth, work.count() - 1, settings_.most_height);
        const SplitRule rule =
            must_balance ? SplitRule{0, 0, 0} : SplitRule{settings_.bins, settings_.exact_below, settings_.full_leaf};
        const auto [left, right] = split(work.references, {0, work.count(), work.box, work.centers}, rule);
        if (!must_balance && work.count() > least_spatial && work.spare > 0 && overlap_of(left.box, right.box)) {
            const float cost = left.box.half_area() * static_cast<float>(left.count) +
                               right.box.half_area() * static_cast<float>(right.count);
            SpatialPlane plane;
            plane.cost = cost;
            for (unsigned axis = 0; axis < 3; ++axis) {
                SpatialBins bins(work.box, axis);
                for (const Reference& reference : work.references) bins.add(mesh_, reference);
                bins.try_planes(work.count(), work.spare, plane);
            }
            if (plane.left_count != 0) {
                Parts parts = part_at(work, plane);
                const std::uint32_t larger_count = std::max(parts.first.count(), parts.second.count());
                const bool is_progress =
                    larger_count < work.count() && parts.first.count() > 0 && parts.second.count() > 0;
                if (is_progress && leaves_room(depth, larger_count, settings_.most_height)) return parts;
            }
        }
        Parts parts;
        parts.first.references.assign(work.references.begin(), work.references.begin() + left.count);
        parts.second.references.assign(work.references.begin() + left.count, work.references.end());
        parts.first.box = left.box;
        parts.first.centers = left.centers;
        parts.second.box = right.box;
        parts.second.centers = right.centers;
        share_out(work.spare, parts);
        return parts;
    }

    [[nodiscard]] bool overlap_of(const LaneBox& left, const LaneBox& right) const {
        LaneBox both;
        both.lo = larger(left.lo, right.lo);
        both.hi = smaller(left.hi, right.hi);
        return !is_empty(both) && both.half_area() > least_overlap * root_area_;
    }

    /// Straddling references go to both sides, or wholly to one where that costs less (Stich et al. 2009, section 4.4).
    Parts part_at(const Work& work, const SpatialPlane& plane) {
        Parts parts;
        Work& left = parts.first;
        Work& right = parts.second;
        LaneBox left_box = plane.left;
        LaneBox right_box = plane.right;
        std::uint32_t left_count = plane.left_count;
        std::uint32_t right_count = plane.right_count;
        for (const Reference& reference : work.references) {
            const LaneBox box = lane_box_of(reference);
            if (reference.hi[plane.axis] <= plane.at) {
                left.add(box, reference.triangle);
                continue;
            }
            if (reference.lo[plane.axis] >= plane.at) {
                right.add(box, reference.triangle);
                continue;
            }
            const ClippedParts clipped = clip(mesh_, reference, plane.axis, plane.at);
            LaneBox all_left = left_box;
            LaneBox all_right = right_box;
            all_left.add(box);
            all_right.add(box);
            const auto l = static_cast<float>(left_count);
            const auto r = static_cast<float>(right_count);
            const float cost_of_both = left_box.half_area() * l + right_box.half_area() * r;
            const float cost_of_left = all_left.half_area() * l + right_box.half_area() * (r - 1.0f);
            const float cost_of_right = left_box.half_area() * (l - 1.0f) + all_right.half_area() * r;
            const bool nothing_left = is_empty(clipped.left);
            const bool nothing_right = is_empty(clipped.right);
            if (nothing_right || (!nothing_left && cost_of_left < cost_of_both && cost_of_left <= cost_of_right)) {
                left.add(nothing_right ? clipped.left : box, reference.triangle);
                if (!nothing_right) left_box = all_left;
                --right_count;
            } else if (nothing_left || cost_of_right < cost_of_both) {
                right.add(nothing_left ? clipped.right : box, reference.triangle);
                if (!nothing_left) right_box = all_right;
                --left_count;
            } else {
                left.add(clipped.left, reference.triangle);
                right.add(clipped.right, reference.triangle);
            }
        }
        const std::uint32_t made = left.count() + right.count() - work.count();
        share_out(work.spare - made, parts);
        return parts;
    }

    /// By cost: copies are worth most where many rays meet many references.
    static void share_out(std::uint32_t spare, Parts& parts) {
        const double left = double(parts.first.cost());
        const double right = double(parts.second.cost());
        const double share = left + right > 0.0 ? left / (left + right) : 0.5;
        // NOLINTNEXTLINE(bugprone-incorrect-roundings): std::lround's long has 32 bits on some machines
        parts.first.spare = std::min(spare, static_cast<std::uint32_t>(share * spare + 0.5));
        parts.second.spare = spare - parts.first.spare;
    }

    const LatticeMesh& mesh_;
    const BuildSettings& settings_;
    float root_area_ = 0.0f;
};

}  // namespace

BinaryTree build_spatial(const LatticeMesh& mesh, const BuildSettings& settings) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    Work all;
    all.references.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) all.include(put_reference(mesh, i, all.references[i]));
    all.spare = static_cast<std::uint32_t>(settings.duplicate_budget * count);
    SpatialBuilder builder(mesh, settings);
    builder.nodes.reserve(subtree_nodes(count + all.spare));
    builder.triangles.reserve(count + all.spare);
    builder.build(std::move(all), 0);
    tree.triangles = std::move(builder.triangles);
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(builder.nodes.size());
    std::copy(builder.nodes.begin(), builder.nodes.end(), tree.nodes.get());
    return tree;
}

}  // namespace espalier::baker
