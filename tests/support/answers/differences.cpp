#include "differences.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

#include <espalier/distance.hpp>
#include <runtime/answers/nearest_to_world.hpp>
#include <runtime/kernels/ray_triangle.hpp>

#include "support/base/same_bits.hpp"
#include "support/machine/float_mode.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/ray_maker.hpp"

namespace espalier::tests {

namespace {

bool third_is_left_out(std::uint32_t index) { return index % 3 != 2; }

std::string difference(const char* path, const char* what, const Ray& ray) {
    return std::string(path) + ": " + what + " differs: " + describe(ray);
}

/// How many places an array of answers is given: some queries get none, some more than they need.
std::size_t places_for(float one, float other) {
    constexpr std::size_t places[] = {0, 1, 2, 3, 5, 17, 64, 4096};
    const auto bits = std::bit_cast<std::uint32_t>(one) ^ std::bit_cast<std::uint32_t>(other);
    return places[(bits ^ bits >> 11 ^ bits >> 22) % std::size(places)];
}
std::size_t places_for(const Ray& ray) { return places_for(ray.origin.x, ray.direction.y); }

struct RayAnswers {
    std::optional<RayHit> closest;
    std::optional<RayHit> closest_filtered;
    std::vector<RayHit> first;
    std::vector<RayHit> first_filtered;
    QueryStatus first_status = QueryStatus::ok;
    QueryStatus first_status_filtered = QueryStatus::ok;
    bool any = false, any_filtered = false;
    std::vector<RayHit> every;
    std::vector<RayHit> crossings;
};

/// Calls the function with as many places as the ray gets, and keeps those that it says it filled.
template <class Ask>
void ask_first(const Ray& ray, std::vector<RayHit>& first, QueryStatus& status, Ask ask_for) {
    first.resize(places_for(ray));
    const Filled count = ask_for(std::span<RayHit>(first));
    first.resize(count.count);
    status = is_refused(count.status) ? QueryStatus::ok : count.status;
}

void keep_hit(const RayHit& found, std::optional<RayHit>& hit) {
    if (found) hit = found;
}

/// Hits of triangles with duplicate references come in another order than the loop's.
void sort_duplicates(const detail::BlobData& data, std::vector<RayHit>& hits) {
    if (data.copy_count == 0) return;
    std::sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) { return a.triangle < b.triangle; });
}

/// What an instruction set says, in full.
RayAnswers ask(const InstructionPath& path, const detail::BlobData& data, const Ray& ray) {
    const auto keep = [](TriangleId triangle) { return third_is_left_out(triangle.index); };
    const TriangleFilter filter = keep;
    RayAnswers answers;
    keep_hit(path.closest_hit(data, ray, nullptr), answers.closest);
    keep_hit(path.closest_hit(data, ray, &filter), answers.closest_filtered);
    ask_first(ray, answers.first, answers.first_status,
              [&](std::span<RayHit> hits) { return path.first_hits(data, ray, hits, nullptr); });
    ask_first(ray, answers.first_filtered, answers.first_status_filtered,
              [&](std::span<RayHit> hits) { return path.first_hits(data, ray, hits, &filter); });
    answers.any = path.any_hit(data, ray, nullptr).yes();
    answers.any_filtered = path.any_hit(data, ray, &filter).yes();
    static_cast<void>(path.every_hit(data, ray, [&](const RayHit& each) { answers.every.push_back(each); }));
    static_cast<void>(path.every_crossing(data, ray, [&](const RayHit& each) { answers.crossings.push_back(each); }));
    sort_duplicates(data, answers.every);
    sort_duplicates(data, answers.crossings);
    return answers;
}

