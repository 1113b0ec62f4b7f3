// Mesh files, mostly damaged, through the command's own reader and then the baker: refused with a reason, or baked to a
// blob that opens and passes the deep check. The first byte says which format the rest is called, the second how it is
// baked. Each input is read in a process of its own, as crashes of assimp are none of ours.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <string_view>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>
#include <espalier/import.hpp>

#include "importer_crash.hpp"
#include "judge.hpp"
#include "shared_coverage.hpp"
#include "target.hpp"
#include "zip_of_one.hpp"

using namespace espalier;

namespace {

constexpr std::array formats = {"obj", "ply", "stl", "off", "gltf", "glb", "dae", "fbx"};
/// From this first byte on it is 3MF: at even ones the package, at odd ones the model, which is packed here.
constexpr std::uint8_t first_of_3mf = 240;
constexpr unsigned seconds = 20;

BakeOptions options_from(std::uint8_t choices) {
    BakeOptions options;
    options.drop_bad_triangles = (choices & 1) != 0;
    options.profile = static_cast<Profile>((choices >> 1 & 3u) % 3u);
    options.original_ids = (choices & 8) != 0;
    options.resolution = Resolution::bits((choices & 16) != 0 ? 24 : 8);
    options.effort = (choices & 32) != 0 ? Effort::best : Effort::fast;
    if ((choices & 128) != 0) {
        options.flat_angle = 5.0;
        options.bounds = {true, true, true};
    }
    return options;
}

void read_and_bake(const std::string& path, const BakeOptions& options) {
    try {
        const ImportResult imported = import_meshes(std::span(&path, 1));
        if (!imported) {
            if (imported.reason.message.empty()) fuzz::fail("refused", "without a reason");
            // The file is there, but a glTF file may name another one that is not.
            if (imported.status != ImportStatus::invalid_input && imported.status != ImportStatus::unsupported &&
                imported.status != ImportStatus::file_access)
                fuzz::fail("status", imported.reason.message);
            return;
        }
        const auto views = imported.views();
        const auto baked = bake(views, options);
        if (!baked) {
            if (baked.status == BakeStatus::internal) fuzz::fail("internal error", baked.message);
            if (baked.message.empty()) fuzz::fail("refused", "without a reason");
            return;
        }
        const Blob blob = open(baked.bytes);
        if (!blob) fuzz::fail("open", describe(blob.status()));
        if (const auto report = verify(baked.bytes); !report) fuzz::fail("verify", report.message);
    } catch (const std::bad_alloc&) {
        return;  // the command says that memory ran out
    } catch (const std::exception& error) {
        fuzz::fail("exception", error.what());
    }
}

/// 0, or what the process of this input died of.
int run_apart(const std::string& path, const BakeOptions& options) {
    static const fuzz::SharedCoverage coverage;
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) {
        std::perror("fork");
        std::exit(1);
    }
    if (child == 0) {
        fuzz::expect_importer_crashes(seconds);
        read_and_bake(path, options);
        coverage.hand_over();
        ::_exit(static_cast<int>(fuzz::ImportEnd::done));
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
    }
    coverage.take();
    return status;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2 || size > 65536) return 0;
    const bool is_3mf = data[0] >= first_of_3mf;
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("espalier_fuzz_import_" + std::to_string(getpid()) + "." +
                                                  (is_3mf ? "3mf" : formats[data[0] % formats.size()]));
    const std::string_view content(reinterpret_cast<const char*>(data) + 2, size - 2);
    std::ofstream(path, std::ios::binary)
        << (is_3mf && data[0] % 2 != 0 ? fuzz::zip_of_one("3D/3dmodel.model", content) : std::string(content));
    const int status = run_apart(path.string(), options_from(data[1]));
    std::filesystem::remove(path);
    using fuzz::ImportEnd;
    for (const ImportEnd end : {ImportEnd::done, ImportEnd::crashed, ImportEnd::too_slow})
        if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(end)) return 0;
    fuzz::fail("the process that read the file", WIFSIGNALED(status)
                                                     ? "died of signal " + std::to_string(WTERMSIG(status))
                                                     : "ended with status " + std::to_string(WEXITSTATUS(status)));
}
