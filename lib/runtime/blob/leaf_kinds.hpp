// The kinds of leaves that this build of the runtime reads.
#pragma once

#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/predicted_strip_leaf.hpp>
#include <runtime/base/options.hpp>
#include <runtime/blob/strip_leaf.hpp>
