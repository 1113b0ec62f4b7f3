// The kinds of leaves that this build of the runtime reads.
#pragma once

#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/strip_leaf.hpp>
