#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/band.hpp"
#include "pipeline/tiles/found_tile.hpp"

namespace d2b::test {

/// File that is read between two steps of a run in tiles; the first byte of a seed.
enum class TileFile : std::uint8_t { found, joined, drawn, numbered, numbered_whole, contour };
constexpr std::uint8_t tile_files = 6;

/// The window of the plan, which has three units, and of the one that a file speaks of.
constexpr Window tile_window{10, 20, 8, 9};
[[nodiscard]] tiles::FoundFacts empty_facts();

/// Reads a file, but for the numbers that it begins with where any number will do. Ends the program where
/// it speaks of something that is not there. @param file its kind, then its bytes
/// @return how many of them are left @throws CorruptRecord
std::size_t read_tile_file(std::span<const std::byte> file);

}  // namespace d2b::test
