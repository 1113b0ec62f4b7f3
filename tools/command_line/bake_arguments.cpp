// What bake takes.
#include "arguments.hpp"

#include <import/base/numbers.hpp>

namespace espalier::tools {

namespace {

/// The options that try several bakes and keep one. They judge by counters, so that every machine picks the same.
void add_picking(Verb verb, BakeArguments& arguments, const std::vector<Option>& lattice) {
    const Option max_bytes = verb.option(
        "--max-bytes", arguments.max_bytes, "BYTES",
        "Pick what fits into so many bytes (64K, 1.5M): the finest lattice up to --bits at which "
        "anything fits, and there the profile, builder, leaf size and price of bytes with the least counted "
        "work. With --tolerance, --step, --lattice-of or --max-error the lattice stays");
    verb.option("--fastest-under", arguments.fastest_under, "BYTES",
                "Pick the profile, builder, leaf size and price of bytes with the least counted work that fits into so "
                "many bytes, on the lattice of the other options")
        .excludes(max_bytes);
    Option max_error = verb.option(
        "--max-error", arguments.max_error, "LENGTH",
        "Pick the profile, builder, leaf size and price of bytes with the least counted work, on the coarsest "
        "lattice that keeps this distance between source and blob");
    for (const Option& option : lattice) max_error.excludes(option);
}

void add_deformation(Verb verb, BakeArguments& arguments) {
    const Option deformable = verb.flag(
        "--deformable", arguments.deformable,
        "Bake a blob whose vertices may move, by refit. Profile fast, and all vertices in the order of their file: "
        "OBJ, OFF, PLY, 3MF and glTF");
    verb.option("--range", arguments.range, "X0 Y0 Z0 X1 Y1 Z1",
                "The box that no vertex of any pose leaves, by two corners, as lengths in the blob's units and "
                "axes. It grows to hold the mesh and --poses. Without it, the box around these, wider by a tenth "
                "of its largest side on each side")
        .expected(6)
        .needs(deformable);
    verb.option("--poses", arguments.poses, "MESH",
                "Poses that the tree suits, each a file with all vertices of the mesh, in the same order. Its "
                "faces do not count; --unit, --scale and --up apply to it as well")
        .needs(deformable);
}

void add_files(Verb verb, BakeArguments& arguments) {
    verb.option(
            "inputs", arguments.inputs, "MESH",
            "Mesh files in the order of their file numbers: glTF 2.0, 3MF, OBJ, OFF, PLY, STL and RAW, which the "
            "command reads itself, and, in a build with assimp, its other formats, such as FBX, Collada and 3DS. Node "
            "transforms are applied; animated meshes are taken in the pose that the file stores")
        .required();
    verb.option("-o,--output", arguments.output, "BLOB", "The blob to write; with --instances, the scene").required();
    const Choices<Instancing> instancing{
        {"off", Instancing::off}, {"auto", Instancing::automatic}, {"all", Instancing::all}};
    verb.choice(
        "--instances", arguments.instancing, instancing,
        "Make a scene, in which a repeated mesh is stored once. auto merges meshes that are not repeated, or too "
        "small to save bytes; all makes every mesh an instance. A tolerance holds in the world, --bits for each "
        "mesh. Without it off: one blob");
    verb.option("--depfile", arguments.depfile, "FILE",
                "Also write which files were read, those that a mesh refers to included, as a rule that Make, "
                "Ninja and CMake understand");
    verb.option("--remap", arguments.remap, "FILE",
                "Also write which triangle of the source each triangle of the blob is: 16 bytes a triangle, "
                "nothing in the blob");
    verb.option("--reorder", arguments.reorder, "MESH",
                "Also write the source as one mesh, .obj or .ply, whose n-th triangle is the blob's triangle n, "
                "corner for corner: a program that draws it needs neither ids nor a remap. Without materials, "
                "groups and what was dropped; in the blob's units and axes; copies of triangles repeat them. PLY "
                "keeps every bit of a coordinate; readers of OBJ may round the last one");
}

/// Returns the options that fix the lattice: one of them may be given.
std::vector<Option> add_lattice(Verb verb, BakeArguments& arguments) {
    const Option tolerance =
        verb.option("--tolerance", arguments.tolerance, "LENGTH",
                    "Largest distance between source and blob: 0.5mm, 2cm, 1e-3m, 1in; a bare number is in units "
                    "of the blob");
    const Option bits =
        verb.option("--bits", arguments.bits, "1..24", "How many bits hold a coordinate along the largest extent")
            .with_default()
            .between(1u, 24u)
            .excludes(tolerance);
    const Option step = verb.option("--step", arguments.step, "2^N",
                                    "Lattice step, a power of two in units of the blob: 2^-14. Blobs with one "
                                    "step share lattice points where their meshes share vertices")
                            .excludes(tolerance)
                            .excludes(bits);
    const Option lattice_of =
        verb.option("--lattice-of", arguments.lattice_of, "BLOB", "Take the lattice step of another blob")
            .excludes(tolerance)
            .excludes(bits)
            .excludes(step);
    return {tolerance, bits, step, lattice_of};
}

void add_tree(Verb verb, BakeArguments& arguments) {
    verb.choice("--profile", arguments.profile, profile_choices,
                "How leaves are stored, and how large they may be. Without it: balanced, or what is picked");
    verb.option("--leaf-size", arguments.leaf_size, text("1..", format::max_leaf_triangles),
                "Most triangles of a leaf; without it, what the profile holds or what is picked")
        .between(1u, unsigned{format::max_leaf_triangles});
    verb.option("--byte-price", arguments.byte_price, "NUMBER",
                "For studies: the price of one byte per triangle, in node visits of an average ray. A higher "
                "price gives a smaller blob and slower rays. Without it 5, or what is picked")
        .between(0.0f, 1e6f);
    verb.choice("--builder", arguments.builder, builder_choices,
                "How the tree is built, before --effort improves it. Without it: binned_sah, or what is picked");
    verb.option("--duplicate-budget", arguments.duplicate_budget, "0..1",
                "With --builder spatial_splits, the largest share of the triangles that is stored again in "
                "further leaves; without it 0.3")
        .between(0.0, 1.0);
}

/// What is stored beside vertices and the tree.
void add_sections(Verb verb, BakeArguments& arguments) {
    verb.flag("--ids", arguments.original_ids, "Store the file, mesh and triangle that each triangle comes from");
    verb.flag("--materials", arguments.materials,
              "Store the material number of each triangle, in 8 bits if all are below 256, else in 16");
    verb.option("--flat-angle", arguments.flat_angle, "DEGREES",
                "Store how the surface bends at each edge, so that contacts can slide over inner edges. Up to this "
                "angle between two triangles, from 0 to below 90, the edge is flat; 5 suits most meshes");
    verb.option("--bounds", arguments.bounds, "NAMES",
                "Store bounds of the whole asset, any of obb,sphere,kdop: an oriented box, a sphere, slabs along 13 "
                "directions")
        .names_of({"obb", "sphere", "kdop"});
}

}  // namespace

void add_bake(Verb verb, BakeArguments& arguments) {
    add_files(verb, arguments);
    add_picking(verb, arguments, add_lattice(verb, arguments));
    add_tree(verb, arguments);
    add_source(verb, arguments.source);
    verb.option("--origin", arguments.origin, "auto|none|X,Y,Z",
                "What is subtracted from all coordinates, in float64, before they are rounded: 0 0 0 of the blob or "
                "scene, which keeps it, and query takes places of the source. auto chooses one near the middle where "
                "float32 rounds places at the mesh by more than a quarter of a step, as on a map far from 0; none "
                "with --deformable")
        .with_default();
    add_sections(verb, arguments);
    verb.flag("--drop-bad-triangles", arguments.drop_bad_triangles,
              "Drop triangles with NaN, infinite or missing corners instead of refusing the mesh");
    add_deformation(verb, arguments);
    verb.option(
            "--max-dropped", arguments.max_dropped, "PERCENT",
            "Most triangles of the source, in percent, that may be dropped for having no area, in the source or "
            "on the lattice, or by --drop-bad-triangles; duplicates and triangles with two corners in one point do not "
            "count. Beyond it nothing is written")
        .with_default()
        .percentage()
        .between(0.0, 100.0);
    verb.option("--expect-size", arguments.expected_size, "LENGTH..LENGTH",
                "Refuse an asset whose largest side is not between these two lengths: 0.1m..10m");
    verb.choice("--effort", arguments.effort, effort_choices,
                "How long to search for a better tree: fast builds it once, normal also moves subtrees to better "
                "places, best moves more of them and takes two to five times as long. Without it: normal");
    add_threads(verb, arguments.threads,
                "How many threads bake, 0 for all of the machine. The bytes do not depend on it");
    add_json_and_quiet(verb, arguments.json, arguments.quiet);
}

}  // namespace espalier::tools
