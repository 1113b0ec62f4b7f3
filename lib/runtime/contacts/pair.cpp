// Where two blobs touch: the pairs of the walk through two trees, each with what its triangles have in common.
#include <espalier/pair.hpp>

#include <runtime/contacts/touch.hpp>
#include <runtime/pairs/contacts.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Out of line: its stack is not needed beside the walk.
ESPALIER_NOINLINE PairTouch touch_of(const PairFrame& frame, const Transform& transform, const PairContact& pair,
                                     const LatticeTriangle& a, const LatticeTriangle& b) {
    contacts::TrianglesTouch found;
    contacts::touch_triangles(a, b, found);
    PairTouch touch;
    touch.a = pair.a;
    touch.b = pair.b;
    touch.status = found.count != 0 ? QueryStatus::ok : QueryStatus::not_found;
    touch.count = static_cast<std::uint8_t>(found.count);
    if (found.count == 0) return touch;
    for (unsigned i = 0; i < found.count; ++i)
        touch.points[i] = to_world(transform, point_in_units(frame, found.point[i]));
    touch.normal = normal_to_world(transform, found.normal);
    touch.depth = length_in_world(frame, found.depth, transform.scale);
    return touch;
}

ESPALIER_NOINLINE PairTouch touch_of(const PairFrame& frame, const Transform& transform, const PairContact& pair,
                                     const PlaceTriangles& place) {
    LatticeTriangle a, b;
    place(a, b);
    return touch_of(frame, transform, pair, a, b);
}

}  // namespace

PairTouch pair_touch(const PlacedBlob& a, const PlacedBlob& b, const PairContact& pair) noexcept {
    PairTouch touch;
    PairFrame frame;
    LatticeTriangle of_a, of_b;
    touch.status = place_triangles(a, b, pair, frame, of_a, of_b);
    return touch.status == QueryStatus::ok ? touch_of(frame, a.transform(), pair, of_a, of_b) : touch;
}

QueryStatus for_each_touch(const PlacedBlob& a, const PlacedBlob& b, Visitor<const PairTouch&> visit,
                           WorkLimit limit) noexcept {
    const auto pass_on = [&](const PairFrame& frame, const PairContact& contact, const TrianglePair&,
                             const PlaceTriangles& place) {
        return visit(touch_of(frame, a.transform(), contact, place));
    };
    return visit_contacts(a, b, pass_on, limit);
}

Filled collect_touches(const PlacedBlob& a, const PlacedBlob& b, std::span<PairTouch> touches, WorkLimit limit,
                       Cursor from) noexcept {
    const auto write = [&](std::size_t number, const PairFrame& frame, const PairContact& contact,
                           const PlaceTriangles& place) {
        touches[number] = touch_of(frame, a.transform(), contact, place);
    };
    return collect_contacts(a, b, touches.size(), write, limit, from);
}

}  // namespace espalier
