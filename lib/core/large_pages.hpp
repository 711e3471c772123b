#pragma once

#include <cstddef>

#include "core/executor.hpp"

namespace d2b {

/// Asks the system to give memory in large pages where it can: 100 MB are then touched in 50 steps instead of
/// 25,000, which otherwise take longer than most passes over them. Does nothing for small blocks.
void prefer_large_pages(void* memory, std::size_t bytes);

/// Has the system give the memory at once, on all threads: whoever touches it first then need not wait for
/// page after page. Does nothing where the system cannot, nor for small blocks.
void get_pages(void* memory, std::size_t bytes, Executor& threads);

}  // namespace d2b
