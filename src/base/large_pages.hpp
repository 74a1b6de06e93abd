// Memory of long arrays of which every step reads a little everywhere.
#pragma once

#include <cstdint>

#include "base/types.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace nsframe {

inline constexpr Eigen::Index large_page_doubles = 1 << 19;  // 4 MB: small pages then outnumber what a core holds of their addresses

// A copy, of arrays of at least that length on pages of 2 MB, where the system has them (Linux).
inline VectorX on_large_pages(const VectorX& array) {
  VectorX copy(array.size());  // not touched yet: a page is as large as it was advised when it is first written
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (array.size() >= large_page_doubles) {
    constexpr std::uintptr_t page = 1 << 21;
    const auto start = reinterpret_cast<std::uintptr_t>(copy.data());
    const std::uintptr_t begin = (start + page - 1) / page * page;
    const std::uintptr_t end = (start + static_cast<std::uintptr_t>(array.size()) * sizeof(double)) / page * page;
    // only advice: where the system declines, pages are small
    static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
  }
#endif
  copy = array;
  return copy;
}

}  // namespace nsframe
