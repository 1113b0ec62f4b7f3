// The vocabulary of one lane, for a fragment (.inl) that is parsed alone (docs/architecture.md, *Instruction sets*).
#pragma once

#include <runtime/blob/alone.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/traversal/fragments.hpp>

using namespace espalier::detail::scalar;
