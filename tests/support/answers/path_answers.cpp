#include "path_answers.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <espalier/pair.hpp>
#include <runtime/transforms/rotation.hpp>
#include <espalier/walk.hpp>
#include <runtime/answers/nearest_to_local.hpp>
#include <runtime/pairs/frame.hpp>

#include "support/base/answer_hash.hpp"
#include "support/base/vectors.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/hostile_arguments.hpp"
#include "support/queries/test_pair_frame.hpp"

namespace espalier::tests {

namespace {

constexpr std::uint64_t most_work = 60;  ///< pairs of boxes; where it is reached must be the same too

struct Questions {
    bool sound = true;
    std::vector<Ray> rays;  ///< the first 17 alike, so that a batch has a group
    detail::RoundedPoint point;
    bool has_point = false;
    TestPairFrame frame;
    bool has_frame = false;
    bool is_apart = false;   ///< nothing touches there: only then distances are asked for
    std::int32_t steps = 0;  ///< accuracy of approximate answers
    float radius = 0.0f;
};

Questions draw_questions(const Blob& blob, Random& random) {
    Questions questions;
    for (int i = 0; i < 23; ++i) {
        if (i > 0 && i < 17) {
            Ray ray = questions.rays.front();
            ray.direction.x += ray.direction.x * 0.01f * static_cast<float>(i);
            questions.rays.push_back(ray);
            continue;
        }
        const Vec3 from = some_point(blob, random), to = some_point(blob, random);
        Ray ray{from, tests::difference(to, from)};
        if (random.below(4) == 0) ray.direction = to;
        if (random.below(4) == 0) ray.t_min = random.unit();
        if (random.below(4) == 0) ray.t_max = 2.0f * random.unit();
        ray.culling = static_cast<FaceCulling>(random.below(3));
        questions.rays.push_back(ray);
    }
    const Vec3 center = some_point(blob, random);
    questions.has_point = detail::round_point(detail::data_of(blob), center, some_length(blob, random),
                                              questions.point) == QueryStatus::ok;
    Transform placement;
    const Vec3 axis = random.in_cube(1.0f);
    placement.rotation = {axis.x, axis.y, axis.z, random.signed_unit()};
    placement.translation = random.in_cube(some_length(blob, random));
    questions.has_frame = random.below(3) == 0 &&  // which takes as long as everything else
                          detail::is_valid(placement) &&
                          detail::place_pair(detail::data_of(blob), detail::data_of(blob), placement,
                                             questions.frame) == QueryStatus::ok &&
                          questions.frame.gap <= 1024.0f * questions.frame.span;
    if (questions.has_frame) {
        std::uint64_t work = most_work;
        bool touches = false;
        const auto touch = [&](const detail::TrianglePair&) {
            touches = true;
            return Visit::stop;
        };
        const InstructionPath& scalar = instruction_paths().front();
        questions.is_apart = scalar.touching_pairs(questions.frame, touch, work) == QueryStatus::ok && !touches;
    }
    questions.steps = static_cast<std::int32_t>(random.below(random.coin() ? 4 : 1u << 20));
    questions.radius = random.coin() ? infinity : questions.frame.span * random.unit();
    return questions;
}

void add(AnswerHash& hash, const RayHit& hit) { hash.add(hit.t, hit.u, hit.v, hit.normal, hit.triangle.index); }

struct Kind {
    const char* name;
    bool of_rays = false;
};
constexpr std::array kinds = {
    Kind{"the closest hit", true}, Kind{"the first hits", true},  Kind{"any hit", true},
    Kind{"every hit", true},       Kind{"a batch", true},         Kind{"overlaps of a sphere"},
    Kind{"the closest point"},     Kind{"the closest triangles"}, Kind{"about a sphere"},
    Kind{"about a distance"},      Kind{"about a ray", true},     Kind{"pairs that touch"},
    Kind{"the nearest pair"}};
using Answers = std::array<std::uint64_t, kinds.size()>;

Answers ask(const InstructionPath& path, const detail::BlobData& data, const Questions& questions) {
    std::array<AnswerHash, kinds.size()> hashes;
    std::size_t next = 0;
    const auto about = [&](auto question) { question(hashes[next++]); };
    const Ray& ray = questions.rays.back();
    const auto keep = [](TriangleId triangle) { return triangle.index % 3 != 0; };
    const TriangleFilter filter = keep;
    // Where a triangle has references outside of its box, which ones are met depends on the boxes that are entered.
    const bool has_lists = data.copies == nullptr || questions.sound;

    about([&](AnswerHash& hash) {
        for (const TriangleFilter& each : {TriangleFilter(), filter}) {
            const RayHit hit = path.closest_hit(data, ray, each);
            hash.add(static_cast<std::uint32_t>(hit.status), static_cast<std::uint32_t>(hit.side));
            add(hash, hit);
        }
    });
    about([&](AnswerHash& hash) {
        std::array<RayHit, 3> hits;
        const Filled count = path.first_hits(data, ray, hits, {});
        for (std::size_t i = 0; i < count.count; ++i) add(hash, hits[i]);
        hash.add(static_cast<std::uint32_t>(count.status));
    });
    about([&](AnswerHash& hash) { hash.add(static_cast<std::uint32_t>(path.any_hit(data, ray, filter).status())); });
    about([&](AnswerHash& hash) {
        if (!has_lists) return;
        unsigned seen = 0;
        const QueryStatus status = path.every_hit(data, ray, [&](const RayHit& hit) {
            add(hash, hit);
            return ++seen == 64 ? Visit::stop : Visit::next;
        });
        hash.add(static_cast<std::uint32_t>(status));
    });
    about([&](AnswerHash& hash) {
        if (!questions.sound) return;
        std::vector<RayHit> hits(questions.rays.size());
        std::vector<YesNo> occluded(questions.rays.size());
        path.closest_hits(data, questions.rays.data(), hits.data(), hits.size());
        path.any_hits(data, questions.rays.data(), occluded.data(), hits.size());
        for (const RayHit& hit : hits) add(hash, hit);
        for (const YesNo each : occluded) hash.add(static_cast<std::uint32_t>(each.status()));
    });
    QueryCounters counters;
    if (questions.has_point) {
        const detail::RoundedPoint& point = questions.point;
        about([&](AnswerHash& hash) {
            hash.add(std::uint32_t{path.any_overlap(data, point)});
            if (!has_lists) return;
            unsigned seen = 0;
            path.every_overlap(data, point, 0, [&](TriangleId triangle) {
                hash.add(triangle.index);
                return ++seen == 64 ? Visit::stop : Visit::next;
            });
        });
        about([&](AnswerHash& hash) {
            detail::FoundNearest found{};
            if (!questions.sound || !path.closest_triangle(data, point, found)) return;
            hash.add(found.index);
            hash.add(found.distance.squared, found.distance.u, found.distance.v,
                     static_cast<std::uint32_t>(found.distance.feature));
        });
        about([&](AnswerHash& hash) {
            if (!questions.sound) return;
            std::array<ClosestPoint, 5> nearest;
            const std::size_t count = path.closest_triangles(data, point, nearest);
            for (std::size_t i = 0; i < count; ++i) {
                detail::finish(data, point, {}, infinity, nearest[i]);
                hash.add(nearest[i].triangle.index, nearest[i].distance, nearest[i].point);
            }
        });
        about([&](AnswerHash& hash) {
            hash.add(std::uint32_t{path.may_overlap(data, point, questions.steps, counters)});
        });
        about([&](AnswerHash& hash) {
            const detail::SquaredBounds bounds = path.closest_bounds(data, point, questions.steps, counters);
            hash.add(bounds.lower, bounds.upper);
        });
    } else {
        next += 5;
    }
    about([&](AnswerHash& hash) {
        hash.add(static_cast<std::uint32_t>(path.may_hit(data, ray, {questions.steps, &counters}).status()));
    });
    if (questions.has_frame) {
        about([&](AnswerHash& hash) {
            std::uint64_t work = most_work;
            const auto touch = [&](const detail::TrianglePair& pair) {
                hash.add(pair.a.index, pair.b.index);
                return Visit::next;
            };
            hash.add(static_cast<std::uint32_t>(path.touching_pairs(questions.frame, touch, work)));
            hash.add(static_cast<std::uint32_t>(work));
        });
    }
    if (questions.is_apart) {
        about([&](AnswerHash& hash) {
            std::uint64_t work = most_work;
            detail::FoundTriangles best;
            bool found = false;
            const QueryStatus status = path.nearest_pair(questions.frame, questions.radius, false, best, found, work);
            hash.add(static_cast<std::uint32_t>(status), static_cast<std::uint32_t>(work));
            if (!found) return;
            hash.add(best.pair.a.index);
            hash.add(best.pair.b.index, best.distance.squared);
            for (const float weight :
                 {best.distance.on_a.u, best.distance.on_b.u, best.distance.on_a.v, best.distance.on_b.v})
                hash.add(weight);
        });
    }
    Answers answers;
    for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = hashes[i].value();
    return answers;
}

}  // namespace

namespace {

/// Whether a box lies so far beyond the asset that rays may miss what it holds (docs/format.md, 5.1).
bool has_boxes_far_beyond(const Blob& blob) {
    const Vec3 low = blob.bounds().min, high = blob.bounds().max;
    const auto is_beyond = [](float max, float from, float to) {
        return max > to + 0x1p-6f * (to - from) + 0x1p-20f * std::fabs(to);
    };
    bool is_any = false;
    (void)for_each_node(blob, [&](const TreeNode& node) {
        for (unsigned child = 0; child < node.child_count; ++child) {
            const Vec3& max = node.children[child].box.max;
            is_any |=
                is_beyond(max.x, low.x, high.x) || is_beyond(max.y, low.y, high.y) || is_beyond(max.z, low.z, high.z);
        }
        return NodeVisit::descend;
    });
    return is_any;
}

}  // namespace

std::optional<std::string> path_difference(const Blob& blob, Random& random, bool sound) {
    if (blob.triangle_count() == 0) return std::nullopt;
    Questions questions = draw_questions(blob, random);
    questions.sound = sound;
    questions.is_apart = questions.is_apart && sound;
    const Answers expected = ask(instruction_paths().front(), detail::data_of(blob), questions);
    for (const InstructionPath& path : instruction_paths()) {
        if (&path == &instruction_paths().front()) continue;
        const Answers answers = ask(path, detail::data_of(blob), questions);
        const bool sees_other_boxes = !sound && (std::string_view(path.name) == "small" || has_boxes_far_beyond(blob));
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (answers[i] != expected[i] && !(sees_other_boxes && kinds[i].of_rays))
                return std::string(path.name) + " and scalar differ: " + kinds[i].name;
    }
    return std::nullopt;
}

}  // namespace espalier::tests
