// Runs the workload of scenes between marks, as measure_main.cpp does that of blobs.
#include <espalier/scene.hpp>

#include "../../platform/report.hpp"
#include "../scene_workload.hpp"
#include "../workload.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

int main() {
    using namespace espalier;
    Blob meshes[4];  // on the stack: what lies elsewhere is not written
    const BakedScene scene = open_scene(firmware::blob_in_image(), meshes);
    if (!scene) {
        board::print(describe(scene.status()));
        return 2;
    }
    const auto measure = [](unsigned kind, FunctionRef<void()> call) { firmware::measure(kind, call); };
    firmware::SceneWorkload workload(firmware::blob_in_image(), std::span(meshes), scene, measure);
    workload.ask(firmware::Counts{}.usual);
    board::print(firmware::workload_line(workload.answers()).c_str());
    return 0;
}
