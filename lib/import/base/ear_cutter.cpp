#include <import/base/ear_cutter.hpp>

#include <algorithm>

namespace espalier::importer {

namespace {

/// An outline of 64000 corners takes a hundred, even a spiral.
constexpr std::uint64_t most_steps_of_corner = 1000;

}  // namespace

bool EarCutter::is_too_tangled() const { return steps_ > most_steps_of_corner * points_->size() + spare_steps_; }

/// The triangle at the corner has an area and contains no other corner. If any is inside, then one is that does not
/// turn to the left.
bool EarCutter::is_ear(std::uint32_t corner) {
    const auto& points = *points_;
    unblocked_.set(corner, false);
    blockers_[corner] = CornerTree::none;
    if (turns_[corner] <= 0.0) return false;
    const std::uint32_t blocker =
        reflex_.find_inside(points[before_[corner]], points[corner], points[after_[corner]], steps_);
    if (blocker == CornerTree::none) return true;
    blockers_[corner] = blocker;
    blocked_.push_back({corner, first_blocked_[blocker]});
    first_blocked_[blocker] = static_cast<std::uint32_t>(blocked_.size() - 1);
    return false;
}

void EarCutter::update_turn(std::uint32_t corner) {
    const auto& points = *points_;
    turns_[corner] = plane_area(points[before_[corner]], points[corner], points[after_[corner]]);
    straight_.set(corner, turns_[corner] == 0.0);
    const bool is_reflex = !(turns_[corner] > 0.0);
    reflex_.set_counts(corner, is_reflex);
    if (!is_reflex) unblock(corner);
}

/// Those that the corner blocked may be ears now.
void EarCutter::unblock(std::uint32_t blocker) {
    for (std::uint32_t i = first_blocked_[blocker]; i != CornerTree::none; i = blocked_[i].next) {
        ++steps_;
        if (blockers_[blocked_[i].corner] == blocker) unblocked_.set(blocked_[i].corner, true);
    }
    first_blocked_[blocker] = CornerTree::none;
}

void EarCutter::cut_off(std::uint32_t tip, std::vector<TriangleVertices>& triangles) {
    const std::uint32_t a = before_[tip];
    const std::uint32_t c = after_[tip];
    triangles.push_back({a, tip, c});
    after_[a] = c;
    before_[c] = a;
    blockers_[tip] = CornerTree::none;
    for (CornerSet* set : {&ears_, &straight_, &unblocked_}) set->set(tip, false);
    reflex_.set_counts(tip, false);
    unblock(tip);
    for (const std::uint32_t changed : {a, c}) update_turn(changed);
    for (const std::uint32_t changed : {a, c}) update_ear(changed);
}

/// Moves `corner` to the next ear, else to the next corner that became one, else to the next straight one.
bool EarCutter::find_tip(std::uint32_t& corner) {
    auto found = ears_.next_round(corner);
    while (!found && !is_too_tangled()) {
        const auto candidate = unblocked_.next_round(corner);
        if (!candidate) break;
        if (is_ear(*candidate)) found = candidate;
    }
    if (!found) found = straight_.next_round(corner);
    if (found) corner = *found;
    return found.has_value();
}

PolygonCut EarCutter::cut(const std::vector<PlanePoint>& points, std::vector<TriangleVertices>& triangles) {
    const auto corners = static_cast<std::uint32_t>(points.size());
    points_ = &points;
    before_.resize(corners);
    after_.resize(corners);
    turns_.resize(corners);
    blockers_.assign(corners, CornerTree::none);
    first_blocked_.assign(corners, CornerTree::none);
    blocked_.clear();
    reflex_.build(points);
    for (CornerSet* set : {&ears_, &straight_, &unblocked_}) set->reset(corners);
    for (std::uint32_t i = 0; i < corners; ++i) {
        before_[i] = i == 0 ? corners - 1 : i - 1;
        after_[i] = i + 1 == corners ? 0 : i + 1;
    }
    steps_ = 0;
    for (std::uint32_t i = 0; i < corners; ++i) update_turn(i);
    for (std::uint32_t i = 0; i < corners && !is_too_tangled(); ++i) update_ear(i);
    const PolygonCut result = cut_all(corners, triangles);
    spare_steps_ -= std::min(spare_steps_, steps_ - std::min(steps_, most_steps_of_corner * corners));
    return result;
}

PolygonCut EarCutter::cut_all(std::uint32_t corners, std::vector<TriangleVertices>& triangles) {
    std::uint32_t corner = 0;
    for (std::uint32_t left = corners; left > 3; --left) {
        const bool is_found = find_tip(corner);
        if (is_too_tangled()) return PolygonCut::too_tangled;
        if (!is_found) {
            // Only a polygon that crosses itself has none.
            for (std::uint32_t i = after_[corner]; after_[i] != corner; i = after_[i])
                triangles.push_back({corner, i, after_[i]});
            return PolygonCut::crossing;
        }
        const std::uint32_t next = after_[corner];
        cut_off(corner, triangles);
        corner = next;
    }
    triangles.push_back({before_[corner], corner, after_[corner]});
    return turns_[corner] >= 0.0 ? PolygonCut::simple : PolygonCut::crossing;
}

}  // namespace espalier::importer
