# How every target of the project is compiled. Nothing global: a project that embeds this one keeps its own flags.
add_library(d2b_compile INTERFACE)
target_compile_features(d2b_compile INTERFACE cxx_std_20)
target_include_directories(d2b_compile INTERFACE ${PROJECT_SOURCE_DIR}/lib ${PROJECT_SOURCE_DIR}/lib/include
                           ${PROJECT_BINARY_DIR}/lib)
target_compile_options(d2b_compile INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wdouble-promotion -Wformat=2
  # A fused multiply-add would make coordinates depend on the processor.
  -ffp-contract=off
  # Nobody asks for errno or traps after arithmetic: without them square roots are one instruction, and conditions on
  # floats need no branch. No result changes by a bit.
  -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Else a shared library could replace any function, so that none could be inlined in position-independent code.
  target_compile_options(d2b_compile INTERFACE -fno-semantic-interposition)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlaps in std::string's own operator+ (GCC bug 105651).
  target_compile_options(d2b_compile INTERFACE -Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 15)
  # std::stable_sort of GCC 12's library calls a function that the library itself deprecates.
  target_compile_options(d2b_compile INTERFACE -Wno-deprecated-declarations)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 16
   AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 20)
  # Boost 1.74 has constants beyond the range of their enumeration, which these take for an error, also in system headers.
  target_compile_options(d2b_compile INTERFACE -Wno-enum-constexpr-conversion)
endif()
if(D2B_WARNINGS_AS_ERRORS)
  target_compile_options(d2b_compile INTERFACE -Werror)
endif()
if(D2B_HARDENING)
  target_compile_options(d2b_compile INTERFACE -fstack-protector-strong -fstack-clash-protection
                         $<$<CONFIG:Release,RelWithDebInfo>:-D_FORTIFY_SOURCE=2>)
  target_link_options(d2b_compile INTERFACE LINKER:-z,relro LINKER:-z,now)
endif()
if(D2B_SANITIZE)
  target_compile_options(d2b_compile INTERFACE -fsanitize=${D2B_SANITIZE} -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(d2b_compile INTERFACE -fsanitize=${D2B_SANITIZE})
endif()
if(D2B_FUZZ)
  target_compile_options(d2b_compile INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(D2B_CLANG_TIDY)
  find_program(D2B_CLANG_TIDY_PROGRAM NAMES clang-tidy clang-tidy-14 REQUIRED)
endif()

# d2b_module(name [LINK libraries...]): the objects of one folder of lib/.
function(d2b_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_library(d2b_${name} OBJECT ${arg_SOURCES})
  target_link_libraries(d2b_${name} PRIVATE d2b_compile ${arg_LINK})
  set_target_properties(d2b_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  if(D2B_CLANG_TIDY)
    set_target_properties(d2b_${name} PROPERTIES CXX_CLANG_TIDY "${D2B_CLANG_TIDY_PROGRAM};--quiet")
  endif()
  set_property(GLOBAL APPEND PROPERTY D2B_MODULES d2b_${name})
endfunction()
