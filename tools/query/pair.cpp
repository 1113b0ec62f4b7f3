// Two blobs against each other.
#include <span>
#include <vector>

#include "base/vectors.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

/// Returns the place of the other blob in the space of the first one. What the options state is between their sources,
/// which differs by the origins that were subtracted from them.
espalier::Transform stated_placement(const QueryArguments& options, const Vec3d& origin, const Vec3d& other_origin) {
    espalier::Transform result;
    const auto turn = [&](std::size_t i) { return number_argument(options.rotation.at(i), "--rotate"); };
    result.rotation = {turn(0), turn(1), turn(2), turn(3)};
    result.scale = number_argument(options.scale, "--scale");
    Vec3d offset = origin;
    if (other_origin != Vec3d{}) offset = origin - double(result.scale) * turned(result.rotation, other_origin);
    const auto move = [&](std::size_t i, double from) {
        return place_argument(options.translation.at(i), "--move", from);
    };
    result.translation = {move(0, offset.x), move(1, offset.y), move(2, offset.z)};
    return result;
}

/// The other blob and its place in the first one's space.
struct Other {
    explicit Other(QueryCall& call)
        : file(open_blob_file(call.next<std::string>())),
          transform(stated_placement(call.options(), call.origin(), file.blob.source_origin())),
          limit(call.options().work_limit) {}
    [[nodiscard]] PlacedBlob placed() const { return {file.blob, transform}; }

    AssetFile file;
    espalier::Transform transform;
    WorkLimit limit;
};

void add_pair(Record& record, const QueryCall& call, const Other& other, TriangleId in_a, TriangleId in_b) {
    Record a(record.as_json());
    Record b(record.as_json());
    record.add("a", a.triangle(call.blob(), in_a)).add("b", b.triangle(other.file.blob, in_b));
}

Answer overlaps_answer(QueryCall& call) {
    const Other other(call);
    const YesNo touch = overlaps(call.blob(), other.placed(), other.limit);
    Answer answer(call, complete(touch.status()));
    if (answer.status == QueryStatus::ok) answer.yes_or_no("overlaps", touch.yes(), "overlaps", "does not overlap");
    return answer;
}

Answer first_contact_answer(QueryCall& call) {
    const Other other(call);
    const PairContact contact = first_contact(call.blob(), other.placed(), other.limit);
    Answer answer(call, complete(contact.status));
    if (answer.status != QueryStatus::ok) return answer;
    answer.record.title(contact ? "contact" : "no contact").add_silently("found", bool(contact));
    if (contact) add_pair(answer.record, call, other, contact.a, contact.b);
    else answer.record.add_nulls({"a", "b"});
    return answer;
}

Answer pair_contacts_answer(QueryCall& call) {
    const Other other(call);
    Answer answer(call);
    const auto visit = [&](const PairContact& pair) {
        if (answer.is_full(call)) return Visit::stop;
        Record& record = answer.add().title("contact");
        add_pair(record, call, other, pair.a, pair.b);
        return Visit::next;
    };
    answer.status = for_each_contact(call.blob(), other.placed(), visit, other.limit);
    return answer.counted_list("contacts", "contact");
}

/// Lists where each pair touches.
Answer touches_answer(QueryCall& call) {
    const Other other(call);
    Answer answer(call);
    const auto visit = [&](const PairTouch& touch) {
        if (answer.is_full(call)) return Visit::stop;
        Record& record = answer.add().title("touch");
        add_pair(record, call, other, touch.a, touch.b);
        record.add("depth", touch.depth).add("normal", touch.normal);
        std::vector<SourcePoint> points;
        for (const Vec3& point : std::span(touch.points).first(touch.count)) points.push_back(call.in_source(point));
        record.add("points", points);
        return Visit::next;
    };
    answer.status = for_each_touch(call.blob(), other.placed(), visit, other.limit);
    return answer.counted_list("places", "place");
}

Answer distance_answer(QueryCall& call) {
    const Other other(call);
    const float max_distance = length_argument(call.options().max_distance, "--max-distance");
    const BlobDistance nearest = distance(call.blob(), other.placed(), other.limit, max_distance);
    Answer answer(call, complete(nearest.status));
    if (is_refused(nearest.status)) return answer;
    const bool found = nearest.a != no_triangle;
    answer.record.title(found ? "nearest" : "nothing within that distance").add_silently("found", found);
    if (!found) {
        answer.record.add_nulls({"distance", "on_a", "on_b", "a", "b"});
        return answer;
    }
    answer.record.add("distance", nearest.distance).add("on_a", call.in_source(nearest.on_a));
    answer.record.add("on_b", call.in_source(nearest.on_b));
    add_pair(answer.record, call, other, nearest.a, nearest.b);
    return answer;
}

Answer within_answer(QueryCall& call) {
    const Other other(call);
    const YesNo within = within_distance(call.blob(), other.placed(), call.next<float>(), other.limit);
    Answer answer(call, complete(within.status()));
    if (answer.status == QueryStatus::ok)
        answer.yes_or_no("within", within.yes(), "within that distance", "farther apart");
    return answer;
}

}  // namespace

QueryKinds pair_kinds() {
    constexpr QueryFamily family{"Two blobs; the other one is placed in the first one's space"};
    constexpr QueryWord other_word = name_word("OTHER", "the file of the other blob");
    constexpr unsigned placed = option_placement | option_work_limit;
    return {
        family("overlaps", "Whether the surfaces touch", {other_word}, placed, overlaps_answer),
        family("first-contact", "A pair of triangles that touch, the first that is found", {other_word}, placed,
               first_contact_answer),
        family("contacts", "All pairs of triangles that touch, in the order of the trees", {other_word},
               placed | option_limit, pair_contacts_answer),
        family("touches",
               "Where each pair of triangles touches: common points, depth and the direction in which OTHER leaves",
               {other_word}, placed | option_limit, touches_answer),
        family("distance", "The closest pair of points", {other_word}, placed | option_max_distance, distance_answer),
        family("within-distance", "Whether the surfaces are within a distance of each other",
               {other_word, length_word("distance", Range::size)}, placed, within_answer),
    };
}

}  // namespace espalier::tools
