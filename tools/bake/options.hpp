// From arguments to the options of a bake.
#pragma once

#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/lattice.hpp>

#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// The exponent e of a step of 2^e units, written as 2^-14 or as a number that is a power of two, such as 0.25. Throws
/// CommandError (usage) that names `option` when the text is neither.
int parse_step_exponent(const std::string& text, const char* option);

/// Returns the lattice of the blob in a file. Throws CommandError as open_blob_file does, and (invalid_input) for a
/// blob without triangles.
Lattice lattice_of_blob(const std::string& path);

/// Throws CommandError (usage) for options that --deformable excludes. Does nothing without it.
void refuse_options_of_rigid_blobs(const BakeArguments& arguments);

/// Returns what --range gives, without poses. Throws CommandError (usage) for a range that is no box.
Deformation deformation_of(const BakeArguments& arguments);

/// The poses of a bake: for each file of --poses its record, and the positions of its meshes in a row.
struct Poses {
    std::vector<ImportedFile> files;
    std::vector<std::vector<Vec3>> positions;
};

/// Imports poses of `meshes`, with the options that these were imported with. Throws CommandError as import_files does,
/// and (invalid_input) unless each pose has as many positions as the meshes, all of them finite.
Poses import_poses(const BakeArguments& arguments, const ImportOptions& options, const Imported& meshes);

}  // namespace espalier::tools
