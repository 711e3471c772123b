#include "core/system/memory.hpp"

#include "core/system/windows/windows_api.hpp"

namespace d2b::system {

void* map_memory(std::size_t bytes, std::size_t /*alignment*/) noexcept {
    return VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
}

void unmap_memory(void* block, std::size_t /*bytes*/) noexcept {
    VirtualFree(block, 0, MEM_RELEASE);
}

bool can_divide_blocks() {
    return false;
}

bool move_memory(void* /*from*/, void* /*to*/, std::size_t /*bytes*/) noexcept {
    return false;
}

bool map_memory_at(void* /*address*/, std::size_t /*bytes*/) noexcept {
    return false;
}

std::int64_t peak_memory_bytes() {
    PROCESS_MEMORY_COUNTERS usage{};
    K32GetProcessMemoryInfo(GetCurrentProcess(), &usage, sizeof(usage));
    return static_cast<std::int64_t>(usage.PeakWorkingSetSize);
}

}  // namespace d2b::system
