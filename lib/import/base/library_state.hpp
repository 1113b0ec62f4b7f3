// Libraries that are not ours have state that all threads of a process share, such as assimp's log.
#pragma once

#include <mutex>

namespace espalier::importer {

/// Held while such a library works, and while a process is copied, whose copy could not unlock it.
inline std::mutex& library_state() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace espalier::importer
