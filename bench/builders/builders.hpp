// The builders that are compared: those of the library, and those of the textbook.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::bench {

struct NamedBuilder {
    std::string family;  ///< what the builder has in common with some of the others
    std::string name;
    /// Builds as baker::build does. Of the settings a builder may replace those that its name states.
    std::function<baker::BinaryTree(const baker::LatticeMesh&, baker::BuildSettings)> build;
};

/// Returns all of them. The first one is binned SAH with 32 bins, the library's default.
std::vector<NamedBuilder> all_builders();

}  // namespace espalier::bench
