#pragma once

#include "common/own_stdout.hpp"
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings_tiles/command_line.hpp"

namespace d2b {

/// Does the work that the command line asks for. Texts are printed to stdout. @throws Error
void run_step(const TileCommand& command, OwnStdout& own_stdout, const Callbacks& callbacks);

}  // namespace d2b
