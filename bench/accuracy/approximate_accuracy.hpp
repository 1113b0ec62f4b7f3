// The queries that may err by as much as you allow: how often and how far they do, and what work that saves.
#pragma once

#include <cstddef>

#include <espalier/blob.hpp>

#include "../../tests/oracle/double_tree.hpp"
#include "../../tests/support/meshes/mesh.hpp"

namespace espalier::bench {

/// Prints a JSON object a line for each query and accuracy, each beginning with `head`, which is an object's first
/// fields.
void print_approximate_accuracy(const char* head, const Blob& blob, const tests::Mesh& mesh,
                                const reference::DoubleTree& source, std::size_t questions);

}  // namespace espalier::bench
