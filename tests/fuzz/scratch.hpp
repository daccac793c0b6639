// What the targets share: a file for readers that take names, and the way they may refuse it.
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace proveta::fuzz {

/// Writes the bytes to a file of that name and returns its whole name. The file is in a folder of this process, in memory where the machine
/// has a file system there, that goes when the process ends; one of the same name is replaced.
std::string scratch_file(const std::string& name, std::string_view bytes);

/// Calls `read` and lets it refuse by a std::runtime_error (InputError is one) that says why.
template <class Read> void may_refuse(const Read& read) {
    try {
        read();
    } catch (const std::runtime_error& refusal) {
        if (std::string_view(refusal.what()).empty()) {
            std::abort();
        }
    }
}

} // namespace proveta::fuzz
