#include "differences.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

#include <espalier/distance.hpp>
#include <runtime/answers/nearest_to_local.hpp>
#include <runtime/kernels/ray_triangle.hpp>

#include "support/base/same_bits.hpp"
#include "support/machine/float_mode.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/ray_maker.hpp"

namespace espalier::tests {

namespace {

bool third_is_left_out(std::uint32_t index) { return index % 3 != 2; }

std::string difference(const char* path, const std::string& what, const Ray& ray) {
    return std::string(path) + ": " + what + " differs: " + describe(ray);
}

/// How many places an array of answers is given: some queries get none, some more than they need.
std::size_t places_for(float one, float other) {
    constexpr std::size_t places[] = {0, 1, 2, 3, 5, 17, 64, 4096};
    const auto bits = std::bit_cast<std::uint32_t>(one) ^ std::bit_cast<std::uint32_t>(other);
    return places[(bits ^ bits >> 11 ^ bits >> 22) % std::size(places)];
}
std::size_t places_for(const Ray& ray) { return places_for(ray.origin.x, ray.direction.y); }

/// The answers about all triangles, or about those that a filter keeps.
struct Selected {
    std::optional<RayHit> closest;
    std::vector<RayHit> first;
    QueryStatus first_status = QueryStatus::ok;
    bool any = false;
};
struct RayAnswers {
    Selected all, filtered;
    std::vector<RayHit> every;
    std::vector<RayHit> crossings;
};

/// `first_hits` is called with as many places as the ray gets; those that it says it filled are kept.
template <class FirstHits>
Selected selected(const Ray& ray, const RayHit& closest, const YesNo& any, FirstHits first_hits) {
    Selected answers;
    if (closest) answers.closest = closest;
    answers.any = any.yes();
    answers.first.resize(places_for(ray));
    const Filled count = first_hits(std::span<RayHit>(answers.first));
    answers.first.resize(count.count);
    answers.first_status = is_refused(count.status) ? QueryStatus::ok : count.status;
    return answers;
}

/// Hits of triangles with duplicate references come in another order than the loop's.
void sort_duplicates(const detail::BlobData& data, std::vector<RayHit>& hits) {
    if (data.copy_count == 0) return;
    std::sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) { return a.triangle < b.triangle; });
}

bool keep(TriangleId triangle) { return third_is_left_out(triangle.index); }

/// What an instruction set says, in full.
RayAnswers ask(const InstructionPath& path, const detail::BlobData& data, const Ray& ray) {
    const auto select = [&](const TriangleFilter& of) {
        return selected(ray, path.closest_hit(data, ray, of), path.any_hit(data, ray, of),
                        [&](std::span<RayHit> hits) { return path.first_hits(data, ray, hits, of); });
    };
    RayAnswers answers = {select({}), select(keep), {}, {}};
    static_cast<void>(path.every_hit(data, ray, [&](const RayHit& each) { answers.every.push_back(each); }));
    static_cast<void>(path.every_crossing(data, ray, [&](const RayHit& each) { answers.crossings.push_back(each); }));
    sort_duplicates(data, answers.every);
    sort_duplicates(data, answers.crossings);
    return answers;
}

/// What the public functions say.
RayAnswers ask(const Blob& blob, const Ray& ray) {
    const auto select = [&](auto... filter) {
        return selected(ray, raycast(blob, ray, filter...), occluded(blob, ray, filter...),
                        [&](std::span<RayHit> hits) { return closest_hits(blob, ray, hits, filter...); });
    };
    RayAnswers answers = {select(), select(keep), {}, {}};
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
    // The runtime's own translation: the traversal, not the translation, is compared here.
    const auto translate = [&](const detail::FoundHit& found) {
        return detail::to_ray_hit(rounded, ray, found.hit, found.index);
    };
    std::vector<detail::FoundHit> sorted = loop.every_hit(rounded);
    for (const detail::FoundHit& found : sorted) {
        answers.every.push_back(translate(found));
        if (loop.is_crossing(rounded, found)) answers.crossings.push_back(translate(found));
        ++hits;
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](const detail::FoundHit& a, const detail::FoundHit& b) {
        return a.hit.whole_tau < b.hit.whole_tau;
    });
    for (const bool is_filtered : {false, true}) {
        if (is_filtered) std::erase_if(sorted, [](const detail::FoundHit& f) { return !third_is_left_out(f.index); });
        Selected& of = is_filtered ? answers.filtered : answers.all;
        const std::size_t count = std::min(sorted.size(), places_for(ray));
        for (std::size_t i = 0; i < count; ++i) of.first.push_back(translate(sorted[i]));
        of.first_status = sorted.size() > count ? QueryStatus::output_full : QueryStatus::ok;
        of.any = !sorted.empty();
        if (of.any) of.closest = translate(sorted[0]);
    }
    return answers;
}

bool are_same(const std::vector<RayHit>& a, const std::vector<RayHit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const RayHit& p, const RayHit& q) { return same_bits(p, q); });
}

const char* first_difference(const Selected& a, const Selected& b) {
    if (a.closest.has_value() != b.closest.has_value() || (a.closest && !same_bits(*a.closest, *b.closest)))
        return "the closest hit";
    if (a.any != b.any) return "whether anything is hit";
    return a.first_status == b.first_status && are_same(a.first, b.first) ? nullptr : "the row of the first hits";
}

/// The first answer that differs, or nothing.
std::optional<std::string> first_difference(const RayAnswers& a, const RayAnswers& b) {
    if (const char* what = first_difference(a.all, b.all)) return what;
    if (const char* what = first_difference(a.filtered, b.filtered)) return std::string(what) + " under a filter";
    if (!are_same(a.every, b.every)) return "the row of all hits";
    if (!are_same(a.crossings, b.crossings)) return "the row of all crossings";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> ray_difference(const Blob& blob, const TriangleLoop& loop, const Ray& ray,
                                          std::uint64_t& hits, unsigned float_mode) {
    const RayAnswers expected = ask(loop, detail::data_of(blob), ray, hits);
    const FloatMode in_mode(float_mode);
    for (const InstructionPath& path : instruction_paths()) {
        if (const auto what = first_difference(ask(path, detail::data_of(blob), ray), expected))
            return difference(path.name, *what, ray);
    }
    if (const auto what = first_difference(ask(blob, ray), expected))
        return difference("the public function", *what, ray);
    return std::nullopt;
}

std::optional<std::string> segment_difference(const Blob& blob, const TriangleLoop& loop, const Segment& segment) {
    const Ray ray = Ray::between(segment.from, segment.to);
    std::uint64_t hits = 0;
    const RayAnswers expected = ask(loop, detail::data_of(blob), ray, hits);
    const RayHit hit = raycast(blob, ray);
    if (bool(hit) != expected.all.any) return difference("raycast", "whether a segment hits", ray);
    if (expected.all.closest && !same_bits(hit, *expected.all.closest))
        return difference("raycast", "the closest hit of a segment", ray);
    if (occluded(blob, ray).yes() != expected.all.any) return difference("occluded", "whether a segment hits", ray);
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
        if (const auto what = first_difference(ask(path, detail::data_of(blob), ray), expected))
            return difference(path.name, *what, ray);
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
