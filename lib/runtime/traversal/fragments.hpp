// The headers that fragments (.inl) need, whatever their instruction set.
#pragma once

#include <bit>
#include <type_traits>

#include <runtime/answers/answer.hpp>
#include <runtime/base/options.hpp>
#include <runtime/blob/leaf_kinds.hpp>
#include <runtime/traversal/bounded_triangles.hpp>
#include <runtime/traversal/box_nodes.hpp>
#include <runtime/traversal/leaf_triangles.hpp>
#include <runtime/traversal/small_boxes.hpp>
