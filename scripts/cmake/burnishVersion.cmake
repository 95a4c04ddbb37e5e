# Writes cli/version.h anew where the version or the state of the checkout has changed: run at every build, with -P.
#   SOURCE, BINARY: folders · VERSION, COMPILER: text
execute_process(COMMAND git describe --always --dirty --tags WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE BURNISH_GIT_DESCRIBE
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT BURNISH_GIT_DESCRIBE)
  set(BURNISH_GIT_DESCRIBE "no git")
endif()
configure_file(${SOURCE}/tools/cli/version.h.in ${BINARY}/cli/version.h @ONLY)
