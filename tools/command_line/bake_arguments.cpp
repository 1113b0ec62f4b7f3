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
            "many bytes, on the lattice of the other options")
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

void add_deformation(CLI::App* verb, BakeArguments& arguments) {
    CLI::Option* deformable = verb->add_flag(
        "--deformable", arguments.deformable,
        "Bake a blob whose vertices may move, by refit. Profile fast, and all vertices in the order of their file: "
        "OBJ, PLY and glTF");
    verb->add_option("--range", arguments.range,
                     "The box that no vertex of any pose leaves, by two corners, as lengths in the blob's units and "
                     "axes. It grows to hold the mesh and --poses. Without it, the box around these, wider by a tenth "
                     "of its largest side on each side")
        ->expected(6)
        ->needs(deformable)
        ->type_name("X0 Y0 Z0 X1 Y1 Z1");
    verb->add_option("--poses", arguments.poses,
                     "Poses that the tree suits, each a file with all vertices of the mesh, in the same order. Its "
                     "faces do not count; --unit, --scale and --up apply to it as well")
        ->needs(deformable)
        ->type_name("MESH");
}

}  // namespace

void add_bake(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<BakeArguments>();
    CLI::App* verb = add_verb(app, "bake", "Make one blob or scene out of mesh files");
    verb->add_option(
            "inputs", arguments->inputs,
            "Mesh files in the order of their file numbers: glTF 2.0, OBJ, PLY, STL and RAW, which the command "
            "reads itself, and, in a build with assimp, its other formats, such as FBX, Collada and 3DS. Node "
            "transforms "
            "are applied; animated meshes are taken in the pose that the file stores")
        ->required()
        ->type_name("MESH");
    verb->add_option("-o,--output", arguments->output, "The blob to write; with --instances, the scene")
        ->required()
        ->type_name("BLOB");
    const Choices<Instancing> instancing{
        {"off", Instancing::off}, {"auto", Instancing::automatic}, {"all", Instancing::all}};
    add_choice(
        verb, "--instances", arguments->instancing, instancing,
        "Make a scene, in which a repeated mesh is stored once. auto merges meshes that are not repeated, or too "
        "small to save bytes; all makes every mesh an instance. A tolerance holds in the world, --bits for each "
        "mesh. Without it off: one blob");
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
    CLI::Option* bits =
        verb->add_option("--bits", arguments->bits, "How many bits hold a coordinate along the largest extent")
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
               "How leaves are stored, and how large they may be. Without it: balanced, or what is picked");
    verb->add_option("--leaf-size", arguments->leaf_size,
                     "Most triangles of a leaf; without it, what the profile holds or what is picked")
        ->check(between(1u, format::max_leaf_triangles))
        ->type_name(text("1..", format::max_leaf_triangles));
    verb->add_option("--byte-price", arguments->byte_price,
                     "For studies: the price of one byte per triangle, in node visits of an average ray. A higher "
                     "price gives a smaller blob and slower rays. Without it 5, or what is picked")
        ->check(between(0.0f, 1e6f))
        ->type_name("NUMBER");
    add_choice(verb, "--builder", arguments->builder, builder_choices,
               "How the tree is built, before --effort improves it. Without it: binned_sah, or what is picked");
    verb->add_option("--duplicate-budget", arguments->duplicate_budget,
                     "With --builder spatial_splits, the largest share of the triangles that is stored again in "
                     "further leaves; without it 0.3")
        ->check(between(0.0, 1.0))
        ->type_name("0..1");
    add_source(verb, arguments->source);
    verb->add_flag("--ids", arguments->original_ids, "Store the file, mesh and triangle that each triangle comes from");
    verb->add_flag("--materials", arguments->materials,
                   "Store the material number of each triangle, in 8 bits if all are below 256, else in 16");
    verb->add_option(
            "--flat-angle", arguments->flat_angle,
            "Store how the surface bends at each edge, so that contacts can slide over inner edges. Up to this "
            "angle between two triangles, from 0 to below 90, the edge is flat; 5 suits most meshes")
        ->type_name("DEGREES");
    verb->add_option(
            "--bounds", arguments->bounds,
            "Store bounds of the whole asset, any of obb,sphere,kdop: an oriented box, a sphere, slabs along 13 "
            "directions")
        ->delimiter(',')
        ->check(one_of({"obb", "sphere", "kdop"}))
        ->allow_extra_args(false)
        ->type_name("NAMES");
    verb->add_flag("--drop-bad-triangles", arguments->drop_bad_triangles,
                   "Drop triangles with NaN, infinite or missing corners instead of refusing the mesh");
    add_deformation(verb, *arguments);
    verb->add_option(
            "--max-dropped", arguments->max_dropped,
            "Most triangles of the source, in percent, that may be dropped for having no area, in the source or "
            "on the lattice, or by --drop-bad-triangles; duplicates do not count. Beyond it nothing is written")
        ->capture_default_str()
        ->transform(percentage())
        ->check(between(0.0, 100.0))
        ->type_name("PERCENT");
    verb->add_option("--expect-size", arguments->expected_size,
                     "Refuse an asset whose largest side is not between these two lengths: 0.1m..10m")
        ->type_name("LENGTH..LENGTH");
    add_choice(verb, "--effort", arguments->effort, effort_choices,
               "How long to search for a better tree: fast builds it once, normal also moves subtrees to better "
               "places, best moves more of them and takes two to five times as long. Without it: normal");
    verb->add_option("--threads", arguments->threads,
                     "How many threads bake, 0 for all of the machine. The bytes do not depend on it")
        ->capture_default_str()
        ->type_name("COUNT");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_bake(*arguments); }; });
}

}  // namespace espalier::tools
