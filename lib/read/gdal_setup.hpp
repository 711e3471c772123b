#pragma once

#include <optional>
#include <string>
#include <vector>

namespace d2b::reading {

/// Registers GDAL's drivers unless the process has registered any. Called by all functions that open files.
void register_formats();

/// Registers GDAL's drivers and configures the process for the programs: GDAL prints nothing to stderr by
/// itself. Call once, before other threads start.
void start_gdal();

/// Executes and removes the switches common to all GDAL programs: --config, --debug, --optfile, --formats,
/// --format, --help-general, --build, --license, --locale, --pause. `--config` accepts both `KEY VALUE` and
/// `KEY=VALUE`, which GDAL itself does only from 3.9 on. `--version` and everything from `--` on are kept
/// because they belong to the program. Call it in programs only, before start_gdal(), so that configuration
/// options affect the registration of drivers.
/// @param arguments without the name of the program
/// @return remaining arguments; nothing if a switch has printed its answer to stdout and the program is done
/// @throws OptionError with GDAL's reason
[[nodiscard]] std::optional<std::vector<std::string>> apply_gdal_switches(std::vector<std::string> arguments);

/// Version of the GDAL library in use: "3.6.2".
[[nodiscard]] std::string gdal_version();

}  // namespace d2b::reading
