# cpack reads this when all files of the packages are there, before it packs them: adds files that Debian asks of each package,
# a copyright file and a changelog, and compresses its man pages.
if(NOT CPACK_GENERATOR STREQUAL DEB)
  return()
endif()
find_program(gzip gzip REQUIRED)

# debian_text(name to): a text of the folder debian with its values
function(debian_text name to)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/debian/${name} ${to} @ONLY)
endfunction()

file(READ ${CPACK_RESOURCE_FILE_LICENSE} expat)
# Only the terms: whose the copyright is stands with the files. Empty lines are points, all others are indented.
string(REGEX REPLACE "^.*(Permission is hereby granted)" "\\1" expat "${expat}")
string(STRIP "${expat}" expat)
string(REGEX REPLACE "\n\n" "\n.\n" expat "${expat}")
string(REPLACE "\n" "\n " expat " ${expat}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  set(documents ${root}/share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  if(component STREQUAL mesh)
    debian_text(copyright_mesh ${documents}/copyright)
  else()
    debian_text(copyright ${documents}/copyright)
  endif()
  debian_text(changelog ${documents}/changelog.Debian)
  file(GLOB pages ${root}/share/man/*/*.[1-9])
  execute_process(COMMAND ${gzip} -9 -n -f ${documents}/changelog.Debian ${pages} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
