#include "asking.h"

static espalier_visit visit_pair(const espalier_triangle_pair* contact, void* user) {
    struct asking* asking = user;
    tell(asking, contact->a);
    tell(asking, contact->b);
    return asking->visits-- == 0 ? ESPALIER_STOP : ESPALIER_KEEP_GOING;
}

static void ask_placed(struct asking* asking, const espalier_placement* placement, uint64_t work_limit) {
    const espalier_blob* a = asking->blob;
    const espalier_blob* b = asking->other;
    espalier_triangle_pair contact = {8, 8}, contacts[5];
    espalier_pair_distance nearest;
    bool answer = false;
    size_t count = 99;
    memset(&nearest, 0, sizeof nearest);
    tell(asking, espalier_collides(a, b, placement, &answer, work_limit));
    tell(asking, answer);
    tell(asking, espalier_first_contact(a, b, placement, &contact, &answer, work_limit));
    tell(asking, answer);
    tell(asking, contact.a);
    tell(asking, contact.b);
    asking->visits = asking->question->bits % 9u;
    tell(asking, espalier_for_each_contact(a, b, placement, visit_pair, asking, work_limit));
    memset(contacts, 0, sizeof contacts);
    tell(asking, espalier_all_contacts(a, b, placement, contacts, 5, &count, work_limit));
    tell(asking, (uint32_t)count);
    for (int i = 0; i < 5; ++i) {
        tell(asking, contacts[i].a);
        tell(asking, contacts[i].b);
    }
    tell(asking,
         espalier_minimum_distance(a, b, placement, asking->question->lengths[1], &nearest, &answer, work_limit));
    tell(asking, answer);
    tell_float(asking, nearest.distance);
    tell_point(asking, nearest.on_a);
    tell_point(asking, nearest.on_b);
    tell(asking, nearest.pair.a);
    tell(asking, nearest.pair.b);
    tell(asking, espalier_within_distance(a, b, placement, asking->question->lengths[2], &answer, work_limit));
    tell(asking, answer);
}

void ask_pairs(struct asking* asking) {
    const struct question* question = asking->question;
    const uint64_t most = question->bits % 8u == 0 ? question->bits % 50u : 300u;
    espalier_placement placement = espalier_unplaced();
    placement.translation = question->directions[0];
    ask_placed(asking, &placement, most);
    memcpy(&placement.rotation, question->rotation, sizeof placement.rotation);
    placement.translation = question->directions[1];
    placement.scale = question->lengths[0];
    ask_placed(asking, &placement, most);
}