/// What the public functions say.
RayAnswers ask(const Blob& blob, const Ray& ray) {
    const auto keep = [](TriangleId triangle) { return third_is_left_out(triangle.index); };
    RayAnswers answers;
    keep_hit(raycast(blob, ray), answers.closest);
    keep_hit(raycast(blob, ray, keep), answers.closest_filtered);
    ask_first(ray, answers.first, answers.first_status,
              [&](std::span<RayHit> hits) { return closest_hits(blob, ray, hits); });
    ask_first(ray, answers.first_filtered, answers.first_status_filtered,
              [&](std::span<RayHit> hits) { return closest_hits(blob, ray, hits, keep); });
    answers.any = occluded(blob, ray).yes();
    answers.any_filtered = occluded(blob, ray, keep).yes();
    static_cast<void>(for_each_hit(blob, ray, [&](const RayHit& each) { answers.every.push_back(each); }));
    static_cast<void>(for_each_crossing(blob, ray, [&](const RayHit& each) { answers.crossings.push_back(each); }));
    sort_duplicates(detail::data_of(blob), answers.every);
    sort_duplicates(detail::data_of(blob), answers.crossings);
    return answers;
}

/// What the loop says. The closest hit is that of the smallest tau: from far away several of them round to one t.
RayAnswers ask(const TriangleLoop& loop, const detail::BlobData& data, const Ray& ray, std::uint64_t& hits) {
    RayAnswers answers;
    detail::LatticeRay rounded;
    if (!detail::round_ray(data, ray, rounded)) return answers;
    std::optional<detail::FoundHit> closest;
    std::optional<detail::FoundHit> closest_filtered;
    std::vector<detail::FoundHit> first;
    std::vector<detail::FoundHit> first_filtered;
    // The runtime's own translation: the traversal, not the translation, is compared here.
    const auto translate = [&](const detail::FoundHit& found) {
        return detail::to_ray_hit(rounded, ray, found.hit, found.index);
    };
    for (const detail::FoundHit& found : loop.every_hit(rounded)) {
        answers.every.push_back(translate(found));
        if (loop.is_crossing(rounded, found)) answers.crossings.push_back(translate(found));
        ++hits;
        first.push_back(found);
        if (!closest || found.hit.whole_tau < closest->hit.whole_tau) closest = found;
        if (!third_is_left_out(found.index)) continue;
        first_filtered.push_back(found);
        if (!closest_filtered || found.hit.whole_tau < closest_filtered->hit.whole_tau) closest_filtered = found;
    }
    const auto sort_and_cut = [&](std::vector<detail::FoundHit>& all, std::vector<RayHit>& few) {
        std::stable_sort(all.begin(), all.end(), [](const detail::FoundHit& a, const detail::FoundHit& b) {
            return a.hit.whole_tau < b.hit.whole_tau;
        });
        const std::size_t count = std::min(all.size(), places_for(ray));
        for (std::size_t i = 0; i < count; ++i) few.push_back(translate(all[i]));
        return all.size() > count ? QueryStatus::output_full : QueryStatus::ok;
    };
    answers.first_status = sort_and_cut(first, answers.first);
    answers.first_status_filtered = sort_and_cut(first_filtered, answers.first_filtered);
    if (closest) answers.closest = translate(*closest);
    if (closest_filtered) answers.closest_filtered = translate(*closest_filtered);
    answers.any = closest.has_value();
    answers.any_filtered = closest_filtered.has_value();
    return answers;
}

bool same(const std::optional<RayHit>& a, const std::optional<RayHit>& b) {
    return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
}

/// The name of the first answer that differs, or null.
const char* first_difference(const RayAnswers& a, const RayAnswers& b) {
    if (!same(a.closest, b.closest)) return "the closest hit";
    if (!same(a.closest_filtered, b.closest_filtered)) return "the closest hit under a filter";
    if (a.any != b.any) return "whether anything is hit";
    if (a.any_filtered != b.any_filtered) return "whether anything is hit under a filter";
    const auto equal = [](const std::vector<RayHit>& x, const std::vector<RayHit>& y) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                          [](const RayHit& p, const RayHit& q) { return same_bits(p, q); });
    };
    if (a.first_status != b.first_status || !equal(a.first, b.first)) return "the row of the first hits";
    if (a.first_status_filtered != b.first_status_filtered || !equal(a.first_filtered, b.first_filtered))
        return "the row of the first hits under a filter";
    if (!equal(a.every, b.every)) return "the row of all hits";
    return equal(a.crossings, b.crossings) ? nullptr : "the row of all crossings";
}

}  // namespace

