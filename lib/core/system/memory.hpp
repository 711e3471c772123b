#pragma once

#include <cstddef>
#include <cstdint>

namespace d2b::system {

/// Maps zeroed memory, in huge pages if the system has them. @param alignment of its address, if blocks can
/// be divided @return null if there is not enough
[[nodiscard]] void* map_memory(std::size_t bytes, std::size_t alignment) noexcept;
/// Unmaps a block, or a part of one if blocks can be divided.
void unmap_memory(void* block, std::size_t bytes) noexcept;

/// True if parts of a block can be unmapped or moved.
[[nodiscard]] bool can_divide_blocks();
/// Moves pages to mapped ones, which they replace. @return false if the system cannot
[[nodiscard]] bool move_memory(void* from, void* to, std::size_t bytes) noexcept;
/// Maps zeroed memory at an address that may be mapped already. @return false if there is not enough
[[nodiscard]] bool map_memory_at(void* address, std::size_t bytes) noexcept;

/// Largest memory of this process so far.
[[nodiscard]] std::int64_t peak_memory_bytes();

}  // namespace d2b::system
