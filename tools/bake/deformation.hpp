// What bake takes for deformable blobs: the range of motion, and files with poses.
#pragma once

#include <vector>

#include <espalier/bake.hpp>

#include "base/verb_arguments.hpp"
#include "import/base/imported.hpp"

namespace espalier::tools {

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
