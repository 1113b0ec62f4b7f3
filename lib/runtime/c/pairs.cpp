// espalier/c/pair.h, and of statistics.h what two placed blobs take.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

static_assert(espalier::max_touch_points == ESPALIER_MAX_TOUCH_POINTS);

ESPALIER_C_FUNCTION(espalier_overlaps_blob, (a, b, work_limit),
                    c(overlaps(cpp(a), cpp(b), espalier::WorkLimit(work_limit))))

ESPALIER_C_FUNCTION(espalier_first_contact, (a, b, work_limit),
                    c(first_contact(cpp(a), cpp(b), espalier::WorkLimit(work_limit))))

ESPALIER_C_VISITING(espalier_for_each_contact, (a, b, visit, user, work_limit),
                    c(for_each_contact(cpp(a), cpp(b), visitor(visit, user), espalier::WorkLimit(work_limit))))

ESPALIER_C_FUNCTION(espalier_collect_contacts, (a, b, contacts, capacity, work_limit, from),
                    c(collect_contacts(cpp(a), cpp(b), cpp(contacts, capacity), espalier::WorkLimit(work_limit),
                                       cpp(from))))

ESPALIER_C_FUNCTION(espalier_distance, (a, b, work_limit, max_distance),
                    c(distance(cpp(a), cpp(b), espalier::WorkLimit(work_limit), max_distance)))

ESPALIER_C_FUNCTION(espalier_within_distance, (a, b, distance, work_limit),
                    c(within_distance(cpp(a), cpp(b), distance, espalier::WorkLimit(work_limit))))

ESPALIER_C_FUNCTION(espalier_first_contact_counted, (a, b, work_limit, counters),
                    c(first_contact(cpp(a), cpp(b), espalier::WorkLimit(work_limit), cpp(counters))))

ESPALIER_C_FUNCTION(espalier_distance_counted, (a, b, work_limit, max_distance, counters),
                    c(distance(cpp(a), cpp(b), espalier::WorkLimit(work_limit), max_distance, cpp(counters))))

ESPALIER_C_FUNCTION(espalier_pair_touch_of, (a, b, pair), c(pair_touch(cpp(a), cpp(b), cpp(pair))))

ESPALIER_C_VISITING(espalier_for_each_touch, (a, b, visit, user, work_limit),
                    c(for_each_touch(cpp(a), cpp(b), visitor(visit, user), espalier::WorkLimit(work_limit))))

ESPALIER_C_FUNCTION(espalier_collect_touches, (a, b, touches, capacity, work_limit, from),
                    c(collect_touches(cpp(a), cpp(b), cpp(touches, capacity), espalier::WorkLimit(work_limit),
                                      cpp(from))))

ESPALIER_C_FUNCTION(espalier_contact_of_touch, (touch, number), c(cpp(touch).contact(number)))
