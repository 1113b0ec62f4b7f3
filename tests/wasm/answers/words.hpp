// Answers as words of 32 bits, in files.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>

/// The folder of questions and answers, with a slash at the end.
extern std::string folder;

/// Writes bytes to a file of the folder.
void write_file(const std::string& name, const void* bytes, std::size_t size);

/// Answers of one kind of query, word by word. They are written to a file at the end.
class Words {
public:
    explicit Words(std::string name) : name_(std::move(name)) {}
    Words(const Words&) = delete;
    Words& operator=(const Words&) = delete;
    ~Words();

    template <class... Fields>
    void add(const Fields&... fields) {
        (add_field(fields), ...);
    }

private:
    void add_field(float number) { words_.push_back(std::bit_cast<std::uint32_t>(number)); }
    void add_field(espalier::TriangleId triangle) { words_.push_back(triangle.index); }
    void add_field(const espalier::Vec3& vector) { add(vector.x, vector.y, vector.z); }
    void add_field(const espalier::InstanceId& instance) { add(instance.index, instance.in_tile); }
    template <class Number>
    void add_field(const Number& number) {
        words_.push_back(static_cast<std::uint32_t>(number));
    }

    std::string name_;
    std::vector<std::uint32_t> words_;
};

inline void add(Words& words, const espalier::RayHit& hit) {
    words.add(hit.t, hit.u, hit.v, hit.normal, hit.triangle, hit.status, hit.side);
}

inline void add(Words& words, const espalier::ClosestPoint& point) {
    words.add(point.point, point.on_shape, point.face_normal, point.distance, point.u, point.v, point.triangle,
              point.status, point.feature, point.side);
}

inline void add(Words& words, const espalier::Contact& contact) {
    words.add(contact.point, contact.normal, contact.distance, contact.triangle, contact.feature, contact.side);
}

inline void add(Words& words, const espalier::SweepHit& hit) {
    words.add(hit.t, hit.point, hit.normal, hit.face_normal, hit.triangle, hit.status, hit.feature,
              hit.starts_overlapping);
}

inline void add(Words& words, const espalier::Instance& instance) {
    const espalier::Quaternion& rotation = instance.transform.rotation;
    words.add(rotation.x, rotation.y, rotation.z, rotation.w, instance.transform.translation, instance.transform.scale,
              instance.mesh, instance.mask, instance.user, instance.source);
}
