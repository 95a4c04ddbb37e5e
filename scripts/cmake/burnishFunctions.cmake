# Rules for assets: what each adds is run again when something that the tool read has changed, whatever named it: a list of
# lights, a material library, a scene. Relative inputs are those of the source directory, relative outputs of the build directory.
#
#   burnish_command(<tool> OUTPUT <file>... [DEPENDS <file>...] [WORKING_DIRECTORY <dir>] ARGUMENTS <argument>...)
#
# Runs burnish-<tool>. The arguments stand as they are, and say where the output goes.
#
#   burnish_normal_map(<height> OUTPUT <file> [OPTIONS <option>...])
#   burnish_quantize(<map>... OUTPUT <file> [OPTIONS <option>...])
#   burnish_quantize(<map>... OUTPUT_DIRECTORY <dir> [EXTENSION <exr|png|ktx2|dds>] [OPTIONS <option>...])
#   burnish_mipmap(<map> OUTPUT <file> [OPTIONS <option>...])
#
# The options are those of the tool's --help. Maps that are quantized into a directory share a palette.
#
#   burnish_texture_directory(<target> DIRECTORY <dir> OUTPUT_DIRECTORY <dir> [PATTERNS <glob>...] [EXTENSION <ext>]
#     [NORMALS <option>...] [QUANTIZE <option>...] [MIPMAP <option>...])
#
# Every displacement map of a directory that fits a pattern (default *.png *.tif *.exr): its normals, those in a palette of its own,
# and a chain of mip levels, <stem>.<ext> (default ktx2). Files that come and go are noticed at the next build. The target is
# built by default; each tool runs on one thread, since many run at once.

function(_burnish_absolute variable base)
  set(absolute "")
  foreach(path IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH path BASE_DIRECTORY "${base}" NORMALIZE)
    list(APPEND absolute "${path}")
  endforeach()
  set(${variable} "${absolute}" PARENT_SCOPE)
endfunction()

