// Sixth stage: the whole blob.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/bake.hpp>

#include <baker/base/expected.hpp>
#include <baker/build/binary_tree.hpp>
#include <baker/collapse/order.hpp>
#include <baker/input/source.hpp>
#include <baker/quantise/lattice_mesh.hpp>
#include <baker/sections/optional_sections.hpp>

namespace espalier::baker {

/// Fields of the header that no other stage's result holds.
struct Properties {
    float max_error = 0.0f;
    bool closed = false;
};

Expected<std::vector<std::byte>> encode(const Source& source, const LatticeMesh& mesh, const BinaryTree& tree,
                                        const WideTree& wide, const BakeOptions& options, const Properties& properties,
                                        const OptionalSections& sections);

}  // namespace espalier::baker
