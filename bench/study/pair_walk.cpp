#include "aabb_tree.hpp"
#include "walks.hpp"

namespace espalier::bench {
namespace {

float area_of(const AabbNode& node) {
    const float* half = node.half;
    return half[0] * half[1] + half[1] * half[2] + half[2] * half[0];
}

float volume_of(const AabbNode& node) { return node.half[0] * node.half[1] * node.half[2]; }

bool nodes_touch(const AabbNode& a, const AabbNode& b, const Placement& placement) {
    float t[3];
    place(placement, b.center, t);
    for (int i = 0; i < 3; ++i) t[i] -= a.center[i];
    return boxes_touch(a.half, b.half, placement.rotation, placement.magnitude, t);
}

/// Returns whether the first of two inner nodes is replaced by its children.
template <PairRule rule>
bool is_first_next(const AabbNode& a, const AabbNode& b, bool is_first_last) {
    if constexpr (rule == PairRule::larger_volume) return volume_of(a) >= volume_of(b);
    else if constexpr (rule == PairRule::larger_area) return area_of(a) >= area_of(b);
    else if constexpr (rule == PairRule::alternating) return !is_first_last;
    else return true;
}

}  // namespace

std::string_view name_of(PairRule rule) {
    constexpr const char* names[] = {"first_until_leaf", "alternating", "larger_volume", "larger_area", "all_children"};
    return names[static_cast<std::size_t>(rule)];
}

Placement::Placement(const Transform& transform) {
    const Matrix matrix = rotation_matrix(transform);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            rotation[i][j] = static_cast<float>(matrix.at[i][j]);
            magnitude[i][j] = std::abs(rotation[i][j]);
        }
        exact.rotation[i] = {matrix.at[i][0], matrix.at[i][1], matrix.at[i][2]};
    }
    shift[0] = transform.translation.x;
    shift[1] = transform.translation.y;
    shift[2] = transform.translation.z;
    exact.shift = point_of(transform.translation);
}

PairWalk::PairWalk(const AabbTree& a, const AabbTree& b) : a_(&a), b_(&b) {
    // Each step takes one pair and adds four at most, and goes down a level of a tree at least.
    stack_.resize(3 * (std::size_t{a.height} + b.height) + 1);
}

void TrianglePairTest::test(std::span<const FloatTriangle> of_a, std::span<const FloatTriangle> of_b,
                            PairWork& work) const {
    for (const FloatTriangle& b : of_b) {
        const PlacedTriangle placed(b, placement_->exact, largest_);
        for (const FloatTriangle& a : of_a) {
            ++work.triangle_tests;
            if (!placed.touches(a)) continue;
            ++work.pairs;
            if (is_over(work)) return;
        }
    }
}

/// Pushes the pairs that replace one, of those whose boxes touch. Returns the new size of the stack.
template <PairRule rule>
std::size_t PairWalk::push_children(Entry at, const Placement& placement, std::size_t size, PairWork& work) {
    const AabbNode& a = a_->nodes[at.a];
    const AabbNode& b = b_->nodes[at.b];
    const auto push_if_touching = [&](std::uint32_t child_a, std::uint32_t child_b) {
        ++work.box_tests;
        if (nodes_touch(a_->nodes[child_a], b_->nodes[child_b], placement))
            stack_[size++] = {child_a, child_b, child_a != at.a};
    };
    // What is pushed last is visited first: the first children.
    if (rule == PairRule::all_children && !a.is_leaf() && !b.is_leaf()) {
        for (std::uint32_t i = 2; i-- > 0;)
            for (std::uint32_t j = 2; j-- > 0;) push_if_touching(a.first + i, b.first + j);
    } else if (b.is_leaf() || (!a.is_leaf() && is_first_next<rule>(a, b, at.is_first_last))) {
        for (std::uint32_t i = 2; i-- > 0;) push_if_touching(a.first + i, at.b);
    } else {
        for (std::uint32_t j = 2; j-- > 0;) push_if_touching(at.a, b.first + j);
    }
    return size;
}

template <PairRule rule>
PairWork PairWalk::walk(PairQuestion question, const Placement& placement) {
    const TrianglePairTest triangles(*a_, *b_, placement, question);
    PairWork work;
    ++work.box_tests;
    if (!nodes_touch(a_->nodes[0], b_->nodes[0], placement)) return work;
    std::size_t size = 0;
    stack_[size++] = {0, 0, false};
    while (size > 0) {
        const Entry at = stack_[--size];
        if (a_->nodes[at.a].is_leaf() && b_->nodes[at.b].is_leaf()) {
            triangles.test(a_->triangles_of(a_->nodes[at.a]), b_->triangles_of(b_->nodes[at.b]), work);
            if (triangles.is_over(work)) break;
        } else {
            size = push_children<rule>(at, placement, size, work);
        }
    }
    return work;
}

PairWork PairWalk::run(PairRule rule, PairQuestion question, const Placement& placement) {
    switch (rule) {
        case PairRule::first_until_leaf:
            return walk<PairRule::first_until_leaf>(question, placement);
        case PairRule::alternating:
            return walk<PairRule::alternating>(question, placement);
        case PairRule::larger_volume:
            return walk<PairRule::larger_volume>(question, placement);
        case PairRule::larger_area:
            return walk<PairRule::larger_area>(question, placement);
        case PairRule::all_children:
            return walk<PairRule::all_children>(question, placement);
    }
    return {};
}

PairWork test_all_pairs(const AabbTree& a, const AabbTree& b, const Placement& placement) {
    PairWork work;
    TrianglePairTest(a, b, placement, PairQuestion::all).test(a.triangles, b.triangles, work);
    return work;
}

}  // namespace espalier::bench
