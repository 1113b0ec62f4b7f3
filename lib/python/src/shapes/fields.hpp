// The shapes of a batch: each field of a shape is an argument that broadcasts against the others.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <pybind11/numpy.h>

#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include "floats.hpp"

namespace espalier::python {

/// The fields of the shapes of a batch, in the order in which Python has them.
class ShapeFields {
public:
    ShapeFields() = default;
    ShapeFields(const ShapeFields&) = delete;
    ShapeFields& operator=(const ShapeFields&) = delete;

    Floats& add(const py::tuple& fields, std::size_t place, const char* name, ElementShape element) {
        return fields_.emplace_back(fields[place], name, element);
    }
    /// Returns a field's element for a query.
    template <class Value>
    [[nodiscard]] Value at(std::size_t field, std::size_t query) const {
        Value value;
        __builtin_memcpy(static_cast<void*>(&value), fields_[field].at(query), sizeof value);
        return value;
    }
    /// Returns a field's element for a query, of a length that is known at run time, in memory of its own: NumPy's may
    /// be misaligned.
    template <class Value>
    [[nodiscard]] std::vector<Value> all_at(std::size_t field, std::size_t query) const {
        std::vector<Value> values(static_cast<std::size_t>(fields_[field].element_axis(0)));
        if (!values.empty())
            __builtin_memcpy(static_cast<void*>(values.data()), fields_[field].at(query),
                             values.size() * sizeof(Value));
        return values;
    }
    [[nodiscard]] Floats& operator[](std::size_t field) { return fields_[field]; }
    [[nodiscard]] std::size_t size() const { return fields_.size(); }

private:
    std::deque<Floats> fields_;
};

/// Spreads the fields, and one more argument if there is one.
inline Batch spread(ShapeFields& fields, Floats* more = nullptr) {
    std::vector<Floats*> all;
    for (std::size_t i = 0; i < fields.size(); ++i) all.push_back(&fields[i]);
    if (more != nullptr) all.push_back(more);
    return Batch(all);
}

/// Throws TypeError: the query takes no such shape.
[[noreturn]] inline void refuse_shape(const std::string& kind) { throw py::type_error("this query takes no " + kind); }

/// Adds the fields of a kind of shape and calls action(type, at), where at(query, use) calls `use` with a shape.
template <class Action>
auto with_shape(const std::string& kind, const py::tuple& given, ShapeFields& fields, const Action& action) {
    const auto vector = [&](std::size_t place, const char* name) { fields.add(given, place, name, {3}); };
    const auto number = [&](std::size_t place, const char* name) { fields.add(given, place, name, {}); };
    if (kind == "Sphere") {
        vector(0, "center");
        number(1, "radius");
        return action(std::type_identity<Sphere>(), [&fields](std::size_t i, const auto& use) {
            return use(Sphere{fields.at<Vec3>(0, i), fields.at<float>(1, i)});
        });
    }
    if (kind == "Capsule") {
        vector(0, "start");
        vector(1, "end");
        number(2, "radius");
        return action(std::type_identity<Capsule>(), [&fields](std::size_t i, const auto& use) {
            return use(Capsule{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i), fields.at<float>(2, i)});
        });
    }
    if (kind == "Box") {
        vector(0, "min");
        vector(1, "max");
        return action(std::type_identity<Box>(), [&fields](std::size_t i, const auto& use) {
            return use(Box{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i)});
        });
    }
    if (kind == "OrientedBox") {
        vector(0, "center");
        fields.add(given, 1, "half_axes", {3, 3});
        return action(std::type_identity<OrientedBox>(), [&fields](std::size_t i, const auto& use) {
            const auto axes = fields.at<Triangle>(1, i);
            return use(OrientedBox{fields.at<Vec3>(0, i), {axes.a, axes.b, axes.c}});
        });
    }
    if (kind == "Triangle") {
        fields.add(given, 0, "corners", {3, 3});
        return action(std::type_identity<Triangle>(),
                      [&fields](std::size_t i, const auto& use) { return use(fields.at<Triangle>(0, i)); });
    }
    if (kind == "Cone") {
        vector(0, "apex");
        vector(1, "axis");
        number(2, "radius");
        return action(std::type_identity<Cone>(), [&fields](std::size_t i, const auto& use) {
            return use(Cone{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i), fields.at<float>(2, i)});
        });
    }
    if (kind == "ConvexVolume") {
        fields.add(given, 0, "planes", {any, 4});
        return action(std::type_identity<ConvexVolume>(), [&fields](std::size_t i, const auto& use) {
            const auto planes = fields.all_at<Plane>(0, i);
            return use(ConvexVolume{planes});
        });
    }
    if (kind == "ConvexHull") {
        fields.add(given, 0, "vertices", {any, 3});
        return action(std::type_identity<ConvexHull>(), [&fields](std::size_t i, const auto& use) {
            const auto vertices = fields.all_at<Vec3>(0, i);
            return use(ConvexHull{vertices});
        });
    }
    if (kind == "Segment") {
        vector(0, "start");
        vector(1, "end");
        return action(std::type_identity<Segment>(), [&fields](std::size_t i, const auto& use) {
            return use(Segment{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i)});
        });
    }
    throw py::type_error("not a shape: " + kind);
}

}  // namespace espalier::python
