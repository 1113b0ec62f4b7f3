// Which of the systems or builders that a program has a command line asks for.
#pragma once

#include "base.hpp"

namespace espalier::bench {

/// Removes the systems that no word names: `is_named(system, word)`. Those that `is_kept` stay, and all without words.
/// Throws std::invalid_argument for a word that names none, with the names that there are.
template <class System, class IsNamed, class IsKept, class NameOf>
void select(std::vector<System>& systems, const std::vector<std::string>& words, const IsNamed& is_named,
            const IsKept& is_kept, const NameOf& name_of) {
    for (const std::string& word : words) {
        if (std::ranges::any_of(systems, [&](const System& system) { return is_named(system, word); })) continue;
        std::string message = "there is no '" + word + "' in this build; there are:";
        for (const System& system : systems) message += "\n  " + name_of(system);
        throw std::invalid_argument(message);
    }
    if (words.empty()) return;
    std::erase_if(systems, [&](const System& system) {
        return !is_kept(system) &&
               std::ranges::none_of(words, [&](const std::string& word) { return is_named(system, word); });
    });
}

}  // namespace espalier::bench
