// Triangles with duplicate references: which of them reports the triangle when all triangles are enumerated.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/base/options.hpp>
#include <runtime/lattice/round_ray.hpp>

namespace espalier::detail {

/// Leaves of the profile fast alone have duplicate references.
inline constexpr bool reads_duplicate_references = reads_plain_leaves && reads(format::feature::split_references);

/// Returns which of some children of a node a walk visits.
using ReachedChildren = FunctionRef<unsigned(const PlainNode& node, unsigned children)>;

/// Returns whether a duplicate reference is the first of its triangle's references, in storage order, that a walk
/// reaches; the lowest reference is the first one wherever it is reached. It walks the tree again, only through boxes
/// that the triangle touches, and stops at the first reference.
bool is_first_reference(const BlobData& blob, std::uint32_t index, ReachedChildren reached);

/// Returns the same for a ray. It counts the boxes that the ray passes through in exact arithmetic, so the answer does
/// not depend on how a machine rounds.
bool is_first_reference(const BlobData& blob, std::uint32_t index, const IntegerRay& ray);

}  // namespace espalier::detail
