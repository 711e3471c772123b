# Configures the project with nothing but defaults and with D2B_WARNINGS_AS_ERRORS, and looks for -Werror in the commands.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${work})

function(expect_errors expected)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${work} -G ${generator} ${ARGN}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${work}/compile_commands.json commands)
  if(commands MATCHES "-Werror")
    set(found TRUE)
  else()
    set(found FALSE)
  endif()
  if(NOT found STREQUAL expected)
    message(FATAL_ERROR "-Werror among the flags: ${found} instead of ${expected} with '${ARGN}'")
  endif()
endfunction()
expect_errors(FALSE)
expect_errors(TRUE -D D2B_WARNINGS_AS_ERRORS=ON)
