// The structures that are compared, each with the same queries.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <espalier/blob.hpp>

#include "../exactness/edge_rays.hpp"
#include "cells.hpp"

namespace espalier::bench {

/// A structure over the triangles of a mesh.
class Structure {
public:
    Structure() = default;
    Structure(const Structure&) = delete;
    Structure& operator=(const Structure&) = delete;
    virtual ~Structure() = default;

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] virtual double closest(const Ray& ray, CellWork& work) = 0;
    /// Counts the triangles that touch the box.
    [[nodiscard]] virtual std::size_t count_touching(const Aabb& box, CellWork& work) = 0;

    std::string name;
    double build_seconds = 0.0;  ///< processor time
    std::size_t cells = 0;       ///< or nodes
    std::size_t references = 0;  ///< to triangles
    std::size_t bytes = 0;
    bool has_triangles = false;  ///< in these bytes
    bool has_work = true;        ///< queries count it
    bool is_reference = true;    ///< all such structures have the same answers
};

/// A mesh on a lattice, whose floats represent it exactly, and its textbook tree.
struct SubdivisionSubject {
    SnappedMesh snapped;
    TreeAndBlob built;
    Blob blob;
};
/// Throws std::runtime_error with the mesh's name.
[[nodiscard]] SubdivisionSubject make_subdivision_subject(Mesh mesh);

/// Returns the textbook tree, a grid, a k-d tree and Espalier. The subject outlives them.
[[nodiscard]] std::vector<std::unique_ptr<Structure>> all_structures(const SubdivisionSubject& subject);
/// Returns the textbook structures with another test of rays and triangles, which outlives them, as the subject does.
[[nodiscard]] std::vector<std::unique_ptr<Structure>> structures_with_float_test(const SubdivisionSubject& subject,
                                                                                 const FloatTest& float_test);

}  // namespace espalier::bench
