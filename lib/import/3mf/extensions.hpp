// Extensions of 3MF: which of them change geometry, and are not read.
#pragma once

#include <string>
#include <string_view>

#include <import/base/importers.hpp>

namespace espalier::importer {

/// Returns the name of an extension that changes or adds geometry; empty for another namespace.
std::string_view name_of_3mf_geometry(std::string_view name_space);

/// For an extension that a model requires. `words` name the model. Throws ImportError (unsupported) for one that
/// changes geometry; appends a warning for one that is unknown.
void require_known_3mf_extension(const std::string& words, std::string_view name_space, ImportedFile& file);

}  // namespace espalier::importer
