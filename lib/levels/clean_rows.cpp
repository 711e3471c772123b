#include "levels/clean_rows.hpp"

#include <bit>
#include <cstddef>
#include <utility>

namespace d2b {
namespace {

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

CleanRows::CleanRows(std::unique_ptr<Spool> spool, std::int32_t first_row, std::int32_t rows)
    : spool_(std::move(spool)), slabs_(first_row, rows) {}

void CleanRows::add(const BuildingCells& cells) {
    std::size_t cell = 0;
    for (std::size_t i = 0; i < cells.runs.size();) {
        const std::size_t slab = slabs_.index(cells.runs[i].row);
        ByteWriter writer;
        for (; i < cells.runs.size() && slabs_.index(cells.runs[i].row) == slab; ++i) {
            const BuildingCells::Run& run = cells.runs[i];
            for (std::int32_t begin = run.begin; begin < run.end;) {
                const double elevation = cells.elevations[cell];
                std::int32_t end = begin;
                for (; end < run.end && same(cells.elevations[cell], elevation); ++end)
                    ++cell;
                writer.put(Run{run.row, begin, end, 0, elevation});
                begin = end;
            }
        }
        const SpoolEntry entry = append(*spool_, writer);
        const std::lock_guard lock(*mutex_);
        slabs_[slab].push_back(entry);
    }
}

}  // namespace d2b
