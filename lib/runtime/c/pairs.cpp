// espalier/c/pair.h, and of statistics.h what two placed blobs take.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

static_assert(espalier::max_touch_points == ESPALIER_MAX_TOUCH_POINTS);

espalier_yes_no espalier_overlaps_blob(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                       uint64_t work_limit) {
    return c(overlaps(cpp(a), cpp(b), espalier::WorkLimit(work_limit)));
}

espalier_pair_contact espalier_first_contact(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                             uint64_t work_limit) {
    return c(first_contact(cpp(a), cpp(b), espalier::WorkLimit(work_limit)));
}

espalier_query_status espalier_for_each_contact(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                espalier_pair_visitor visit, void* user, uint64_t work_limit) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(for_each_contact(cpp(a), cpp(b), visitor(visit, user), espalier::WorkLimit(work_limit)));
}

espalier_filled espalier_collect_contacts(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                          espalier_pair_contact* contacts, size_t capacity, uint64_t work_limit,
                                          espalier_cursor from) {
    return c(collect_contacts(cpp(a), cpp(b), cpp(contacts, capacity), espalier::WorkLimit(work_limit), cpp(from)));
}

espalier_blob_distance espalier_distance(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                         uint64_t work_limit, float max_distance) {
    return c(distance(cpp(a), cpp(b), espalier::WorkLimit(work_limit), max_distance));
}

espalier_yes_no espalier_within_distance(const espalier_placed_blob* a, const espalier_placed_blob* b, float distance,
                                         uint64_t work_limit) {
    return c(within_distance(cpp(a), cpp(b), distance, espalier::WorkLimit(work_limit)));
}

espalier_pair_contact espalier_first_contact_counted(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                     uint64_t work_limit, espalier_pair_counters* counters) {
    return c(first_contact(cpp(a), cpp(b), espalier::WorkLimit(work_limit), cpp(counters)));
}

espalier_blob_distance espalier_distance_counted(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                 uint64_t work_limit, float max_distance,
                                                 espalier_pair_counters* counters) {
    return c(distance(cpp(a), cpp(b), espalier::WorkLimit(work_limit), max_distance, cpp(counters)));
}

espalier_pair_touch espalier_pair_touch_of(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                           const espalier_pair_contact* pair) {
    return c(pair_touch(cpp(a), cpp(b), cpp(pair)));
}

espalier_query_status espalier_for_each_touch(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                              espalier_touch_visitor visit, void* user, uint64_t work_limit) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(for_each_touch(cpp(a), cpp(b), visitor(visit, user), espalier::WorkLimit(work_limit)));
}

espalier_filled espalier_collect_touches(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                         espalier_pair_touch* touches, size_t capacity, uint64_t work_limit,
                                         espalier_cursor from) {
    return c(collect_touches(cpp(a), cpp(b), cpp(touches, capacity), espalier::WorkLimit(work_limit), cpp(from)));
}

espalier_contact espalier_contact_of_touch(const espalier_pair_touch* touch, size_t number) {
    return c(cpp(touch).contact(number));
}
