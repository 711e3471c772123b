#pragma once

#include <memory>
#include <optional>

#include "outline/walls/chain_drawing.hpp"
#include "outline/walls/chain_form.hpp"
#include "outline/walls/course.hpp"
#include "outline/walls/draw_walls.hpp"

namespace d2b {

/// What has become of a chain in the drawing of its graph.
struct ChainState {
    ChainForm form;
    bool waiting = true;  ///< to be drawn for its own sake
    bool lands = false;   ///< where it ends may have moved
    double direction = 0;
    std::optional<ChainEnds> ends;        ///< of an open chain
    std::unique_ptr<ChainDrawing> chain;  ///< once it has been drawn
    Course course;
};

}  // namespace d2b
