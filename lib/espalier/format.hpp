// The bytes of blobs, scenes and remap files: every offset, width and limit, once. docs/format.md is the normative
// text. All numbers are little-endian; nothing is aligned to more than a byte when read, so that a blob may lie
// anywhere.
#pragma once

#include <espalier/format/header.hpp>
#include <espalier/format/leaves.hpp>
#include <espalier/format/nodes.hpp>
#include <espalier/format/remap.hpp>
#include <espalier/format/scene.hpp>
#include <espalier/format/sections.hpp>
