# Grids of a city do not fit into the addresses of 32 bits, and sums on them need 128 bits.
if(CMAKE_SIZEOF_VOID_P LESS 8)
  message(FATAL_ERROR "dem2buildings needs a 64-bit system; choose a compiler for one, such as x86_64 or aarch64.")
endif()
