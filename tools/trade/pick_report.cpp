#include "pick_report.hpp"

#include <algorithm>

#include "base/choices.hpp"
#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

/// "12 % more"; the divisor may be 0 for a mesh without triangles.
std::string more_than(double value, double least) {
    return text(rounded(least > 0.0 ? 100.0 * (value / least - 1.0) : 0.0, 3), " % more");
}

/// Of the candidates on the chosen lattice the one with the least of something.
template <class Measure>
const Candidate& least(const Picked& picked, const Measure& measure) {
    const Candidate* best = &picked.chosen;
    for (const Candidate& candidate : picked.tried) {
        if (candidate.bits == picked.chosen.bits && measure(candidate) < measure(*best)) best = &candidate;
    }
    return *best;
}

const Candidate& fastest(const Picked& picked) {
    return least(picked, [](const Candidate& candidate) { return candidate.cost; });
}
const Candidate& smallest(const Picked& picked) {
    return least(picked, [](const Candidate& candidate) { return candidate.bytes; });
}

Json candidate_json(const Candidate& candidate) {
    return {{"profile", name_in(profile_choices, candidate.profile)},
            {"builder", name_in(builder_choices, candidate.builder)},
            {"leaf_size", candidate.leaf_size},
            {"byte_price", json_number(candidate.byte_price)},
            {"bits", candidate.bits},
            {"bytes", candidate.bytes},
            {"max_error", candidate.max_error},
            {"counted_cost", candidate.cost},
            {"nodes_per_ray", candidate.work.nodes},
            {"leaves_per_ray", candidate.work.leaves},
            {"triangles_per_ray", candidate.work.triangles}};
}

}  // namespace

void say_pick(const Console& console, const Picked& picked, const BakeOptions& options) {
    const Candidate& chosen = picked.chosen;
    const Candidate& first = picked.tried.front();
    console.say(text("picked: ", describe(chosen), ", out of ", counted(picked.tried.size(), "bake")));
    if (options.resolution.kind() == Resolution::Kind::tolerance) {
        console.say(
            text("  error: ", rounded(chosen.max_error), " of ", rounded(options.resolution.value()), " allowed"));
    } else if (first.bits != chosen.bits) {
        console.say(text("  error: ", rounded(chosen.max_error), "; given up: ", rounded(first.max_error), " at ",
                         counted(first.bits, "bit"), ", which takes ", counted(first.bytes, "byte")));
    } else {
        console.say(text("  error: ", rounded(chosen.max_error), ", nothing given up"));
    }
    const Candidate& small = smallest(picked);
    console.say(text("  bytes: ", chosen.bytes,
                     small.bytes == chosen.bytes ? std::string(", the fewest at this lattice")
                                                 : text(", ", more_than(double(chosen.bytes), double(small.bytes)),
                                                        " than ", small.bytes, " with ", describe(small))));
    const Candidate& fast = fastest(picked);
    console.say(text("  counted work: ", rounded(chosen.cost, 4), " visits a ray",
                     fast.cost == chosen.cost
                         ? std::string(", the least at this lattice")
                         : text(", ", more_than(chosen.cost, fast.cost), "; given up: ", rounded(fast.cost, 4),
                                " with ", describe(fast), ", which takes ", counted(fast.bytes, "byte"))));
}

Json pick_json(const Picked& picked) {
    Json tried = Json::array();
    for (const Candidate& candidate : picked.tried) tried.push_back(candidate_json(candidate));
    return {{"chosen", candidate_json(picked.chosen)},
            {"fastest", candidate_json(fastest(picked))},
            {"smallest", candidate_json(smallest(picked))},
            {"tried", std::move(tried)}};
}

}  // namespace espalier::tools
