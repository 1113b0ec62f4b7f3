#include "aabb_tree.hpp"
#include "walks.hpp"

namespace espalier::bench {
namespace {

float area_of(const AabbNode& node) {
    const float* half = node.half;
    return half[0] * half[1] + half[1] * half[2] + half[2] * half[0];
}

float volume_of(const AabbNode& node) { return node.half[0] * node.half[1] * node.half[2]; }

/// Tests the box of one tree against the box of the other, which the placement turns: both are oriented boxes. Edges
/// that are almost parallel have a cross product that is almost zero; the boxes' margin covers what is left of it.
bool boxes_touch(const AabbNode& a, const AabbNode& b, const Placement& placement) {
    const auto& r = placement.rotation;
    const auto& m = placement.magnitude;
    float t[3];
    for (int i = 0; i < 3; ++i)
        t[i] = r[i][0] * b.center[0] + r[i][1] * b.center[1] + r[i][2] * b.center[2] + placement.shift[i] - a.center[i];
    for (int i = 0; i < 3; ++i)
        if (std::abs(t[i]) > a.half[i] + m[i][0] * b.half[0] + m[i][1] * b.half[1] + m[i][2] * b.half[2]) return false;
    for (int j = 0; j < 3; ++j)
        if (std::abs(t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j]) >
            b.half[j] + m[0][j] * a.half[0] + m[1][j] * a.half[1] + m[2][j] * a.half[2])
            return false;
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            if (std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]) >
                a.half[i1] * m[i2][j] + a.half[i2] * m[i1][j] + b.half[j1] * m[i][j2] + b.half[j2] * m[i][j1])
                return false;
        }
    }
    return true;
}

/// Returns what no coordinate of both trees exceeds, where the second is placed.
double largest_coordinate(const AabbTree& a, const AabbTree& b, const Placement& placement) {
    const float* t = placement.shift;
    return static_cast<double>(
        std::max(a.largest, 2.0f * b.largest + std::abs(t[0]) + std::abs(t[1]) + std::abs(t[2])));
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

void PairWalk::test_leaves(Entry at, PairQuestion question, const Placement& placement, PairWork& work) const {
    const double largest = largest_coordinate(*a_, *b_, placement);
    for (const FloatTriangle& of_b : b_->triangles_of(b_->nodes[at.b])) {
        const PlacedTriangle placed(of_b, placement.exact, largest);
        for (const FloatTriangle& of_a : a_->triangles_of(a_->nodes[at.a])) {
            ++work.triangle_tests;
            if (!placed.touches(of_a)) continue;
            ++work.pairs;
            if (question == PairQuestion::any) return;
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
        if (boxes_touch(a_->nodes[child_a], b_->nodes[child_b], placement))
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
    PairWork work;
    ++work.box_tests;
    if (!boxes_touch(a_->nodes[0], b_->nodes[0], placement)) return work;
    std::size_t size = 0;
    stack_[size++] = {0, 0, false};
    while (size > 0) {
        const Entry at = stack_[--size];
        if (a_->nodes[at.a].is_leaf() && b_->nodes[at.b].is_leaf()) {
            test_leaves(at, question, placement, work);
            if (question == PairQuestion::any && work.pairs > 0) break;
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
    const double largest = largest_coordinate(a, b, placement);
    for (const FloatTriangle& of_b : b.triangles) {
        const PlacedTriangle placed(of_b, placement.exact, largest);
        for (const FloatTriangle& of_a : a.triangles) {
            ++work.triangle_tests;
            if (placed.touches(of_a)) ++work.pairs;
        }
    }
    return work;
}

}  // namespace espalier::bench
