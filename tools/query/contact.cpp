// Contacts of bodies with the surface.
#include <cmath>
#include <utility>
#include <vector>

#include "base/choices.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

/// Lists all contacts, or the few that support the body best.
template <class Shape>
Answer contacts_answer(QueryCall& call, const Shape& shape, float margin) {
    Answer answer(call);
    std::vector<Contact> contacts(64);
    Filled found = find_contacts(call.blob(), shape, margin, contacts);
    while (found.status == QueryStatus::output_full) {
        contacts.resize(2 * contacts.size());
        found = find_contacts(call.blob(), shape, margin, contacts);
    }
    answer.status = found.status;
    if (is_refused(found.status)) return answer;
    contacts.resize(call.options().few ? reduce_contacts(found.in(contacts)) : found.count);
    for (const Contact& contact : contacts) {
        Record& record = answer.list.emplace_back(call.options().json);
        record.triangle(call.blob(), contact.triangle, "contact ");
        record.add("distance", contact.distance).add("point", contact.point).add("normal", contact.normal);
        record.add("feature", name_in(feature_choices, contact.feature));
        record.add("side", std::string(contact.side == Side::front ? "front" : "back"));
    }
    return answer.counted_list("touches", "touch");
}

template <class Shape>
Answer shape_contacts_answer(QueryCall& call) {
    const auto shape = call.next<Shape>();
    return contacts_answer(call, shape, call.next_number());
}

Answer contacts_hull_answer(QueryCall& call) {
    std::vector<Vec3> vertices;
    while (call.has_numbers()) vertices.push_back(call.next<Vec3>());
    const float margin = length_argument(call.options().max_distance, "--max-distance");
    return contacts_answer(call, ConvexHull{vertices}, std::isinf(margin) ? 0.0f : margin);
}

}  // namespace

QueryKinds contact_kinds() {
    constexpr QueryFamily family{"Contacts: places, directions and depths, within a margin"};
    return {
        family("contacts-sphere", "Where a sphere touches the surface or is near it",
               {point_word("center"), length_word("radius", Range::finite_size),
                length_word("margin", Range::finite_size)},
               option_few, shape_contacts_answer<Sphere>),
        family("contacts-capsule", "Where a capsule touches the surface or is near it",
               {point_word("from"), point_word("to"), length_word("radius", Range::finite_size),
                length_word("margin", Range::finite_size)},
               option_few, shape_contacts_answer<Capsule>),
        family("contacts-oriented-box", "Where a box of any orientation touches the surface or is near it",
               {point_word("center"), point_word("half_axis_a"), point_word("half_axis_b"), point_word("half_axis_c"),
                length_word("margin", Range::finite_size)},
               option_few, shape_contacts_answer<OrientedBox>),
        family(
            "contacts-hull",
            "Where a convex hull of vertices touches the surface, or is within --max-distance of it (0 if not given)",
            {point_word("vertex")}, option_few | option_max_distance, contacts_hull_answer, {},
            {Repeats::Which::all, max_hull_vertices}),
    };
}

}  // namespace espalier::tools
