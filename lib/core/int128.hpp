#pragma once

namespace d2b {

// Not standard C++, but both compilers of the project have it. `using` does not accept __extension__.
// NOLINTBEGIN(modernize-use-using)
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;
// NOLINTEND(modernize-use-using)

}  // namespace d2b
