// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/tool_texts.hpp"
#include "dem2buildings_mesh/mesh_request.hpp"

namespace d2b::mesh {

/// All that the command line can set.
struct MeshCommand : MeshRequest, TextSwitches {
    bool json = false;
    bool quiet = false;
    bool bash_completion = false;
};

/// One option. Parser, help, man page and completion are all made from these rows.
struct MeshOption : ToolOption {
    std::function<void(MeshCommand&, const std::string&)> apply;  ///< @throws OptionError
};

/// Options in the order in which help lists them.
[[nodiscard]] const std::vector<MeshOption>& mesh_options();

/// Reads a command line; opens no file. Where a text is asked for, file names are not looked at.
/// @param arguments without the program's name and without GDAL's own switches @throws OptionError
[[nodiscard]] MeshCommand parse_mesh_command_line(const std::vector<std::string>& arguments);

}  // namespace d2b::mesh
