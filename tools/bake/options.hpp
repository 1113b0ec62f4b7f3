// From arguments to the options of a bake.
#pragma once

#include <vector>

#include <espalier/bake.hpp>

#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

/// Throws CommandError (usage) for options that --deformable excludes. Does nothing without it.
void refuse_options_of_rigid_blobs(const BakeArguments& arguments);

/// Throws CommandError (usage) for options that make sense for a single blob only, if a scene is to be baked.
void refuse_options_of_blobs(const BakeArguments& arguments);

/// Returns the options of the bake, without poses. Throws CommandError (usage) for texts that are no lengths, steps or
/// ranges, and as open_blob_file does for --lattice-of.
BakeOptions bake_options(const BakeArguments& arguments);

/// The poses of a bake: for each file of --poses its record, and the positions of its meshes in a row.
struct Poses {
    std::vector<ImportedFile> files;
    std::vector<std::vector<Vec3>> positions;
};

/// Imports poses of `meshes`, with the options that these were imported with. Throws CommandError as import_files does,
/// and (invalid_input) unless each pose has as many positions as the meshes, all of them finite.
Poses import_poses(const BakeArguments& arguments, const ImportOptions& options, const Imported& meshes);

}  // namespace espalier::tools
