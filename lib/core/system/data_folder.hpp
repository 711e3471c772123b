#pragma once

#include <filesystem>

namespace d2b::system {

/// Finds the folder `data` of a program that brings the files of its own GDAL and PROJ, in `gdal` and `proj`:
/// beside a module of Python, or one folder above a program, which lies in `bin`.
/// @param object the program or module @return "" if there is none
[[nodiscard]] std::filesystem::path data_folder_of(const std::filesystem::path& object);

}  // namespace d2b::system
