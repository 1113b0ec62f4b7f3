#include "differences.hpp"

#include <algorithm>
#include <vector>

#include <espalier/nearest.hpp>

#include "instruction_paths.hpp"
#include "query_maker.hpp"
#include "same_bits.hpp"

namespace espalier::tests {

namespace {

bool third_is_left_out(std::uint32_t index) { return index % 3 != 2; }

/// A RayHit from what the loop found, by the runtime's own translation: the traversal, not the translation, is
/// compared.
RayHit to_hit(const detail::LatticeRay& rounded, const detail::FoundHit& found, const Ray& ray) {
    return detail::to_ray_hit(rounded, ray, found.hit, found.index);
}

struct RayQuestion {
    const Blob& blob;
    const TriangleLoop& loop;
    const Ray& ray;
    detail::LatticeRay rounded;
};

std::string difference(const RayQuestion& question, const char* path, const char* what) {
    return std::string(path) + ": " + what + " differs: " + describe(question.ray);
}

std::optional<std::string> closest_difference(const RayQuestion& question, bool filtered) {
    const auto expected = question.loop.closest_hit(question.rounded, filtered ? third_is_left_out : nullptr);
    const auto keep = [](Triangle triangle) { return third_is_left_out(triangle.index); };
    const TriangleFilter filter = keep;
    const detail::BlobData& data = question.blob.data();
    for (const InstructionPath& path : instruction_paths()) {
        RayHit found;
        const bool hit = path.closest_hit(data, question.ray, found, filtered ? &filter : nullptr);
        if (hit != expected.has_value()) return difference(question, path.name, "whether there is a closest hit");
        if (hit && !same_bits(found, to_hit(question.rounded, *expected, question.ray))) {
            return difference(question, path.name, "the closest hit");
        }
        if (path.any_hit(data, question.ray, filtered ? &filter : nullptr) != hit) {
            return difference(question, path.name, "whether there is any hit");
        }
    }
    RayHit hit;
    const bool found =
        filtered ? raycast(question.blob, question.ray, hit, filter) : raycast(question.blob, question.ray, hit);
    if (found != expected.has_value()) return difference(question, "raycast", "whether there is a hit");
    if (found && !same_bits(hit, to_hit(question.rounded, *expected, question.ray))) {
        return difference(question, "raycast", "the hit");
    }
    const bool any = filtered ? occluded(question.blob, question.ray, filter) : occluded(question.blob, question.ray);
    if (any != found) return difference(question, "occluded", "the answer");
    return std::nullopt;
}

std::optional<std::string> every_difference(const RayQuestion& question, std::uint64_t& hits) {
    const std::vector<detail::FoundHit> expected = question.loop.every_hit(question.rounded);
    hits += expected.size();
    for (const InstructionPath& path : instruction_paths()) {
        std::size_t seen = 0;
        const bool all = path.every_hit(question.blob.data(), question.ray, [&](const RayHit& hit) {
            if (seen >= expected.size()) return stop;
            if (!same_bits(hit, to_hit(question.rounded, expected[seen], question.ray))) return stop;
            ++seen;
            return keep_going;
        });
        if (!all || seen != expected.size()) return difference(question, path.name, "the row of all hits");
    }
    std::size_t seen = 0;
    const bool all = for_each_hit(question.blob, question.ray, [&](const RayHit& hit) {
        if (seen >= expected.size()) return stop;
        if (!same_bits(hit, to_hit(question.rounded, expected[seen], question.ray))) return stop;
        ++seen;
        return keep_going;
    });
    if (!all || seen != expected.size()) return difference(question, "for_each_hit", "the row of all hits");
    return std::nullopt;
}

}  // namespace

std::optional<std::string> ray_difference(const Blob& blob, const TriangleLoop& loop, const Ray& ray,
                                          std::uint64_t& hits) {
    RayQuestion question{blob, loop, ray, {}};
    if (!detail::round_ray(blob.data(), ray, question.rounded)) {
        RayHit hit;
        if (raycast(blob, ray, hit) || occluded(blob, ray))
            return difference(question, "raycast", "a refused ray's answer");
        return std::nullopt;
    }
    if (auto found = closest_difference(question, false)) return found;
    if (auto found = closest_difference(question, true)) return found;
    return every_difference(question, hits);
}

std::optional<std::string> sphere_difference(const Blob& blob, const TriangleLoop& loop, const Sphere& sphere,
                                             std::uint64_t& hits) {
    const auto difference_at = [&](const char* path, const char* what) {
        return std::string(path) + ": " + what + " differs: " + describe(sphere);
    };
    detail::LatticePoint rounded;
    Nearest nearest;
    if (!detail::round_point(blob.data(), sphere.center, sphere.radius, rounded)) {
        if (overlaps(blob, sphere) || closest_point(blob, sphere.center, sphere.radius, nearest)) {
            return difference_at("overlaps", "a refused sphere's answer");
        }
        return std::nullopt;
    }
    const std::vector<std::uint32_t> expected = loop.every_overlap(rounded);
    const auto closest = loop.closest_triangle(rounded);
    hits += expected.size();
    const auto matches = [&](auto&& enumerate) {
        std::size_t seen = 0;
        const bool all = enumerate([&](Triangle triangle) {
            if (seen >= expected.size() || triangle.index != expected[seen]) return stop;
            ++seen;
            return keep_going;
        });
        return all && seen == expected.size();
    };
    for (const InstructionPath& path : instruction_paths()) {
        if (path.any_overlap(blob.data(), rounded) == expected.empty()) return difference_at(path.name, "any overlap");
        if (!matches([&](auto visit) { return path.every_overlap(blob.data(), rounded, visit); })) {
            return difference_at(path.name, "the row of all overlaps");
        }
        detail::FoundNearest found{};
        if (path.closest_triangle(blob.data(), rounded, found) != closest.has_value()) {
            return difference_at(path.name, "whether there is a closest triangle");
        }
        if (closest && !same_bits(found, *closest)) return difference_at(path.name, "the closest triangle");
    }
    if (overlaps(blob, sphere) == expected.empty()) return difference_at("overlaps", "the answer");
    if (!matches([&](auto visit) { return for_each_overlap(blob, sphere, visit); })) {
        return difference_at("for_each_overlap", "the row of all overlaps");
    }
    if (closest_point(blob, sphere.center, sphere.radius, nearest) != closest.has_value()) {
        return difference_at("closest_point", "whether there is one");
    }
    if (closest && nearest.triangle.index != closest->index) return difference_at("closest_point", "the triangle");
    return std::nullopt;
}

std::optional<std::string> path_difference(const Blob& blob, const Ray& ray) {
    if (blob.triangle_count() == 0) return std::nullopt;
    struct Answers {
        bool closest = false;
        bool any = false;
        RayHit hit;
        std::vector<RayHit> every;
    };
    const auto ask = [&](const InstructionPath& path) {
        Answers answers;
        answers.closest = path.closest_hit(blob.data(), ray, answers.hit, nullptr);
        answers.any = path.any_hit(blob.data(), ray, nullptr);
        path.every_hit(blob.data(), ray, [&](const RayHit& hit) {
            answers.every.push_back(hit);
            return keep_going;
        });
        return answers;
    };
    const Answers expected = ask(instruction_paths().front());
    for (const InstructionPath& path : instruction_paths()) {
        const Answers answers = ask(path);
        const bool same_row =
            std::equal(answers.every.begin(), answers.every.end(), expected.every.begin(), expected.every.end(),
                       [](const auto& a, const auto& b) { return same_bits(a, b); });
        if (answers.closest == expected.closest && answers.any == expected.any && same_row &&
            (!answers.closest || same_bits(answers.hit, expected.hit))) {
            continue;
        }
        return std::string(path.name) + " and scalar differ: " + describe(ray);
    }
    return std::nullopt;
}

std::optional<std::string> path_difference(const Blob& blob, const Sphere& sphere) {
    detail::LatticePoint rounded;
    if (blob.triangle_count() == 0 || !detail::round_point(blob.data(), sphere.center, sphere.radius, rounded)) {
        return std::nullopt;
    }
    struct Answers {
        bool closest = false;
        bool any = false;
        detail::FoundNearest nearest{};
        std::vector<Triangle> every;
    };
    const auto ask = [&](const InstructionPath& path) {
        Answers answers;
        answers.closest = path.closest_triangle(blob.data(), rounded, answers.nearest);
        answers.any = path.any_overlap(blob.data(), rounded);
        path.every_overlap(blob.data(), rounded, [&](Triangle triangle) {
            answers.every.push_back(triangle);
            return keep_going;
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
