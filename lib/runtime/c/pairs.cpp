// espalier.h: two blobs.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

espalier_placement espalier_unplaced(void) { return twin_value(Placement{}); }

espalier_query_status espalier_collides(const espalier_blob* a, const espalier_blob* b,
                                        const espalier_placement* placement, bool* answer, uint64_t work_limit) {
    return static_cast<espalier_query_status>(collides(*twin(a), *twin(b), *twin(placement), *answer, {work_limit}));
}

espalier_query_status espalier_first_contact(const espalier_blob* a, const espalier_blob* b,
                                             const espalier_placement* placement, espalier_triangle_pair* contact,
                                             bool* found, uint64_t work_limit) {
    return static_cast<espalier_query_status>(
        first_contact(*twin(a), *twin(b), *twin(placement), *twin(contact), *found, {work_limit}));
}

espalier_query_status espalier_for_each_contact(const espalier_blob* a, const espalier_blob* b,
                                                const espalier_placement* placement, espalier_pair_visitor visit,
                                                void* user, uint64_t work_limit) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return static_cast<espalier_query_status>(for_each_contact(
        *twin(a), *twin(b), *twin(placement),
        [=](const TrianglePair& contact) { return visit_answer(visit(twin(&contact), user)); }, {work_limit}));
}

espalier_query_status espalier_all_contacts(const espalier_blob* a, const espalier_blob* b,
                                            const espalier_placement* placement, espalier_triangle_pair* contacts,
                                            size_t places, size_t* count, uint64_t work_limit) {
    return static_cast<espalier_query_status>(
        all_contacts(*twin(a), *twin(b), *twin(placement), twins(contacts, places), *count, {work_limit}));
}

espalier_query_status espalier_minimum_distance(const espalier_blob* a, const espalier_blob* b,
                                                const espalier_placement* placement, float max_distance,
                                                espalier_pair_distance* nearest, bool* found, uint64_t work_limit) {
    return static_cast<espalier_query_status>(
        minimum_distance(*twin(a), *twin(b), *twin(placement), max_distance, *twin(nearest), *found, {work_limit}));
}

espalier_query_status espalier_within_distance(const espalier_blob* a, const espalier_blob* b,
                                               const espalier_placement* placement, float distance, bool* answer,
                                               uint64_t work_limit) {
    return static_cast<espalier_query_status>(
        within_distance(*twin(a), *twin(b), *twin(placement), distance, *answer, {work_limit}));
}

}  // extern "C"
