// Files that are either whole or absent.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace proveta {

/// A file or a folder cannot be written or read, for a reason of the machine's: a full disk, missing rights, a folder that is gone.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Writes bytes to a file so that neither a reader nor a power cut ever meets half of it: to a file beside it, down to the disk, then under
/// its name. Throws FileError with the system's reason; nothing is left then but what was there before.
void write_whole(const std::string& file, const void* data, std::size_t size);

/// Throws FileError, with the system's reason, where `write_whole` could not write a file: before what it is to hold has been worked out.
void require_writable(const std::string& file);

/// Gives a file, which is whole and on the disk, its name, and has the folder remember it. Throws FileError with the system's
/// reason; what was to be moved is gone then.
void move_into_place(const std::string& from, const std::string& file);

/// Makes a folder in one that is there, unless it is there itself: a result that has been moved away is not begun again by what belongs
/// into it. Throws FileError with the system's reason.
void make_folder(const std::string& folder);

} // namespace proveta
