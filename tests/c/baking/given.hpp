// Meshes as a program in C gives them to the baker: in several types, strides and addresses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/c/bake.h>

#include <c99.h>

#include "support/machine/exact_buffer.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::tests {

/// How the arrays of a mesh lie in memory.
struct Arrangement {
    espalier_coordinate_type coordinates = ESPALIER_COORDINATE_FLOAT32;
    espalier_index_type indices = ESPALIER_INDEX_UINT32;
    std::size_t gap = 0;  ///< bytes between elements
    bool backwards = false;
    std::size_t offset = 0;  ///< of the arrays' first bytes from a multiple of 16
};

/// A mesh and its view. The arrays end where the memory does.
class GivenMesh {
public:
    GivenMesh(const Mesh& mesh, const Arrangement& arrangement = {}, const double (&moved_by)[3] = {0.0, 0.0, 0.0})
        : name_(mesh.name), materials_(mesh.materials) {
        c99_init_mesh_view(&view_, sizeof view_);
        std::vector<std::byte> positions, triangles;
        for (const Vec3& p : mesh.positions) {
            const double xyz[3] = {double(p.x) + moved_by[0], double(p.y) + moved_by[1], double(p.z) + moved_by[2]};
            for (const double number : xyz) {
                if (arrangement.coordinates == ESPALIER_COORDINATE_FLOAT64) append(positions, number);
                else append(positions, static_cast<float>(number));
            }
        }
        for (const TriangleVertices& triangle : mesh.triangles)
            for (const std::uint32_t index : triangle) {
                if (arrangement.indices == ESPALIER_INDEX_UINT16) append(triangles, static_cast<std::uint16_t>(index));
                else append(triangles, index);
            }
        view_.coordinate_type = arrangement.coordinates;
        view_.index_type = arrangement.indices;
        view_.position_count = mesh.positions.size();
        view_.triangle_count = mesh.triangles.size();
        positions_ = lay_out(positions, view_.position_count, arrangement, view_.positions, view_.position_stride);
        triangles_ = lay_out(triangles, view_.triangle_count, arrangement, view_.triangles, view_.triangle_stride);
        view_.materials = materials_.empty() ? nullptr : materials_.data();
        view_.name = name_.c_str();
    }
    GivenMesh(const GivenMesh&) = delete;
    GivenMesh& operator=(const GivenMesh&) = delete;

    [[nodiscard]] espalier_mesh_view& view() { return view_; }

private:
    template <class Number>
    static void append(std::vector<std::byte>& bytes, Number number) {
        const auto* const first = reinterpret_cast<const std::byte*>(&number);
        bytes.insert(bytes.end(), first, first + sizeof number);
    }
    static std::unique_ptr<ExactBuffer> lay_out(std::span<const std::byte> packed, std::size_t count,
                                                const Arrangement& arrangement, const void*& first,
                                                std::ptrdiff_t& stride) {
        if (count == 0) return nullptr;
        const std::size_t element = packed.size() / count, step = element + arrangement.gap;
        std::vector<std::byte> bytes(step * (count - 1) + element, std::byte{0x5A});
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = arrangement.backwards ? count - 1 - i : i;
            std::memcpy(bytes.data() + at * step, packed.data() + i * element, element);
        }
        auto buffer = std::make_unique<ExactBuffer>(bytes, arrangement.offset);
        first = buffer->bytes().data() + (arrangement.backwards ? step * (count - 1) : 0);
        stride = arrangement.backwards ? -static_cast<std::ptrdiff_t>(step) : static_cast<std::ptrdiff_t>(step);
        return buffer;
    }

    espalier_mesh_view view_;
    std::string name_;
    std::vector<std::uint32_t> materials_;
    std::unique_ptr<ExactBuffer> positions_, triangles_;
};

/// Returns a view of packed arrays of doubles and indices.
inline espalier_mesh_view view_of(std::span<const double> positions, std::span<const std::uint32_t> indices) {
    espalier_mesh_view view;
    c99_init_mesh_view(&view, sizeof view);
    view.positions = positions.data();
    view.position_count = positions.size() / 3;
    view.position_stride = 3 * sizeof(double);
    view.coordinate_type = ESPALIER_COORDINATE_FLOAT64;
    view.triangles = indices.data();
    view.triangle_count = indices.size() / 3;
    return view;
}

/// A result that is released when it goes out of scope.
struct Release {
    void operator()(const espalier_bake_result* result) const { c99_release_bake_result(result); }
};
using BakedFromC = std::unique_ptr<const espalier_bake_result, Release>;

inline espalier_bake_options default_options_of_c() {
    espalier_bake_options options;
    c99_init_bake_options(&options, sizeof options);
    return options;
}

inline BakedFromC bake_from_c(const espalier_mesh_view& mesh, const espalier_bake_options& options) {
    return BakedFromC(c99_bake(&mesh, 1, &options));
}

inline std::span<const std::byte> bytes_of(const espalier_bake_result& result) {
    return {static_cast<const std::byte*>(result.bytes), result.byte_count};
}

}  // namespace espalier::tests
