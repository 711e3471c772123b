#pragma once

namespace d2b {

/// Raises the library's errors in Python as those of the same names in dem2buildings._errors from now on.
void translate_errors();

}  // namespace d2b
