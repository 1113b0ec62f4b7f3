// The lattice step that a command line fixes: written out, or that of another blob.
#pragma once

#include <string>

#include <espalier/lattice.hpp>

namespace espalier::tools {

/// The exponent e of a step of 2^e units, written as 2^-14 or as a number that is a power of two, such as 0.25. Throws
/// CommandError (usage) that names `option` when the text is neither.
int parse_step_exponent(const std::string& text, const char* option);

/// Returns the lattice of the blob in a file. Throws CommandError as open_blob_file does, and (invalid_input) for a
/// blob without triangles.
Lattice lattice_of_blob(const std::string& path);

}  // namespace espalier::tools
