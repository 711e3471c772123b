# cpack reads this before it makes a package: without dpkg-shlibdeps it would make one that depends on nothing, installs,
# and does not start.
if(CPACK_GENERATOR STREQUAL DEB)
  find_program(dpkg_shlibdeps dpkg-shlibdeps)
  if(NOT dpkg_shlibdeps)
    message(FATAL_ERROR "dpkg-shlibdeps finds the libraries that a Debian package depends on, and is not there; "
                        "install dpkg-dev.")
  endif()
endif()
