// A blob that counts what each query on it does, and holds it against the bound that docs/queries/README.md states.
// Counts only in builds with ESPALIER_COUNT_STEPS, as those with sanitizers are; in others it is the blob and nothing
// more.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/options.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/lanes/select.hpp>

namespace espalier::tests {

/// Whether the code of small cores answers single rays: there, and where the processor has no lanes and the scalar set
/// is small.
inline bool small_code_casts_rays() {
    return !detail::has_fast_scalar && detail::instruction_set() == detail::InstructionSet::scalar;
}

class MeasuredBlob {
public:
    explicit MeasuredBlob(const Blob& blob) : blob_(blob) {
        for (std::uint32_t i = 0; i < detail::data_of(blob).node_count; ++i)
            leaves_ += format::has_plain_nodes(blob.profile())
                           ? detail::node_at<detail::PlainNode>(detail::data_of(blob), i).leaf_children()
                           : detail::node_at<detail::PackedNode>(detail::data_of(blob), i).leaf_children();
    }

    /// For a query that walks the tree once, as nearly all do. The one before is measured then.
    operator const Blob&() const { return for_walks(1); }  // NOLINT(google-explicit-constructor)
    /// For one that may walk so many times: a batch, once for each ray.
    [[nodiscard]] const Blob& for_walks(std::uint64_t walks, std::uint64_t look_ups = 0) const {
        // How often a node's children are asked about at most; a leaf is visited at most once. Small code asks again.
        const std::uint64_t children = format::max_node_children(blob_.profile());
        const std::uint64_t times = small_code_casts_rays() ? children : children / 2;
        return allow(times * walks * detail::data_of(blob_).node_count + look_ups * format::max_depth,
                     walks * leaves_ + look_ups * format::max_children);
    }
    /// For a list, and for what counts triangles, besides other walks: each duplicate reference may take one more, and
    /// its triangle is looked up.
    [[nodiscard]] const Blob& for_lists(std::uint64_t other_walks = 0) const {
        const std::uint64_t duplicates = blob_.duplicate_reference_count();
        return for_walks(1 + other_walks + duplicates, duplicates);
    }
    /// For contacts: whether the middle is inside, the closest point of it, then a list. With edge flags the closest
    /// point of the middle once more, and each triangle of the list looks for those at its edges and corners, and for
    /// those at its place. Small code searches the leaf of each triangle of the list.
    [[nodiscard]] const Blob& for_contacts() const {
        const std::uint64_t duplicates = blob_.duplicate_reference_count();
        const std::uint64_t around = blob_.has_edge_flags() ? 1 + 7 * std::uint64_t{blob_.triangle_count()} : 0;
        return for_walks(3 + around + 2 * duplicates,
                         2 * duplicates + (detail::small_code ? blob_.triangle_count() : 0));
    }
    /// For two blobs under a limit of work; a pair that touches may be looked up once more, each of its triangles by
    /// one way down. With duplicate references many pairs may be, each before a walk that counts.
    [[nodiscard]] const Blob& for_pairs(std::uint64_t pairs) const {
        const std::uint64_t lookups = duplicate_reference_count() != 0 ? pairs + 1 : 1;
        return allow(pairs + lookups * 2 * format::max_depth, pairs + lookups * 2 * format::max_children);
    }
    /// What else a query is given.
    [[nodiscard]] const Blob& unmeasured() const { return blob_; }

    /// Whether every query so far kept to its bound.
    [[nodiscard]] bool is_within_bounds() const {
        settle();
        return within_bounds_;
    }

    [[nodiscard]] std::uint32_t triangle_count() const { return blob_.triangle_count(); }
    [[nodiscard]] std::uint32_t duplicate_reference_count() const { return blob_.duplicate_reference_count(); }
    [[nodiscard]] unsigned depth() const { return blob_.depth(); }
    [[nodiscard]] Lattice lattice() const { return blob_.lattice(); }
    [[nodiscard]] Box bounds() const { return blob_.bounds(); }

private:
    const Blob& allow(std::uint64_t nodes, std::uint64_t leaves) const {
        settle();
        most_nodes_ = nodes;
        most_leaves_ = leaves;
        return blob_;
    }
#if ESPALIER_COUNT_STEPS
    void settle() const {
        const detail::StepCounter& counted = detail::step_counter;
        within_bounds_ = within_bounds_ && counted.nodes <= most_nodes_ && counted.leaves <= most_leaves_;
        detail::step_counter = {};
    }
#else
    void settle() const {}
#endif

    const Blob& blob_;
    std::uint64_t leaves_ = 0;
    // Of the query that was asked last; whatever ran before the first one is none of ours.
    mutable std::uint64_t most_nodes_ = ~std::uint64_t{0};
    mutable std::uint64_t most_leaves_ = ~std::uint64_t{0};
    mutable bool within_bounds_ = true;
};

}  // namespace espalier::tests