# What the caller must give, and no more.
macro(_burnish_require)
  if(DEFINED _UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${CMAKE_CURRENT_FUNCTION}: unexpected arguments: ${_UNPARSED_ARGUMENTS}")
  endif()
  foreach(keyword ${ARGN})
    if(NOT DEFINED _${keyword})
      message(FATAL_ERROR "${CMAKE_CURRENT_FUNCTION}: ${keyword} is required")
    endif()
  endforeach()
endmacro()

function(burnish_command tool)
  cmake_parse_arguments(PARSE_ARGV 1 "" "" "WORKING_DIRECTORY" "OUTPUT;DEPENDS;ARGUMENTS")
  _burnish_require(OUTPUT ARGUMENTS)
  if(NOT TARGET burnish::${tool})
    message(FATAL_ERROR "burnish_command: there is no tool '${tool}'")
  endif()
  _burnish_absolute(outputs "${CMAKE_CURRENT_BINARY_DIR}" ${_OUTPUT})
  _burnish_absolute(inputs "${CMAKE_CURRENT_SOURCE_DIR}" ${_DEPENDS})
  if(NOT DEFINED _WORKING_DIRECTORY)
    set(_WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  list(GET outputs 0 first)
  cmake_path(GET first PARENT_PATH directory)
  cmake_path(RELATIVE_PATH first BASE_DIRECTORY "${CMAKE_BINARY_DIR}" OUTPUT_VARIABLE shown)
  file(MAKE_DIRECTORY "${directory}")
  add_custom_command(OUTPUT ${outputs} COMMAND burnish::${tool} ${_ARGUMENTS} --quiet --depfile "${first}.d"
    DEPENDS ${inputs} burnish::${tool} DEPFILE "${first}.d" WORKING_DIRECTORY "${_WORKING_DIRECTORY}"
    COMMENT "burnish-${tool} ${shown}" VERBATIM COMMAND_EXPAND_LISTS)
endfunction()

# One input, one output.
function(_burnish_map tool input)
  cmake_parse_arguments(PARSE_ARGV 2 "" "" "OUTPUT" "OPTIONS")
  _burnish_require(OUTPUT)
  _burnish_absolute(input "${CMAKE_CURRENT_SOURCE_DIR}" "${input}")
  _burnish_absolute(output "${CMAKE_CURRENT_BINARY_DIR}" "${_OUTPUT}")
  burnish_command(${tool} OUTPUT "${output}" DEPENDS "${input}" ARGUMENTS "${input}" ${_OPTIONS} -o "${output}")
endfunction()

function(burnish_normal_map height)
  _burnish_map(normals "${height}" ${ARGN})
endfunction()

function(burnish_mipmap map)
  _burnish_map(mipmap "${map}" ${ARGN})
endfunction()

function(burnish_quantize)
  cmake_parse_arguments(PARSE_ARGV 0 "" "" "OUTPUT;OUTPUT_DIRECTORY;EXTENSION" "OPTIONS")
  _burnish_absolute(maps "${CMAKE_CURRENT_SOURCE_DIR}" ${_UNPARSED_ARGUMENTS})
  list(LENGTH maps count)
  if(DEFINED _OUTPUT AND NOT DEFINED _OUTPUT_DIRECTORY AND count EQUAL 1)
    _burnish_absolute(outputs "${CMAKE_CURRENT_BINARY_DIR}" "${_OUTPUT}")
    set(to -o "${outputs}")
  elseif(DEFINED _OUTPUT_DIRECTORY AND NOT DEFINED _OUTPUT AND count GREATER 0)
    if(NOT DEFINED _EXTENSION)
      set(_EXTENSION exr)
    endif()
    _burnish_absolute(directory "${CMAKE_CURRENT_BINARY_DIR}" "${_OUTPUT_DIRECTORY}")
    set(outputs "")
    foreach(map IN LISTS maps)
      cmake_path(GET map STEM LAST_ONLY stem)
      list(APPEND outputs "${directory}/${stem}.${_EXTENSION}")
    endforeach()
    set(to --output-dir "${directory}" --extension ${_EXTENSION})
  else()
    message(FATAL_ERROR "burnish_quantize: expected a map and OUTPUT, or maps and OUTPUT_DIRECTORY")
  endif()
  burnish_command(quantize OUTPUT ${outputs} DEPENDS ${maps} ARGUMENTS ${maps} ${_OPTIONS} ${to})
endfunction()

function(burnish_texture_directory target)
  cmake_parse_arguments(PARSE_ARGV 1 "" "" "DIRECTORY;OUTPUT_DIRECTORY;EXTENSION" "PATTERNS;NORMALS;QUANTIZE;MIPMAP")
  _burnish_require(DIRECTORY OUTPUT_DIRECTORY)
  if(NOT DEFINED _PATTERNS)
    set(_PATTERNS *.png *.tif *.exr)
  endif()
  if(NOT DEFINED _EXTENSION)
    set(_EXTENSION ktx2)
  endif()
  _burnish_absolute(from "${CMAKE_CURRENT_SOURCE_DIR}" "${_DIRECTORY}")
  _burnish_absolute(to "${CMAKE_CURRENT_BINARY_DIR}" "${_OUTPUT_DIRECTORY}")
  list(TRANSFORM _PATTERNS PREPEND "${from}/")
  file(GLOB heights CONFIGURE_DEPENDS ${_PATTERNS})
  if(NOT heights)
    message(FATAL_ERROR "burnish_texture_directory: no file of '${from}' fits ${_PATTERNS}")
  endif()
  set(outputs "")
  foreach(height IN LISTS heights)
    cmake_path(GET height STEM LAST_ONLY stem)
    set(output "${to}/${stem}.${_EXTENSION}")
    if(output IN_LIST outputs)
      message(FATAL_ERROR "burnish_texture_directory: two files of '${from}' would become '${stem}.${_EXTENSION}'")
    endif()
    list(APPEND outputs "${output}")
    set(between "${to}/${target}.dir/${stem}")
    burnish_normal_map("${height}" OUTPUT "${between}_n.png" OPTIONS -d uint16 -j 1 ${_NORMALS})
    burnish_quantize("${between}_n.png" OUTPUT "${between}_q.exr" OPTIONS -j 1 ${_QUANTIZE})
    burnish_mipmap("${between}_q.exr" OUTPUT "${output}" OPTIONS --source "${between}_n.png" -j 1 ${_MIPMAP})
  endforeach()
  add_custom_target(${target} ALL DEPENDS ${outputs})
endfunction()
