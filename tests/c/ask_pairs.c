#include "asking.h"

static void tell_contact(struct asking* asking, const espalier_pair_contact* contact) {
    tell(asking, contact->a);
    tell(asking, contact->b);
    tell(asking, contact->status);
}

static void tell_touch(struct asking* asking, const espalier_pair_touch* touch) {
    const espalier_contact first = espalier_contact_of_touch(touch, 0);
    tell(asking, touch->a);
    tell(asking, touch->b);
    tell(asking, touch->status);
    tell(asking, touch->count);
    for (unsigned i = 0; i < touch->count; ++i) tell_point(asking, touch->points[i]);
    tell_point(asking, touch->normal);
    tell_float(asking, touch->depth);
    tell_point(asking, first.point);
    tell_float(asking, first.distance);
}

static void tell_distance(struct asking* asking, const espalier_blob_distance* nearest) {
    tell_float(asking, nearest->distance);
    tell_point(asking, nearest->on_a);
    tell_point(asking, nearest->on_b);
    tell(asking, nearest->a);
    tell(asking, nearest->b);
    tell(asking, nearest->status);
}

static espalier_visit visit_pair(const espalier_pair_contact* contact, void* user) {
    struct asking* asking = user;
    tell_contact(asking, contact);
    return asking->visits-- == 0 ? ESPALIER_VISIT_STOP : ESPALIER_VISIT_NEXT;
}

static espalier_visit visit_touch(const espalier_pair_touch* touch, void* user) {
    struct asking* asking = user;
    tell_touch(asking, touch);
    return asking->visits-- == 0 ? ESPALIER_VISIT_STOP : ESPALIER_VISIT_NEXT;
}

static void ask_touches(struct asking* asking, const espalier_placed_blob* a, const espalier_placed_blob* b,
                        const espalier_pair_contact* contact, uint64_t work_limit) {
    const espalier_cursor from = {{0, 0, 0}};
    espalier_pair_touch touches[5];
    const espalier_filled filled = espalier_collect_touches(a, b, touches, 5, work_limit, from);
    const espalier_pair_touch one = espalier_pair_touch_of(a, b, contact);
    tell(asking, (uint32_t)filled.count);
    tell(asking, filled.status);
    for (int i = 0; i < 3; ++i) tell(asking, filled.next.place[i]);
    for (size_t i = 0; i < filled.count; ++i) tell_touch(asking, &touches[i]);
    tell_touch(asking, &one);
    asking->visits = asking->question->bits % 5u;
    tell(asking, espalier_for_each_touch(a, b, visit_touch, asking, work_limit));
}

static void ask_placed(struct asking* asking, const espalier_transform* own_placement,
                       const espalier_transform* placement, uint64_t work_limit) {
    espalier_placed_blob a, b;
    espalier_pair_contact contact, contacts[5];
    espalier_cursor from = {{0, 0, 0}};
    espalier_blob_distance nearest;
    espalier_pair_counters counters = {1, 2, 3};
    a.blob = asking->blob;
    a.transform = *own_placement;
    b.blob = asking->other;
    b.transform = *placement;
    tell(asking, espalier_overlaps_blob(&a, &b, work_limit).status);
    contact = espalier_first_contact(&a, &b, work_limit);
    tell_contact(asking, &contact);
    asking->visits = asking->question->bits % 9u;
    tell(asking, espalier_for_each_contact(&a, &b, visit_pair, asking, work_limit));
    for (int page = 0; page < 2; ++page) {
        const espalier_filled filled = espalier_collect_contacts(&a, &b, contacts, 5, work_limit, from);
        tell(asking, (uint32_t)filled.count);
        tell(asking, filled.status);
        for (size_t i = 0; i < filled.count; ++i) tell_contact(asking, &contacts[i]);
        from = filled.next;
        for (int i = 0; i < 3; ++i) tell(asking, from.place[i]);
    }
    ask_touches(asking, &a, &b, &contact, work_limit);
    nearest = espalier_distance(&a, &b, work_limit, asking->question->lengths[1]);
    tell_distance(asking, &nearest);
    tell(asking, espalier_within_distance(&a, &b, asking->question->lengths[2], work_limit).status);
    contact = espalier_first_contact_counted(&a, &b, work_limit, &counters);
    tell_contact(asking, &contact);
    nearest = espalier_distance_counted(&a, &b, work_limit, asking->question->lengths[1], &counters);
    tell_distance(asking, &nearest);
    tell(asking, (uint32_t)counters.box_pairs);
    tell(asking, (uint32_t)counters.leaf_pairs);
    tell(asking, (uint32_t)counters.triangle_pairs);
}

void ask_pairs(struct asking* asking) {
    const struct question* question = asking->question;
    const uint64_t most = question->bits % 8u == 0 ? question->bits % 50u : 300u;
    const espalier_transform identity = espalier_identity();
    espalier_transform moved = identity, placement = identity;
    moved.translation = question->directions[0];
    ask_placed(asking, &identity, &moved, most);
    memcpy(&placement.rotation, question->rotation, sizeof placement.rotation);
    placement.translation = question->directions[1];
    placement.scale = question->lengths[0];
    ask_placed(asking, &identity, &placement, most);
    ask_placed(asking, &placement, &moved, most);
}
