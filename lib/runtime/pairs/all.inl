// What the search through two blobs of an instruction set consists of.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/traversal/traverse.inl>
#include <runtime/traversal/node_boxes.inl>
#include <runtime/pairs/queries.hpp>
#endif

#include <runtime/pairs/trees.inl>
#include <runtime/pairs/search.inl>
