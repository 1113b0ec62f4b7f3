// What the vocabulary of each instruction set includes. Its parts (.inl) are pasted into the namespace of the set.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <runtime/base/bits.hpp>
#include <runtime/base/vector.hpp>
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/blob/leaf_kinds.hpp>
#include <runtime/blob/vertex_word.hpp>
#include <runtime/lanes/prepared_ray.hpp>
#include <espalier/base/compiler.hpp>
#include <runtime/lanes/unpack_table.hpp>
