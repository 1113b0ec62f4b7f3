// Answers as words of 32 bits, in files.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <espalier/contact.hpp>
#include <espalier/espalier.hpp>
#include <espalier/pair.hpp>
#include <espalier/scene.hpp>

namespace espalier::answers {

/// Answers of one kind of query, word by word.
class Words {
public:
    /// Adds fields, and those of structures in their order.
    template <class... Fields>
    void add(const Fields&... fields) {
        (add_field(fields), ...);
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words_)); }

private:
    void add_field(float number) { words_.push_back(std::bit_cast<std::uint32_t>(number)); }
    void add_field(TriangleId triangle) { words_.push_back(triangle.index); }
    void add_field(const Vec3& vector) { add(vector.x, vector.y, vector.z); }
    void add_field(const InstanceId& instance) { add(instance.index, instance.in_tile); }
    void add_field(const RayHit& hit) { add(hit.t, hit.u, hit.v, hit.normal, hit.triangle, hit.status, hit.side); }
    void add_field(const ClosestPoint& point) {
        add(point.point, point.on_shape, point.face_normal, point.distance, point.u, point.v, point.triangle,
            point.status, point.feature, point.side);
    }
    void add_field(const Contact& contact) {
        add(contact.point, contact.normal, contact.distance, contact.triangle, contact.feature, contact.side);
    }
    void add_field(const ContactPlane& plane) { add(plane.normal, plane.distance, plane.triangle); }
    void add_field(const SweepHit& hit) {
        add(hit.t, hit.point, hit.normal, hit.face_normal, hit.triangle, hit.status, hit.feature,
            hit.starts_overlapping);
    }
    void add_field(const OriginalHit& hit) { add(hit.file, hit.mesh, hit.triangle, hit.u, hit.v, hit.status); }
    void add_field(const PairContact& pair) { add(pair.a, pair.b, pair.status); }
    void add_field(const PairTouch& touch) {
        for (const Vec3& point : touch.points) add(point);
        add(touch.normal, touch.depth, touch.a, touch.b, touch.count, touch.status);
    }
    void add_field(const BlobDistance& found) {
        add(found.distance, found.on_a, found.on_b, found.a, found.b, found.status);
    }
    void add_field(const Instance& instance) {
        const auto& [rotation, translation, scale] = instance.transform;
        add(rotation.x, rotation.y, rotation.z, rotation.w, translation, scale, instance.mesh, instance.mask,
            instance.user, instance.source);
    }
    template <class Hit>
    void add_field(const InScene<Hit>& found) {
        add(found.hit, found.instance);
    }
    template <class Value>
    void add_field(const Result<Value>& result) {
        add(result.value, result.status);
    }
    template <class Number>
    void add_field(const Number& number) {
        words_.push_back(static_cast<std::uint32_t>(number));
    }

    std::vector<std::uint32_t> words_;
};

/// The answers of all kinds, each of which main() writes to a file of its name.
inline std::map<std::string, Words> words;

/// Adds how many elements a query wrote to an array, its status, and the elements.
template <class Array>
void add_filled(const std::string& name, const Filled& filled, const Array& array) {
    words[name].add(filled.count, filled.status);
    for (const auto& element : filled.in(array)) words[name].add(element);
}

}  // namespace espalier::answers
