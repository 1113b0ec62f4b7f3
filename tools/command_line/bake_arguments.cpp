// What bake takes.
#include <memory>
#include <vector>

#include "arguments.hpp"
#include "base/numbers.hpp"
#include "commands/commands.hpp"

namespace espalier::tools {

namespace {

/// The options that try several bakes and keep one. They judge by counters, so that every machine picks the same.
void add_picking(CLI::App* verb, BakeArguments& arguments, const std::vector<CLI::Option*>& lattice) {
    CLI::Option* max_bytes =
        verb->add_option(
                "--max-bytes", arguments.max_bytes,
                "Pick what fits into so many bytes (64K, 1.5M): the finest lattice up to --bits at which "
                "anything fits, and there the profile, builder, leaf size and price of bytes with the least counted "
                "work. With --tolerance, --step, --lattice-of or --max-error the lattice stays")
            ->type_name("BYTES");
    verb->add_option(
            "--fastest-under", arguments.fastest_under,
            "Pick the profile, builder, leaf size and price of bytes with the least counted work that fits into so "
            "many bytes, at the lattice asked for")
        ->excludes(max_bytes)
        ->type_name("BYTES");
    CLI::Option* max_error =
        verb->add_option(
                "--max-error", arguments.max_error,
                "Pick the profile, builder, leaf size and price of bytes with the least counted work, on the coarsest "
                "lattice that keeps this distance between source and blob")
            ->type_name("LENGTH");
    for (CLI::Option* option : lattice) max_error->excludes(option);
}

}  // namespace

void add_bake(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<BakeArguments>();
    CLI::App* verb = add_verb(app, "bake", "Make one blob out of mesh files");
    verb->add_option(
            "inputs", arguments->inputs,
            "Mesh files in the order of their file numbers: glTF 2.0, OBJ, PLY, STL and RAW, which the command "
            "reads itself, and what assimp reads besides, such as FBX, Collada and 3DS. Node transforms are "
            "applied; animated meshes are taken in the pose that the file stores")
        ->required()
        ->type_name("MESH");
    verb->add_option("-o,--output", arguments->output, "The blob to write")->required()->type_name("BLOB");
    verb->add_option("--depfile", arguments->depfile,
                     "Also write which files were read, those that a mesh refers to included, as a rule that Make, "
                     "Ninja and CMake understand")
        ->type_name("FILE");
    verb->add_option("--remap", arguments->remap,
                     "Also write which triangle of the source each triangle of the blob is: 16 bytes a triangle, "
                     "nothing in the blob")
        ->type_name("FILE");
    verb->add_option("--reorder", arguments->reorder,
                     "Also write the source as one mesh, .obj or .ply, whose n-th triangle is the blob's triangle n, "
                     "corner for corner: a program that draws it needs neither ids nor a remap. Without materials, "
                     "groups and what was dropped; in the blob's units and axes; copies of triangles repeat them. PLY "
                     "keeps every bit of "
                     "a coordinate; readers of OBJ may round the last one")
        ->type_name("MESH");
    CLI::Option* tolerance =
        verb->add_option("--tolerance", arguments->tolerance,
                         "Largest distance between source and blob: 0.5mm, 2cm, 1e-3m, 1in; a bare number is in units "
                         "of the blob")
            ->type_name("LENGTH");
    CLI::Option* bits = verb->add_option("--bits", arguments->bits, "Lattice bits over the largest extent")
                            ->capture_default_str()
                            ->check(between(1u, 24u))
                            ->excludes(tolerance)
                            ->type_name("1..24");
    CLI::Option* step = verb->add_option("--step", arguments->step,
                                         "Lattice step, a power of two in units of the blob: 2^-14. Blobs with one "
                                         "step share lattice points where their meshes share vertices")
                            ->excludes(tolerance)
                            ->excludes(bits)
                            ->type_name("2^N");
    CLI::Option* lattice_of =
        verb->add_option("--lattice-of", arguments->lattice_of, "Take the lattice step of another blob")
            ->excludes(tolerance)
            ->excludes(bits)
            ->excludes(step)
            ->type_name("BLOB");
    add_picking(verb, *arguments, {tolerance, bits, step, lattice_of});
    add_choice(verb, "--profile", arguments->profile, profile_choices,
               "How leaves are coded, and how large they may be. Without it: balanced, or what is picked");
    verb->add_option("--leaf-size", arguments->leaf_size,
                     "Most triangles of a leaf; without it, what the profile holds or what is picked")
        ->check(between(1u, format::max_leaf_triangles))
        ->type_name(text("1..", format::max_leaf_triangles));
    verb->add_option("--cost-model", arguments->cost_model,
                     "JSON object with any of node_visit, leaf_visit, leaf_group, triangle and byte_price: what the "
                     "tree is shaped by")
        ->type_name("FILE");
    add_choice(verb, "--builder", arguments->builder, builder_choices,
               "How the tree is built, before --effort improves it. Without it: binned_sah");
    verb->add_option("--duplicates", arguments->duplicates,
                     "With --builder spatial_splits, at most so many copies of triangles, as a share of them; without "
                     "it 0.3. A blob with copies does not enumerate what a ray or sphere meets")
        ->check(between(0.0, 1.0))
        ->type_name("0..1");
    add_source(verb, arguments->source);
    verb->add_flag("--ids", arguments->original_ids, "Carry each triangle's file, mesh and number in it");
    const Choices<unsigned> widths{{"8", 8u}, {"16", 16u}};
    add_choice(verb, "--materials", arguments->material_bits, widths,
               "Carry each triangle's material number, in so many bits");
    CLI::Option* edge_flags =
        verb->add_flag("--edge-flags", arguments->edge_flags,
                       "Carry how the surface bends at each edge, so that contacts can slide over inner ones");
    verb->add_option("--flat-angle", arguments->flat_angle,
                     "With --edge-flags, the largest angle between two triangles that is flat; below 90")
        ->capture_default_str()
        ->needs(edge_flags)
        ->type_name("DEGREES");
    verb->add_option(
            "--bounds", arguments->bounds,
            "Carry bounds of the whole asset, any of obb,sphere,kdop: an oriented box, a sphere, slabs along 13 "
            "directions")
        ->delimiter(',')
        ->check(one_of({"obb", "sphere", "kdop"}))
        ->allow_extra_args(false)
        ->type_name("NAMES");
    verb->add_flag("--repair", arguments->repair,
                   "Drop triangles with NaN, infinite or missing corners instead of refusing the mesh");
    verb->add_option(
            "--max-dropped", arguments->max_dropped,
            "Most triangles of the source, in percent, that may be dropped for having no area, in the source or "
            "on the lattice, or under --repair; duplicates do not count. Beyond it nothing is written")
        ->capture_default_str()
        ->transform(percentage())
        ->check(between(0.0, 100.0))
        ->type_name("PERCENT");
    verb->add_option("--expect-size", arguments->expected_size,
                     "Refuse an asset whose largest side is not between these two lengths: 0.1m..10m")
        ->type_name("LENGTH..LENGTH");
    verb->add_option("--effort", arguments->effort,
                     "0 bakes fastest, 9 bakes best: more candidate splits throughout; subtrees are moved to better "
                     "places once from 4 on, twice at 6, three times from 7 on, down to 16, 8, 4 or 2 triangles")
        ->capture_default_str()
        ->check(between(0u, 9u))
        ->type_name("0..9");
    verb->add_option("--threads", arguments->threads, "0: all of the machine. The bytes do not depend on it")
        ->capture_default_str()
        ->type_name("COUNT");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_bake(*arguments); }; });
}

}  // namespace espalier::tools
