// What each verb of the command takes. main.cpp and command_line/ fill these in; commands/ carries the verbs out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/ray.hpp>

#include <import/base/placement.hpp>

#include "exit_code.hpp"

namespace espalier::tools {

/// How the numbers in mesh files are understood. The same for bake and for verify --source.
struct SourceArguments {
    double scale = 1.0;
    std::string unit;    ///< empty: the one that the file states, else metres
    std::string format;  ///< a name or an ending; empty: content and name of each file decide
    std::optional<Axis> up;
    bool strict = false;            ///< warnings are errors
    bool allow_empty = false;       ///< files without triangles are none
    std::string import_memory;      ///< an amount of bytes, or none; empty: half of the machine's memory
    double import_seconds = 600.0;  ///< of processor time, for one file
    bool verbose = false;           ///< print what importers report
};

/// Which meshes of a bake become instances.
enum class Instancing : std::uint8_t {
    off,        ///< none: one blob
    automatic,  ///< those that are repeated and take fewer bytes so
    all,
};

struct BakeArguments {
    std::vector<std::string> inputs;
    std::string output;
    std::string depfile;  ///< empty: none
    std::string remap;    ///< empty: none
    std::string reorder;  ///< a mesh file; empty: none
    Instancing instancing = Instancing::off;
    SourceArguments source;
    std::string tolerance;   ///< a length; empty: bits or a step decide
    std::string step;        ///< a power of two; empty: none
    std::string lattice_of;  ///< a blob whose step is taken; empty: none
    unsigned bits = 16;
    std::string origin = "auto";               ///< or none, or three lengths with commas between
    std::optional<std::string> max_bytes;      ///< an amount of bytes
    std::optional<std::string> max_error;      ///< a length; without it --tolerance, --bits or a step decides
    std::optional<std::string> fastest_under;  ///< an amount of bytes
    std::optional<Profile> profile;            ///< without one: the library's, or the picked one
    std::optional<unsigned> leaf_size;         ///< without one: the library's, or the picked one
    std::optional<float> byte_price;           ///< without one: the library's
    std::optional<double> duplicate_budget;    ///< without one: the library's
    std::optional<Builder> builder;            ///< without one: the library's, or the picked one
    bool original_ids = false;
    bool materials = false;
    std::optional<double> flat_angle;  ///< degrees; without one no edge flags are stored
    std::vector<std::string> bounds;   ///< of obb, sphere, kdop
    bool drop_bad_triangles = false;
    bool deformable = false;
    std::vector<std::string> range;  ///< six lengths, the low corner and the high one; empty: around the meshes
    std::vector<std::string> poses;  ///< mesh files
    double max_dropped = 10.0;       ///< percent
    std::string expected_size;       ///< two lengths with ".." between; empty: any
    Effort effort = Effort::normal;
    unsigned threads = 0;
    bool json = false;
    bool quiet = false;
};

struct RefitArguments {
    std::string blob;
    std::string pose;  ///< a mesh file
    std::string output;
    SourceArguments source;
    bool json = false;
    bool quiet = false;
};

struct EmbedArguments {
    std::string blob;  ///< or a scene, as in all verbs below
    std::string output;
    std::string header;   ///< empty: none
    std::string symbol;   ///< empty: named after the output
    std::string section;  ///< empty: one of its own in .rodata
    unsigned alignment = 16;
    bool json = false;
    bool quiet = false;
};

/// Lists stay text here; commands/trade.cpp reads them.
struct TradeArguments {
    std::vector<std::string> inputs;
    std::string output;  ///< the picture; empty: none
    std::string csv;     ///< empty: to stdout
    SourceArguments source;
    std::string bits = "12,14,16,20";
    std::string leaf_sizes = "16,32,54";
    std::string byte_prices = "1,5";
    std::string profiles = "all";
    std::string builders = "binned_sah";
    unsigned rays = 20'000;
    unsigned repetitions = 5;
    Effort effort = Effort::normal;
    unsigned threads = 0;
    bool drop_bad_triangles = false;
    bool json = false;
    bool quiet = false;
};

struct InfoArguments {
    std::string blob;
    bool histogram = false;
    bool json = false;
};

struct VerifyArguments {
    std::string blob;
    bool deep = false;
    std::vector<std::string> sources;
    SourceArguments source;
    bool json = false;
};

/// Numbers and lengths stay text here, so that inf and nan arrive as the floats they name. Which of these an `espalier
/// query` takes depends on its kind (query/kinds.hpp).
struct QueryArguments {
    std::string blob;
    std::vector<std::string> words;  ///< the arguments after the kind
    std::string mask;                ///< 32 bits, for scenes; empty: all
    std::string t_min = "0";
    std::string t_max = "inf";
    FaceCulling culling = FaceCulling::none;
    bool any = false;
    bool all = false;
    bool crossings = false;
    bool few = false;
    bool ignore_leaving = false;
    std::string skin = "0";
    std::optional<std::uint32_t> first;
    std::string accuracy;  ///< empty: exact
    std::optional<std::uint32_t> limit;
    std::uint32_t from = 0;
    std::string max_distance = "inf";
    std::vector<std::string> rotation{"0", "0", "0", "1"};
    std::vector<std::string> translation{"0", "0", "0"};
    std::string scale = "1";
    std::uint64_t work_limit = ~std::uint64_t{0};
    unsigned depth = ~0u;
    bool json = false;
};

struct RenderArguments {
    std::string blob;
    std::string output;
    std::string size = "1280x720";
    bool heatmap = false;
    Axis up = Axis::y;
    double azimuth = 35.0;    ///< degrees around the up axis
    double elevation = 25.0;  ///< degrees above the horizon
    unsigned samples = 2;     ///< along each side of a pixel
    unsigned threads = 0;
    bool json = false;
    bool quiet = false;
};

struct DumpArguments {
    std::string blob;
    std::size_t limit = 0;  ///< lines; 0: all
    bool json = false;
};

}  // namespace espalier::tools
