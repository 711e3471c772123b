#pragma once

namespace d2b {

// Both compilers of the project have it; the standard does not. `using` takes no __extension__.
// NOLINTBEGIN(modernize-use-using)
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;
// NOLINTEND(modernize-use-using)

}  // namespace d2b
