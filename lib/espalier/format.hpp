// The byte layout of blobs, scenes and remap files: every offset, width and limit, defined once. docs/format.md is the
// normative text. All numbers are little-endian, and no read assumes more than byte alignment, so a blob may lie at any
// address.
#pragma once

#include <espalier/format/header.hpp>
#include <espalier/format/leaves.hpp>
#include <espalier/format/nodes.hpp>
#include <espalier/format/remap.hpp>
#include <espalier/format/scene.hpp>
#include <espalier/format/sections.hpp>
