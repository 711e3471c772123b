#pragma once

namespace d2b {

/// From now on the library's errors are raised in Python as those of the same names in dem2buildings._errors.
void translate_errors();

}  // namespace d2b
