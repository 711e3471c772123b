#include "pipeline/tiles/tile_numbers.hpp"

#include <span>
#include <utility>

namespace d2b {

TileNumbers::TileNumbers(std::unique_ptr<Spool> spool, std::size_t tiles)
    : spool_(std::move(spool)), waiting_(tiles) {}

GivenNumbers& TileNumbers::of(std::size_t tile) {
    const auto [at, is_new] = at_hand_.try_emplace(tile);
    GivenNumbers& numbers = at->second;
    const Waiting& waiting = waiting_[tile];
    if (is_new && !waiting.written.empty()) {
        numbers.before = waiting.before;
        read(waiting.written.back(), numbers.written);
        read(waiting.buildings, numbers.buildings);
    }
    return numbers;
}

void TileNumbers::put_aside(std::size_t tile) {
    const auto at = at_hand_.find(tile);
    if (at == at_hand_.end())
        return;
    const GivenNumbers& numbers = at->second;
    Waiting& waiting = waiting_[tile];
    // Buildings are contours of the first level.
    if (waiting.written.empty())
        waiting.buildings = append(numbers.buildings, 0);
    waiting.written.push_back(
        append(numbers.written, static_cast<std::size_t>(waiting.contours - numbers.before)));
    waiting.before = waiting.contours;
    waiting.contours = numbers.before + std::ssize(numbers.written);
    at_hand_.erase(at);
}

GivenNumbers TileNumbers::all(std::size_t tile) const {
    GivenNumbers numbers;
    const Waiting& waiting = waiting_[tile];
    for (const SpoolEntry& entry : waiting.written)
        read(entry, numbers.written);
    read(waiting.buildings, numbers.buildings);
    return numbers;
}

SpoolEntry TileNumbers::append(const std::vector<std::int64_t>& numbers, std::size_t from) {
    const auto bytes = std::as_bytes(std::span(numbers).subspan(from));
    return {spool_->append(bytes), bytes.size()};
}

void TileNumbers::read(const SpoolEntry& entry, std::vector<std::int64_t>& numbers) const {
    const std::size_t before = numbers.size();
    numbers.resize(before + static_cast<std::size_t>(entry.size) / sizeof(std::int64_t));
    spool_->read(entry.begin, std::as_writable_bytes(std::span(numbers).subspan(before)));
}

}  // namespace d2b
