// The shapes of a batch: each field of a shape is an argument that broadcasts against the others.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <pybind11/numpy.h>

#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include "floats.hpp"

namespace espalier::python {

/// Shapes as Python has them: the name of their class, their fields, and the origin of the blob that they are for.
struct GivenShapes {
    std::string_view kind;
    const py::tuple& fields;
    Origin origin = {};
};

/// The fields of the shapes of a batch, in the order in which Python has them.
class ShapeFields {
public:
    explicit ShapeFields(const Origin& origin) : origin_(origin) {}
    ShapeFields(const ShapeFields&) = delete;
    ShapeFields& operator=(const ShapeFields&) = delete;

    Floats& add(const py::tuple& fields, std::size_t number, const char* name, ElementShape element) {
        return fields_.emplace_back(fields[number], name, element);
    }
    /// Adds a field of places, or of planes.
    Floats& add_places(const py::tuple& fields, std::size_t number, const char* name, ElementShape element) {
        return fields_.emplace_back(fields[number], name, element, origin_);
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
    Origin origin_;
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
[[noreturn]] inline void refuse_shape(std::string_view kind) {
    throw py::type_error("this query takes no " + std::string(kind));
}

/// Adds the fields of shapes and calls action(type, at), where at(query, use) calls `use` with a shape.
template <class Action>
auto with_shape(const GivenShapes& given, ShapeFields& fields, const Action& action) {
    const std::string_view kind = given.kind;
    const auto place = [&](std::size_t i, const char* name) { fields.add_places(given.fields, i, name, {3}); };
    const auto number = [&](std::size_t i, const char* name) { fields.add(given.fields, i, name, {}); };
    if (kind == "Sphere") {
        place(0, "center");
        number(1, "radius");
        return action(std::type_identity<Sphere>(), [&fields](std::size_t i, const auto& use) {
            return use(Sphere{fields.at<Vec3>(0, i), fields.at<float>(1, i)});
        });
    }
    if (kind == "Capsule") {
        place(0, "start");
        place(1, "end");
        number(2, "radius");
        return action(std::type_identity<Capsule>(), [&fields](std::size_t i, const auto& use) {
            return use(Capsule{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i), fields.at<float>(2, i)});
        });
    }
    if (kind == "Box") {
        place(0, "min");
        place(1, "max");
        return action(std::type_identity<Box>(), [&fields](std::size_t i, const auto& use) {
            return use(Box{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i)});
        });
    }
    if (kind == "OrientedBox") {
        place(0, "center");
        fields.add(given.fields, 1, "half_axes", {3, 3});
        return action(std::type_identity<OrientedBox>(), [&fields](std::size_t i, const auto& use) {
            const auto axes = fields.at<Triangle>(1, i);
            return use(OrientedBox{fields.at<Vec3>(0, i), {axes.a, axes.b, axes.c}});
        });
    }
    if (kind == "Triangle") {
        fields.add_places(given.fields, 0, "corners", {3, 3});
        return action(std::type_identity<Triangle>(),
                      [&fields](std::size_t i, const auto& use) { return use(fields.at<Triangle>(0, i)); });
    }
    if (kind == "Cone") {
        place(0, "apex");
        fields.add(given.fields, 1, "axis", {3});
        number(2, "radius");
        return action(std::type_identity<Cone>(), [&fields](std::size_t i, const auto& use) {
            return use(Cone{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i), fields.at<float>(2, i)});
        });
    }
    if (kind == "ConvexVolume") {
        fields.add_places(given.fields, 0, "planes", {any, 4});
        return action(std::type_identity<ConvexVolume>(), [&fields](std::size_t i, const auto& use) {
            const auto planes = fields.all_at<Plane>(0, i);
            return use(ConvexVolume{planes});
        });
    }
    if (kind == "ConvexHull") {
        fields.add_places(given.fields, 0, "vertices", {any, 3});
        return action(std::type_identity<ConvexHull>(), [&fields](std::size_t i, const auto& use) {
            const auto vertices = fields.all_at<Vec3>(0, i);
            return use(ConvexHull{vertices});
        });
    }
    if (kind == "Segment") {
        place(0, "start");
        place(1, "end");
        return action(std::type_identity<Segment>(), [&fields](std::size_t i, const auto& use) {
            return use(Segment{fields.at<Vec3>(0, i), fields.at<Vec3>(1, i)});
        });
    }
    throw py::type_error("not a shape: " + std::string(kind));
}

}  // namespace espalier::python
