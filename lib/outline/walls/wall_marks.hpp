#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/wall_drawing.hpp"

namespace d2b {

/// Set of visited walls that is cleared in O(1), by counting epochs.
class WallMarks {
  public:
    explicit WallMarks(std::size_t chains) : marks_(chains) {}

    void wipe() { ++now_; }
    [[nodiscard]] bool marked(WallDrawing::Wall wall) const {
        const auto& of_chain = marks_[wall.chain];
        return wall.piece < of_chain.size() && of_chain[wall.piece] == now_;
    }
    /// @return false if it was marked already
    bool mark(WallDrawing::Wall wall) {
        if (marked(wall))
            return false;
        auto& of_chain = marks_[wall.chain];
        if (wall.piece >= of_chain.size())
            of_chain.resize(wall.piece + 1, 0);
        of_chain[wall.piece] = now_;
        return true;
    }

  private:
    std::vector<std::vector<std::uint32_t>> marks_;
    std::uint32_t now_ = 1;
};

}  // namespace d2b
