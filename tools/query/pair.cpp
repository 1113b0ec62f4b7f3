// Two blobs against each other.
#include "base/numbers.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

espalier::Placement placement_of(const QueryArguments& options) {
    espalier::Placement result;
    const auto turn = [&](std::size_t i) { return number_argument(options.rotation.at(i), "--rotate"); };
    const auto move = [&](std::size_t i) { return length_argument(options.translation.at(i), "--move"); };
    result.rotation = {turn(0), turn(1), turn(2), turn(3)};
    result.translation = {move(0), move(1), move(2)};
    result.scale = number_argument(options.scale, "--scale");
    return result;
}

/// The other blob and where it stands.
struct Other {
    explicit Other(QueryCall& call)
        : placement(placement_of(call.options())),
          file(open_blob_file(call.next_name())),
          limit{call.options().work_limit} {}
    espalier::Placement placement;
    BlobFile file;
    WorkLimit limit;
};

void add_pair(Record& record, const QueryCall& call, const Other& other, const TrianglePair& pair) {
    Record a(record.as_json());
    Record b(record.as_json());
    record.add("a", a.triangle(call.blob(), pair.a)).add("b", b.triangle(other.file.blob, pair.b));
}

Answer ask_collides(QueryCall& call) {
    const Other other(call);
    bool collide = false;
    Answer answer(call, collides(call.blob(), other.file.blob, other.placement, collide, other.limit));
    if (answer.status == QueryStatus::ok) answer.yes_or_no("collides", collide, "collides", "does not collide");
    return answer;
}

Answer ask_first_contact(QueryCall& call) {
    const Other other(call);
    TrianglePair pair;
    bool found = false;
    Answer answer(call, first_contact(call.blob(), other.file.blob, other.placement, pair, found, other.limit));
    if (answer.status != QueryStatus::ok) return answer;
    answer.record.title(found ? "contact" : "no contact").add_silently("found", found);
    if (found) add_pair(answer.record, call, other, pair);
    return answer;
}

Answer ask_contacts(QueryCall& call) {
    const Other other(call);
    Answer answer(call);
    bool is_full = false;
    const auto visit = [&](const TrianglePair& pair) {
        is_full = call.options().limit && answer.list.size() == *call.options().limit;
        if (is_full) return stop;
        Record& record = answer.list.emplace_back(call.options().json).title("contact");
        add_pair(record, call, other, pair);
        return keep_going;
    };
    answer.status = for_each_contact(call.blob(), other.file.blob, other.placement, visit, other.limit);
    if (is_full) answer.status = QueryStatus::output_full;
    return answer.counted_list("contacts", "contact");
}

Answer ask_distance(QueryCall& call) {
    const Other other(call);
    const float max_distance = length_argument(call.options().max_distance, "--max-distance");
    PairDistance nearest;
    bool found = false;
    Answer answer(call, minimum_distance(call.blob(), other.file.blob, other.placement, max_distance, nearest, found,
                                         other.limit));
    if (answer.status != QueryStatus::ok && answer.status != QueryStatus::work_limit) return answer;
    answer.record.title(found ? "nearest" : "nothing within that distance").add_silently("found", found);
    if (!found) return answer;
    answer.record.add("distance", nearest.distance).add("on_a", nearest.on_a).add("on_b", nearest.on_b);
    add_pair(answer.record, call, other, nearest.pair);
    return answer;
}

Answer ask_within(QueryCall& call) {
    const Other other(call);
    bool within = false;
    Answer answer(
        call, within_distance(call.blob(), other.file.blob, other.placement, call.next_number(), within, other.limit));
    if (answer.status == QueryStatus::ok) answer.yes_or_no("within", within, "within that distance", "farther apart");
    return answer;
}

}  // namespace

QueryKinds pair_kinds() {
    constexpr const char* family = "Two blobs; the other stands in the first one's space";
    return {
        {family, "collides", "Whether the surfaces touch", {name_word("OTHER")}, option_placement, ask_collides},
        {family,
         "first-contact",
         "A pair of triangles that touch, the first that is found",
         {name_word("OTHER")},
         option_placement,
         ask_first_contact},
        {family,
         "contacts",
         "All pairs of triangles that touch, in the order of the trees",
         {name_word("OTHER")},
         option_placement | option_limit,
         ask_contacts},
        {family,
         "distance",
         "The closest pair of points",
         {name_word("OTHER")},
         option_placement | option_max_distance,
         ask_distance},
        {family,
         "within",
         "Whether the surfaces are within a distance of each other",
         {name_word("OTHER"), length_word("distance")},
         option_placement,
         ask_within},
    };
}

}  // namespace espalier::tools
