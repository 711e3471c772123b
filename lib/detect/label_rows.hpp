#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/spool.hpp"

namespace d2b {

/// The labels of a window, row by row, as runs that wait in a spool: 12 bytes a run.
class LabelRows {
  public:
    LabelRows() = default;
    explicit LabelRows(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// The next row.
    void append(std::span<const Label> labels);
    /// Gives other labels to all rows. @param number the new label, by the old one
    void renumber(std::vector<Label> number) { number_ = std::move(number); }
    /// From any thread, once all rows are there. @param row first, counted from the window's
    /// @param labels of whole rows @throws OutputError the spool cannot be read
    void read(std::int32_t row, std::int32_t cols, std::span<Label> labels) const;

  private:
    struct Run {
        std::int32_t begin;
        std::int32_t end;
        Label label;
    };
    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> rows_;
    std::vector<Label> number_;
};

}  // namespace d2b
