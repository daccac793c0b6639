// Memory that is about to be filled from one end to the other.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>

namespace proveta::input {

/// Asks for pages of 2 MiB where memory that was reserved has not been touched yet. Filling a table of some ten megabytes by pages of 4 KiB
/// can take longer than reading its numbers. A wish: where the system does not grant it, nothing changes.
template <class Container> void wish_large_pages(Container& reserved) {
    constexpr std::size_t page = 4096;
    constexpr std::size_t large = std::size_t{2} << 20;
    void* begin = reserved.data();
    std::size_t room = reserved.capacity() * sizeof(*reserved.data());
    if (std::align(page, large, begin, room) != nullptr) {
        (void)madvise(begin, room, MADV_HUGEPAGE);
    }
}

} // namespace proveta::input