std::optional<std::string> ray_difference(const Blob& blob, const TriangleLoop& loop, const Ray& ray,
                                          std::uint64_t& hits, unsigned float_mode) {
    const RayAnswers expected = ask(loop, detail::data_of(blob), ray, hits);
    const FloatMode in_mode(float_mode);
    for (const InstructionPath& path : instruction_paths()) {
        const char* what = first_difference(ask(path, detail::data_of(blob), ray), expected);
        if (what != nullptr) return difference(path.name, what, ray);
    }
    const char* what = first_difference(ask(blob, ray), expected);
    if (what != nullptr) return difference("the public function", what, ray);
    return std::nullopt;
}

std::optional<std::string> segment_difference(const Blob& blob, const TriangleLoop& loop, const Segment& segment) {
    const Ray ray = Ray::between(segment.from, segment.to);
    std::uint64_t hits = 0;
    const RayAnswers expected = ask(loop, detail::data_of(blob), ray, hits);
    const RayHit hit = raycast(blob, ray);
    if (bool(hit) != expected.any) return difference("raycast", "whether a segment hits", ray);
    if (expected.closest && !same_bits(hit, *expected.closest))
        return difference("raycast", "the closest hit of a segment", ray);
    if (occluded(blob, ray).yes() != expected.any) return difference("occluded", "whether a segment hits", ray);
    return std::nullopt;
}

std::optional<std::string> sphere_difference(const Blob& blob, const TriangleLoop& loop, const Sphere& sphere,
                                             std::uint64_t& hits) {
    const auto difference_at = [&](const char* path, const char* what) {
        return std::string(path) + ": " + what + " differs: " + describe(sphere);
    };
    detail::RoundedPoint rounded;
    const ClosestPoint nearest = closest_point(blob, sphere.center, sphere.radius);
    const QueryStatus status = detail::round_point(detail::data_of(blob), sphere.center, sphere.radius, rounded);
    if (status != QueryStatus::ok) {
        if (overlaps(blob, sphere).yes() || nearest.status != status) {
            return difference_at("overlaps", "a refused sphere's answer");
        }
        return std::nullopt;
    }
    const std::vector<std::uint32_t> expected = loop.every_overlap(rounded);
    const std::size_t places = places_for(sphere.center.x, sphere.center.y);
    const std::vector<detail::FoundNearest> by_distance = loop.by_distance(rounded, std::max<std::size_t>(places, 1));
    const bool any_closest = !by_distance.empty();
    hits += expected.size();
    std::vector<ClosestPoint> row;
    // The runtime's own translation: the traversal, not the translation, is compared here.
    const auto finish = [&](ClosestPoint& each) {
        detail::finish(detail::data_of(blob), rounded, sphere.center, sphere.radius, each);
    };
    for (std::size_t i = 0; i < std::min(places, by_distance.size()); ++i) {
        detail::set_unfinished(row.emplace_back(), by_distance[i]);
        finish(row.back());
    }
    const auto is_row = [&](auto&& fill) {
        std::vector<ClosestPoint> filled(places);
        filled.resize(fill(std::span<ClosestPoint>(filled)));
        return std::equal(filled.begin(), filled.end(), row.begin(), row.end(),
                          [](const ClosestPoint& a, const ClosestPoint& b) { return same_bits(a, b); });
    };
    const auto matches = [&](auto&& enumerate) {
        std::vector<std::uint32_t> seen;
        const bool all = enumerate([&](TriangleId triangle) {
            seen.push_back(triangle.index);
            return seen.size() > expected.size() ? Visit::stop : Visit::next;
        });
        // Where triangles have duplicate references they come in another order.
        if (blob.duplicate_reference_count() != 0) std::sort(seen.begin(), seen.end());
        return all && std::equal(seen.begin(), seen.end(), expected.begin(), expected.end(),
                                 [](std::uint32_t a, const auto& b) { return a == b; });
    };
    for (const InstructionPath& path : instruction_paths()) {
        if (path.any_overlap(detail::data_of(blob), rounded) == expected.empty())
            return difference_at(path.name, "any overlap");
        if (!matches([&](auto visit) { return path.every_overlap(detail::data_of(blob), rounded, 0, visit); })) {
            return difference_at(path.name, "the row of all overlaps");
        }
        detail::FoundNearest found{};
        if (path.closest_triangle(detail::data_of(blob), rounded, found) != any_closest) {
            return difference_at(path.name, "whether there is a closest triangle");
        }
        if (any_closest && !same_bits(found, by_distance[0])) return difference_at(path.name, "the closest triangle");
        const bool same_row = places == 0 || is_row([&](std::span<ClosestPoint> filled) {
                                  const std::size_t count =
                                      path.closest_triangles(detail::data_of(blob), rounded, filled);
                                  for (ClosestPoint& each : filled.first(count)) finish(each);
                                  return count;
                              });
        if (!same_row) return difference_at(path.name, "the row of the closest triangles");
    }
    if (overlaps(blob, sphere).yes() == expected.empty()) return difference_at("overlaps", "the answer");
    if (!matches([&](auto visit) { return for_each_overlap(blob, sphere, visit) == QueryStatus::ok; })) {
        return difference_at("for_each_overlap", "the row of all overlaps");
    }
    if (nearest.status != (any_closest ? QueryStatus::ok : QueryStatus::not_found)) {
        return difference_at("closest_point", "whether there is one");
    }
    if (any_closest && nearest.triangle.index != by_distance[0].index)
        return difference_at("closest_point", "the triangle");
    if (!row.empty() && !same_bits(nearest, row[0])) return difference_at("closest_point", "the answer");
    if (!is_row([&](std::span<ClosestPoint> filled) {
            return closest_triangles(blob, sphere.center, filled, sphere.radius).count;
        }))
        return difference_at("closest_triangles", "the row");
    return std::nullopt;
}

