#pragma once

#include <optional>
#include <string>
#include <vector>

namespace d2b {

/// Takes the switches that all programs of GDAL have out of a command line and does what they say: --config,
/// --debug, --optfile, --formats, --format, --help-general, --build, --license, --locale, --pause. `--config`
/// is understood as both `KEY VALUE` and `KEY=VALUE`, which GDAL itself does from 3.9 on only. Everything
/// from `--` on and `--version` stay: they are the program's own. For the tools alone, before start_gdal(),
/// so that configuration options for GDAL's start are heard.
/// @param arguments without the program's name
/// @return what is left; nothing where a switch has printed to stdout what was asked for and all is done
/// @throws OptionError with GDAL's reason
[[nodiscard]] std::optional<std::vector<std::string>> apply_gdal_switches(std::vector<std::string> arguments);

/// Of the library in use: "3.6.2".
[[nodiscard]] std::string gdal_version();

}  // namespace d2b
