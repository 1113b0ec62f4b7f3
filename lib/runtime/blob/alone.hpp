// Makes all names visible to a fragment (.inl) that is parsed alone (docs/architecture.md, *Instruction sets*).
#pragma once

#include <runtime/blob/leaf_kinds.hpp>

using namespace espalier;
using namespace espalier::detail;
