// The steps of a bake: its options, imports and bakes that end the verb when they fail, and the files that it writes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>
#include <espalier/import.hpp>
#include <espalier/types.hpp>

#include "base/exit_code.hpp"
#include "base/verb_arguments.hpp"

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

/// Imports poses of `meshes`, with the options that these were imported with; positions count from the origin. Throws
/// CommandError as import_or_throw does, and (invalid_input) unless each pose has as many positions as the meshes, all
/// of them finite.
Poses import_poses(const BakeArguments& arguments, const ImportOptions& options, const ImportResult& meshes,
                   const Vec3d& origin);

/// Returns the origin that a bake with these options has. That which the baker would choose for one resolution is
/// right for coarser ones, too.
Vec3d origin_of(const ImportResult& imported, const BakeOptions& options);

/// Returns options with which the warnings of the import are printed and added to `warnings`, which must live as long.
/// With `json`, a file that ends the process leaves a document on stdout. Throws CommandError (usage) on a scale that
/// is not positive or a unit that does not exist.
ImportOptions import_options(const SourceArguments& arguments, bool json, std::vector<Warning>& warnings);

/// Imports the files. Throws CommandError: (usage) for a format that does not exist, (file_access) when a file cannot
/// be read, (invalid_input) when it is broken or no known format, (unsupported) beyond the format's limits.
ImportResult import_or_throw(std::span<const std::string> paths, const ImportOptions& options);

/// Imports the files and shows how much of it is done, unless `quiet`. Throws as import_or_throw.
ImportResult import_with_progress(std::span<const std::string> paths, ImportOptions options, bool quiet);

/// Throws CommandError with the baker's reason and the exit code that it stands for, and (internal) when the reader
/// refuses what was baked: what is written has been read by those who will read it.
BakeResult bake_or_throw(const ImportResult& imported, const BakeOptions& options);

/// The same for meshes that were made of an import, whose files its messages name.
BakeResult bake_or_throw(std::span<const MeshView> meshes, const ImportResult& imported, const BakeOptions& options);

/// The same for a trial, which never warns of lost_closed (baker::bake_trial).
BakeResult bake_trial_or_throw(const ImportResult& imported, const BakeOptions& options);

/// Returns the place for scripts.
ErrorDetails details_of(const SourcePlace& place, const ImportResult& imported);

/// The view of what was just baked; the bytes must outlive it.
Blob opened(const BakeResult& baked);

/// The bytes of each; those that the arguments do not name may be empty.
struct BakeOutputs {
    std::span<const std::byte> result;
    std::span<const std::byte> remap;
    std::span<const std::byte> reordered;
};

/// Writes the outputs that the arguments name. The depfile lists the files of the import and `poses`. Throws
/// CommandError (file_access).
void write_outputs(const BakeArguments& arguments, const ImportResult& imported, std::span<const ImportedFile> poses,
                   const BakeOutputs& outputs);

/// Throws CommandError (usage) unless the name ends in .obj or .ply.
void require_writable_mesh(const std::string& path);

/// The bytes of the file: OBJ, or PLY in little-endian binary. Positions are those of the imported meshes one after the
/// other, unrounded, as float32 where all of them are such numbers, else as float64; each triangle begins with the
/// corner that the blob's does.
std::vector<std::byte> reordered_mesh(const std::string& path, const ImportResult& imported,
                                      std::span<const OriginalTriangle> remap);

}  // namespace espalier::tools
