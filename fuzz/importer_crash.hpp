// Crashes of assimp and Draco, which are not ours, and crashes of ours: told apart by whose code is on the stack.
#pragma once

namespace espalier::fuzz {

/// How a process ends that read one file.
enum class ImportEnd : int {
    done = 0,       ///< refused with a reason, or baked and sound
    crashed = 100,  ///< inside assimp or Draco: the command's guard makes a message and an exit status of that
    too_slow = 101  ///< inside assimp or Draco
};

/// From now on this process ends by itself when assimp or Draco crashes or is still at work after so many seconds.
/// What goes wrong outside of them ends it as if nobody watched.
void expect_importer_crashes(unsigned seconds);

}  // namespace espalier::fuzz
