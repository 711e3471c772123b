#pragma once

#include <memory>
#include <optional>

#include "outline/walls/chain_drawing.hpp"
#include "outline/walls/chain_form.hpp"
#include "outline/walls/course.hpp"
#include "outline/walls/draw_walls.hpp"

namespace d2b {

/// State of a chain while its graph is being drawn.
struct ChainState {
    ChainForm form;
    bool waiting = true;  ///< has yet to be drawn for its own sake
    bool lands = false;   ///< its end nodes may have moved
    double direction = 0;
    std::optional<ChainEnds> ends;        ///< open chains only
    std::unique_ptr<ChainDrawing> chain;  ///< set once it has been drawn
    Course course;
};

}  // namespace d2b