std::optional<std::string> path_difference(const Blob& blob, const Ray& ray) {
    if (blob.triangle_count() == 0) return std::nullopt;
    const RayAnswers expected = ask(instruction_paths().front(), detail::data_of(blob), ray);
    for (const InstructionPath& path : instruction_paths()) {
        const char* what = first_difference(ask(path, detail::data_of(blob), ray), expected);
        if (what != nullptr) return difference(path.name, what, ray);
    }
    return std::nullopt;
}

std::optional<std::string> path_difference(const Blob& blob, const Sphere& sphere) {
    detail::RoundedPoint rounded;
    if (blob.triangle_count() == 0 ||
        detail::round_point(detail::data_of(blob), sphere.center, sphere.radius, rounded) != QueryStatus::ok) {
        return std::nullopt;
    }
    struct Answers {
        bool closest = false, any = false;
        detail::FoundNearest nearest{};
        std::vector<TriangleId> every;
    };
    const auto ask = [&](const InstructionPath& path) {
        Answers answers;
        answers.closest = path.closest_triangle(detail::data_of(blob), rounded, answers.nearest);
        answers.any = path.any_overlap(detail::data_of(blob), rounded);
        path.every_overlap(detail::data_of(blob), rounded, 0, [&](TriangleId triangle) {
            answers.every.push_back(triangle);
            return Visit::next;
        });
        return answers;
    };
    const Answers expected = ask(instruction_paths().front());
    for (const InstructionPath& path : instruction_paths()) {
        const Answers answers = ask(path);
        if (answers.closest == expected.closest && answers.any == expected.any && answers.every == expected.every &&
            (!answers.closest || same_bits(answers.nearest, expected.nearest))) {
            continue;
        }
        return std::string(path.name) + " and scalar differ: " + describe(sphere);
    }
    return std::nullopt;
}

}  // namespace espalier::tests
